// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/sphere_fitter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "build/enclosing_ellipsoid.h"
#include "build/measure.h"
#include "build/triangle_fit.h"
#include "volume/assemble.h"
#include "volume/balls.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Throws for the first point that can't be bounded.
template <typename S>
void requireUsable(const fcl::Vector3<S>* points, int n) {
  for (int i = 0; i < n; ++i) {
    const fcl::Vector3<S>& p = points[i];
    bool usable = true;
    for (int c = 0; c < 3; ++c) usable &= std::abs(double{p[c]}) <= kMaxCoordinate<S>;
    if (usable) continue;
    refuse("vertex (", p[0], ", ", p[1], ", ", p[2], ") is not finite or above ", kMaxCoordinate<S>,
           " in magnitude; the model stays unfinished.");
  }
}

/// The frame of the smallest enclosing ellipsoid: middle, axes and half extents are its centre,
/// axes and semi-axes (paper, III-B.1). `in_frame` holds `points` in the frame `principal`, on
/// return in the new one.
PrincipalFrame ellipsoidFrame(const PointLanes& points, PointLanes& in_frame,
                              const PrincipalFrame& principal) {
  constexpr double kTolerance = 1e-3;  // the volume is within 0.15 % of the least
  const EnclosingEllipsoid ellipsoid = smallestEllipsoid(in_frame, kTolerance);
  const Eigen::Matrix3d axes = principal.axes.cast<double>() * ellipsoid.axes;
  const Eigen::Vector3d middle =
      ellipsoid.axes.transpose() *
      (ellipsoid.center +
       Eigen::Vector3d(principal.middle[0], principal.middle[1], principal.middle[2]));

  PrincipalFrame frame;
  frame.axes = axes.cast<float>();
  for (int k = 0; k < 3; ++k) {
    frame.middle[k] = static_cast<float>(middle[k]);
    frame.half[k] = static_cast<float>(ellipsoid.half[k]);
  }
  in_frame.resize(points.size());
  float* const out[3] = {in_frame.x(), in_frame.y(), in_frame.z()};
  for (int i = 0; i < points.paddedSize(); ++i) {
    const Eigen::Vector3f p(points.x()[i], points.y()[i], points.z()[i]);
    for (int k = 0; k < 3; ++k) out[k][i] = frame.axes.col(k).dot(p) - frame.middle[k];
  }
  return frame;
}

}  // namespace

template <typename S>
void SphereFitter<S>::loadRelative(const fcl::Vector3<S>* points, int n) {
  relative_.resize(n);
  const double x0 = points[0][0], y0 = points[0][1], z0 = points[0][2];
  double largest = 0, magnitude = 0, poison = 0;  // poison turns NaN if a difference is not finite
  for (int i = 0; i < n; ++i) {
    const double x = points[i][0] - x0, y = points[i][1] - y0, z = points[i][2] - z0;
    poison += 0 * x + 0 * y + 0 * z;
    largest = std::max(std::max(largest, std::abs(x)), std::max(std::abs(y), std::abs(z)));
    for (int c = 0; c < 3; ++c) magnitude = std::max(magnitude, std::abs(double{points[i][c]}));
    relative_.set(i, static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }
  if (poison != 0 || !(magnitude <= kMaxCoordinate<S>)) requireUsable(points, n);
  exponent_ = capExponent(largest);
  for (int i = 0; exponent_ != 0 && i < n; ++i) {
    relative_.set(i, static_cast<float>(scaled(points[i][0] - x0, -exponent_)),
                  static_cast<float>(scaled(points[i][1] - y0, -exponent_)),
                  static_cast<float>(scaled(points[i][2] - z0, -exponent_)));
  }
  relative_.pad();
}

template <typename S>
SphereCenters SphereFitter<S>::place(const fcl::Vector3<S>* points, int n,
                                     const FitOptions& options, int most, Split* split) {
  loadRelative(points, n);
  PrincipalFrame frame = principalFrame(relative_, in_frame_);
  if (split) {
    const Eigen::Vector3f middle(frame.middle[0], frame.middle[1], frame.middle[2]);
    const Eigen::Vector3f center = frame.axes * middle;
    for (int c = 0; c < 3; ++c) {
      split->center[c] = double{points[0][c]} + scaled(double{center[c]}, exponent_);
    }
    split->axis = frame.axes.col(frame.order[0]).template cast<double>();
    split->axes = frame.axes;
  }
  SphereCenters centers;
  switch (options.method) {
    case FitMethod::kTuned:
      centers = tunedCenters(in_frame_, frame, options, most);
      break;
    case FitMethod::kMethodI:
    case FitMethod::kMethodIAtAngle:
      frame = ellipsoidFrame(relative_, in_frame_, frame);
      centers = ellipsoidCenters(frame, options);
      break;
    case FitMethod::kMethodII:
      centers = publishedCenters(in_frame_, frame, options);
      break;
  }
  centers.k = std::min(centers.k, most);
  if (options.shared_radius || options.count == SphereCount::kByGain) {
    adjustCenters(in_frame_, frame, options, centers);
  }
  return inAxesOfPoints(centers, frame);
}

template <typename S>
kIOS<S> SphereFitter<S>::fit(const fcl::Vector3<S>* points, int n, const FitOptions& options,
                             Split* split) {
  if (n == 0) return kIOS<S>();
  if (n == 3 && !split && options.plain()) {
    requireUsable(points, n);
    return fitTriangle(points);
  }
  const SphereCenters centers = place(points, n, options, kIOS<S>::kMaxSpheres, split);
  kIOS<S> bv;
  for (int c = 0; c < 3; ++c) {
    bv.center0[c] =
        static_cast<S>(double{points[0][c]} + scaled(double{centers.sphere[0][c]}, exponent_));
  }
  for (int i = 1; i < centers.k; ++i) {
    bv.cap_x[i - 1] = centers.sphere[i][0];
    bv.cap_y[i - 1] = centers.sphere[i][1];
    bv.cap_z[i - 1] = centers.sphere[i][2];
  }
  measure(points, n, exponent_, centers.k, static_cast<float>(centers.least_cap_radius), bv);
  if (!options.plain() && sizeof(S) == sizeof(float) && bv.reach > scaled(0x1p126, -bv.exponent)) {
    completeCaps(bv, 1);  // accessors could not return such spheres
  } else if (options.shared_radius && centers.k > 1) {
    // Rounding outwards may have told them apart.
    std::fill_n(bv.cap_r, centers.k - 1, *std::max_element(bv.cap_r, bv.cap_r + centers.k - 1));
    completeCaps(bv, centers.k);
  }
  return bv;
}

void requireUsable(const FitOptions& options) {
  constexpr double kLeast = 1.0 / 256, kHalfPi = 1.5707963267948966;
  if (options.angle >= kLeast && options.angle < kHalfPi) return;
  refuse("the angle of a fit must be in [1/256, pi/2), not ", options.angle, ".");
}

template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, const FitOptions& options) {
  requireUsable(options);
  SphereFitter<S> fitter;
  bv = fitter.fit(points, n, options);
}

template class SphereFitter<double>;
template class SphereFitter<float>;
template void fit(const fcl::Vector3<double>*, int, kIOS<double>&, const FitOptions&);
template void fit(const fcl::Vector3<float>*, int, kIOS<float>&, const FitOptions&);

}  // namespace kios
