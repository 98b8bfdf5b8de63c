// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fit/sphere_fitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bv/assemble.h"
#include "bv/rounding.h"
#include "fit/enclosing.h"

namespace kios {
namespace {

constexpr float kCot30 = 1.7320508F;

/// Largest distance of a point from the line through the origin along `axis`.
float lateralRadius(const PointLanes& points, int axis) {
  const float* const coordinates[3] = {points.x(), points.y(), points.z()};
  const float* const u = coordinates[(axis + 1) % 3];
  const float* const v = coordinates[(axis + 2) % 3];
  lanes::Float4 best = lanes::broadcast(0.0F);
  for (int i = 0; i < points.paddedSize(); i += 4) {
    const lanes::Float4 a = lanes::load(u + i), b = lanes::load(v + i);
    best = lanes::max(best, a * a + b * b);
  }
  return std::sqrt(lanes::horizontalMax(best));
}

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
  double largest = 0, poison = 0;  // poison turns NaN if a difference is not finite
  for (int i = 0; i < n; ++i) {
    const double x = points[i][0] - x0, y = points[i][1] - y0, z = points[i][2] - z0;
    poison += 0 * x + 0 * y + 0 * z;
    largest = std::max(std::max(largest, std::abs(x)), std::max(std::abs(y), std::abs(z)));
    relative_.set(i, static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }
  const double magnitude = std::max({std::abs(x0), std::abs(y0), std::abs(z0), largest / 2});
  if (poison != 0 || !(magnitude <= kMaxCoordinate<S>)) requireUsable(points, n);
  exponent_ = capExponent(largest);
  for (int i = 0; exponent_ != 0 && i < n; ++i) {
    relative_.set(i, static_cast<float>(std::ldexp(points[i][0] - x0, -exponent_)),
                  static_cast<float>(std::ldexp(points[i][1] - y0, -exponent_)),
                  static_cast<float>(std::ldexp(points[i][2] - z0, -exponent_)));
  }
  relative_.pad();
}

/// Own centres and radii (the gain over the published fit is in docs/fit.md).
template <typename S>
typename SphereFitter<S>::Centers SphereFitter<S>::tunedCenters(const PrincipalFrame& frame) const {
  Centers centers;
  shrinkBall(in_frame_, centers.sphere[0]);
  const int* order = frame.order;
  const float a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  constexpr float kRatio = 1.1F;  // below it the caps of an axis cut off next to nothing
  centers.k = a <= kRatio * c ? 1 : (a <= kRatio * b ? 3 : 5);
  for (int i = 1; i < centers.k; i += 2) {
    const int axis = i == 1 ? order[2] : order[1];
    // A sphere through the rim of the far face, half opening angle 30 degrees.
    const float height = std::max(0.0F, kCot30 * lateralRadius(in_frame_, axis) - frame.half[axis]);
    for (int side = 0; side < 2; ++side) {
      float* const center = centers.sphere[i + side];
      center[axis] = side == 0 ? height : -height;
      recenterInPlane(in_frame_, axis, center);
    }
  }
  return centers;
}

/// Method II, paper III-B.2 and III-C.
template <typename S>
typename SphereFitter<S>::Centers SphereFitter<S>::publishedCenters(
    const PrincipalFrame& frame) const {
  Centers centers;
  const int* order = frame.order;
  const double a = frame.half[order[0]], b = frame.half[order[1]], c = frame.half[order[2]];
  constexpr double kRatio = 1.5;
  centers.k = a <= kRatio * c ? 1 : (a <= kRatio * b ? 3 : 5);
  const double r0_squared = in_frame_.farthest(0, 0, 0).squared_distance;
  constexpr double kSine = 0.5, kCosine = 0.8660254037844386;
  const double r1 = std::sqrt(std::max(0.0, r0_squared - c * c)) / kSine;
  centers.least_cap_radius = r1;
  for (int i = 1; i < centers.k; ++i) {
    const int axis = i <= 2 ? order[2] : order[1];
    const double height =
        i <= 2 ? r1 * kCosine - c : std::sqrt(std::max(0.0, r1 * r1 - a * a - c * c)) - b;
    float* const center = centers.sphere[i];
    const double sign = i % 2 == 1 ? 1 : -1;
    center[axis] = static_cast<float>(sign * height);
    const double r =
        std::sqrt(in_frame_.farthest(center[0], center[1], center[2]).squared_distance);
    center[axis] = static_cast<float>(sign * (height + std::max(0.0, r1 - r)));
  }
  return centers;
}

// Radii are measured from the centres as stored. S0: q = p - c has a relative error of u a
// coordinate, the root of its squares 3.5 u, so (1 + 8 u) covers it. A cap: q in float is off by
// u |q| <= u r0 (u = 2^-24), the distance by another 3.5 u of itself: (1 + 8 u) and 2 u r0.
template <typename S>
kIOS<S> SphereFitter<S>::measure(const fcl::Vector3<S>* points, int n, const PrincipalFrame& frame,
                                 const Centers& centers) const {
  kIOS<S> bv;
  const auto inModel = [&](float x, float y, float z) {
    return Eigen::Vector3f(frame.axes * Eigen::Vector3f(x, y, z));
  };
  const float* const s0 = centers.sphere[0];
  const Eigen::Vector3f to_center =
      inModel(frame.middle[0] + s0[0], frame.middle[1] + s0[1], frame.middle[2] + s0[2]);
  for (int c = 0; c < 3; ++c) {
    bv.center0[c] =
        static_cast<S>(double{points[0][c]} + std::ldexp(double{to_center[c]}, exponent_));
  }
  for (int i = 1; i < centers.k; ++i) {
    const float* const s = centers.sphere[i];
    const Eigen::Vector3f o = inModel(s[0] - s0[0], s[1] - s0[1], s[2] - s0[2]);
    bv.cap_x[i - 1] = o[0];
    bv.cap_y[i - 1] = o[1];
    bv.cap_z[i - 1] = o[2];
  }

  const double cx = bv.center0[0], cy = bv.center0[1], cz = bv.center0[2];
  const double unit0 = std::ldexp(1.0, -exponent_ / 2);  // two steps: one may overflow
  const double unit1 = std::ldexp(1.0, -exponent_ - (-exponent_ / 2));
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
  bv.radius0 = roundUp<S>(std::ldexp(r0, exponent_));
  if (exponent_ < -500) {  // a subnormal radius may have been rounded down
    bv.radius0 = std::nextafter(bv.radius0, std::numeric_limits<S>::infinity());
  }
  bv.exponent = static_cast<std::int16_t>(capExponent(bv.radius0));
  const double to_cap_units = std::ldexp(1.0, exponent_ - bv.exponent);
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
  const PrincipalFrame frame = principalFrame(relative_, in_frame_);
  if (split) {
    const Eigen::Vector3f middle(frame.middle[0], frame.middle[1], frame.middle[2]);
    const Eigen::Vector3f center = frame.axes * middle;
    for (int c = 0; c < 3; ++c) {
      split->center[c] = double{points[0][c]} + std::ldexp(double{center[c]}, exponent_);
    }
    split->axis = frame.axes.col(frame.order[0]).template cast<double>();
  }
  return measure(points, n, frame,
                 method == FitMethod::kTuned ? tunedCenters(frame) : publishedCenters(frame));
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
