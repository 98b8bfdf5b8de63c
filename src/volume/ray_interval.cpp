// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "volume/ray_interval.h"

#include <algorithm>
#include <cmath>

#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios {

RayLine::RayLine(const fcl::Vector3d& origin, const fcl::Vector3d& direction, int exponent)
    : origin_(origin) {
  const int turn = std::clamp(std::ilogb(direction.cwiseAbs().maxCoeff()), -1000, 1000);
  direction_ = direction * std::ldexp(1.0, -turn);
  exponent_ = exponent + turn;
  squared_length_ = direction_.squaredNorm();
  length_ = std::sqrt(squared_length_);
  unit_ = direction_ / length_;
}

// The point at t is exact for the t that is returned: w = center - origin is off by u |w|, t times
// the direction by u |w|, and their difference by as much, with 1 % for t's own rounding.
RayLine::Near RayLine::nearTo(const fcl::Vector3d& center, int e) const {
  const fcl::Vector3d w = (center - origin_).unaryExpr([e](double v) { return scaled(v, -e); });
  Near near;
  near.t = w.dot(direction_) / squared_length_;
  near.from_it = w - near.t * direction_;
  near.error = 8 * kUlpDouble * w.lpNorm<1>();
  return near;
}

double RayLine::lengthOf(double t, double near_t, int e) const {
  return (scaled(t, exponent_ - e) - near_t) * length_;
}

double RayLine::parameterOf(double length, double near_t, int e) const {
  return scaled(near_t + length / length_, e - exponent_);
}

// A point at length s from the near point lies in a sphere of centre c (from there) and radius r if
// |s f - c| <= r, f the exact unit vector. With b = c . f and p = c - b f as computed, S = |near
// point to centre| + reach, and u = 2^-53, this follows from |s - b| <= h + 12 u S, where
// h^2 = (r + 14 u S)^2 - p^2:
// - f is off by 3 u, which moves points within 2 S by 6 u S; sums for c by u S;
// - (s - b)^2 - 2 (s - b) p . f + p^2 <= r^2, where |p . f| <= 12 u S however b was rounded;
// - p is off by 3 u S, and squares and their difference by 6 u (r + ...)^2, so 3 u S of r.
// Ends are rounded by another 4 u S. 64 u S covers each; the near point's error is the pad's rest.
template <typename S>
bool rayInterval(const kIOS<S>& bv, const RayLine& line, double& enter, double& exit) {
  if (bv.k() == 0) return false;
  const fcl::Vector3d center = bv.center0.template cast<double>();
  const double reach = std::max<double>(scaled(bv.reach, bv.exponent), bv.radius0);
  const double largest = std::max((center - line.origin()).lpNorm<Eigen::Infinity>(), reach);
  // Squares of lengths, and of their roundings, keep clear of under- and overflow.
  const int e = largest == 0 || (largest > 0x1p-300 && largest < 0x1p300) ? 0 : exponentOf(largest);
  const RayLine::Near near = line.nearTo(center, e);
  const fcl::Vector3d &m = near.from_it, &f = line.unit();
  const double pad = 64 * kUlpDouble * (m.lpNorm<1>() + scaled(reach, -e)) + near.error;

  Ball balls[kIOS<S>::kMaxSpheres];
  const int k = toBalls(bv, {m[0], m[1], m[2]}, e, balls);
  double low = -kInfinity, high = kInfinity;
  for (int i = 0; i < k; ++i) {
    const Ball& ball = balls[i];
    const double b = ball.x * f[0] + ball.y * f[1] + ball.z * f[2];
    const double x = ball.x - b * f[0], y = ball.y - b * f[1], z = ball.z - b * f[2];
    const double r = ball.r + pad, square = r * r - (x * x + y * y + z * z);
    if (square < 0) return false;
    const double h = std::sqrt(square);
    low = std::max(low, b - h);
    high = std::min(high, b + h);
  }
  low -= pad;
  high += pad;
  if (low > high) return false;
  // The near point's t is a double; its sum with low is rounded once more, as is the end.
  const double t_pad = 4 * kUlpDouble * std::abs(near.t);
  const auto out = [&](double length, double direction) {
    const double shift = direction > 0 ? t_pad : -t_pad;
    return std::nextafter(line.parameterOf(length, near.t + shift, e), direction);
  };
  enter = out(low, -kInfinity);
  exit = out(high, kInfinity);
  return true;
}

template bool rayInterval(const kIOS<double>&, const RayLine&, double&, double&);
template bool rayInterval(const kIOS<float>&, const RayLine&, double&, double&);

}  // namespace kios
