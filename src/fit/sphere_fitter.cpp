// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fit/sphere_fitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bv/assemble.h"
#include "bv/balls.h"
#include "bv/rounding.h"

namespace kios {
namespace {

/// Throws for the first point that can't be bounded.
template <typename S>
void requireUsable(const fcl::Vector3<S>* points, int n) {
  for (int i = 0; i < n; ++i) {
    bool usable = true;
    for (int c = 0; c < 3; ++c) usable &= std::abs(double{points[i][c]}) <= kMaxCoordinate<S>;
    if (usable) continue;
    std::ostringstream message;
    message << "fcl_kios: vertex (" << points[i][0] << ", " << points[i][1] << ", " << points[i][2]
            << ") is not finite or above "
            << kMaxCoordinate<S> << " in magnitude; the model stays unfinished.";
    throw std::invalid_argument(message.str());
  }
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

// Radii are measured from the centres as stored. S0: q = p - c has a relative error of u a
// coordinate, the root of its squares 3.5 u, so (1 + 8 u) covers it. A cap: q in float is off by
// u |q| <= u r0 (u = 2^-24), the distance by another 3.5 u of itself: (1 + 8 u) and 2 u r0.
template <typename S>
kIOS<S> SphereFitter<S>::measure(const fcl::Vector3<S>* points, int n, const PrincipalFrame& frame,
                                 const SphereCenters& centers) const {
  kIOS<S> bv;
  const auto inModel = [&](float x, float y, float z) {
    return Eigen::Vector3f(frame.axes * Eigen::Vector3f(x, y, z));
  };
  const float* const s0 = centers.sphere[0];
  const Eigen::Vector3f to_center =
      inModel(frame.middle[0] + s0[0], frame.middle[1] + s0[1], frame.middle[2] + s0[2]);
  for (int c = 0; c < 3; ++c) {
    bv.center0[c] = static_cast<S>(double{points[0][c]} + scaled(double{to_center[c]}, exponent_));
  }
  for (int i = 1; i < centers.k; ++i) {
    const float* const s = centers.sphere[i];
    const Eigen::Vector3f o = inModel(s[0] - s0[0], s[1] - s0[1], s[2] - s0[2]);
    bv.cap_x[i - 1] = o[0];
    bv.cap_y[i - 1] = o[1];
    bv.cap_z[i - 1] = o[2];
  }

  const double cx = bv.center0[0], cy = bv.center0[1], cz = bv.center0[2];
  const double unit0 = scaled(1.0, -exponent_ / 2);  // two steps: one may overflow
  const double unit1 = scaled(1.0, -exponent_ - (-exponent_ / 2));
  using lanes::Float4;
  const Float4 ox = lanes::load(bv.cap_x), oy = lanes::load(bv.cap_y), oz = lanes::load(bv.cap_z);
  double r0_squared = 0;
  Float4 cap_squared = lanes::broadcast(0.0F);
  for (int i = 0; i < n; ++i) {
    const double qx = (points[i][0] - cx) * unit0 * unit1;
    const double qy = (points[i][1] - cy) * unit0 * unit1;
    const double qz = (points[i][2] - cz) * unit0 * unit1;
    r0_squared = std::max(r0_squared, qx * qx + qy * qy + qz * qz);
    const Float4 dx = ox - static_cast<float>(qx), dy = oy - static_cast<float>(qy),
                 dz = oz - static_cast<float>(qz);
    cap_squared = lanes::max(cap_squared, dx * dx + dy * dy + dz * dz);
  }
  const double r0 = std::sqrt(r0_squared) * (1 + 8 * kUlpDouble);
  bv.radius0 = roundUp<S>(scaled(r0, exponent_));
  if (exponent_ < -500) {  // a subnormal radius may have been rounded down
    bv.radius0 = std::nextafter(bv.radius0, std::numeric_limits<S>::infinity());
  }
  bv.exponent = static_cast<std::int16_t>(capExponent(bv.radius0));
  const double to_cap_units = scaled(1.0, exponent_ - bv.exponent);
  for (int i = 0; i < centers.k - 1; ++i) {
    const double measured =
        std::sqrt(double{cap_squared[i]}) * (1 + 8 * kUlpFloat) + 2 * kUlpFloat * r0 + 0x1p-126;
    bv.cap_x[i] = static_cast<float>(bv.cap_x[i] * to_cap_units);
    bv.cap_y[i] = static_cast<float>(bv.cap_y[i] * to_cap_units);
    bv.cap_z[i] = static_cast<float>(bv.cap_z[i] * to_cap_units);
    bv.cap_r[i] = roundUpFloat(std::max(measured, centers.least_cap_radius) * to_cap_units);
  }
  completeCaps(bv, centers.k);
  return bv;
}

template <typename S>
kIOS<S> SphereFitter<S>::fit(const fcl::Vector3<S>* points, int n, FitMethod method, Split* split) {
  if (n == 0) return kIOS<S>();
  loadRelative(points, n);
  PrincipalFrame frame;
  if (n == 3 && method == FitMethod::kTuned && !split) {
    Eigen::Vector3d corners[2];
    for (int i = 0; i < 2; ++i) {
      for (int c = 0; c < 3; ++c) {
        corners[i][c] = scaled(double{points[i + 1][c]} - double{points[0][c]}, -exponent_);
      }
    }
    const SphereCenters centers = triangleCenters(corners[0], corners[1], frame);
    return measure(points, n, frame, centers);
  }
  frame = principalFrame(relative_, in_frame_);
  if (split) {
    const Eigen::Vector3f middle(frame.middle[0], frame.middle[1], frame.middle[2]);
    const Eigen::Vector3f center = frame.axes * middle;
    for (int c = 0; c < 3; ++c) {
      split->center[c] = double{points[0][c]} + scaled(double{center[c]}, exponent_);
    }
    split->axis = frame.axes.col(frame.order[0]).template cast<double>();
    split->axes = frame.axes;
  }
  return measure(points, n, frame,
                 method == FitMethod::kTuned ? tunedCenters(in_frame_, frame)
                                             : publishedCenters(in_frame_, frame));
}

template <typename S>
void SphereFitter<S>::releaseLarge() {
  constexpr std::size_t kKeep = 4096;
  if (relative_.capacity() > kKeep) relative_.release();
  if (in_frame_.capacity() > kKeep) in_frame_.release();
}

template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv, FitMethod method) {
  thread_local SphereFitter<S> fitter;
  bv = fitter.fit(points, n, method);
  fitter.releaseLarge();
}

template class SphereFitter<double>;
template class SphereFitter<float>;
template void fit(const fcl::Vector3<double>*, int, kIOS<double>&, FitMethod);
template void fit(const fcl::Vector3<float>*, int, kIOS<float>&, FitMethod);

}  // namespace kios
