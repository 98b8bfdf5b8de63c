// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "volume/assemble.h"
#include "volume/balls.h"
#include "volume/error_bounds.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
S saturate(double v) {
  constexpr S kMax = std::numeric_limits<S>::max();
  return v < double{kMax} ? roundUp<S>(v) : kMax;
}

/// A power of a positive length stays positive where it underflows.
template <typename S>
S notBelow(S length, S power) {
  return length > 0 ? std::max(power, std::numeric_limits<S>::denorm_min()) : power;
}

/// |p - centre| / radius of the sphere that excludes p most, at most 1 + 16 u of error; 0 / 0 is 0.
template <typename S>
double exclusion(const kIOS<S>& v, const fcl::Vector3<S>& p) {
  double d[3], largest = v.radius0;
  for (int c = 0; c < 3; ++c) {
    d[c] = double{p[c]} - double{v.center0[c]};
    largest = std::max(largest, std::abs(d[c]));
  }
  if (largest == 0) return 0;
  const int e = exponentOf(largest);
  Ball balls[kIOS<S>::kMaxSpheres];
  const int k = toBalls(v, {0, 0, 0}, e, balls);
  for (double& c : d) c = scaled(c, -e);
  double worst = 0;
  for (int i = 0; i < k; ++i) {
    const double length = norm(d[0] - balls[i].x, d[1] - balls[i].y, d[2] - balls[i].z);
    worst = std::max(worst, length == 0 ? 0 : length / balls[i].r);
  }
  return worst;
}

}  // namespace

template <typename S>
bool kIOS<S>::contain(const fcl::Vector3<S>& p) const {
  return k() > 0 && p.allFinite() && exclusion(*this, p) <= 1 + 16 * kUlpDouble;
}

template <typename S>
kIOS<S>& kIOS<S>::operator+=(const fcl::Vector3<S>& p) {
  for (int c = 0; c < 3; ++c) {
    if (!(std::abs(double{p[c]}) <= kMaxCoordinate<S>)) {
      refuse("a kIOS can't contain a point that is NaN, infinite or too large.");
    }
  }
  if (k() > 0 && exclusion(*this, p) <= 1 - 16 * kUlpDouble) return *this;
  kIOS point;
  point.center0 = p;
  completeCaps(point, 1);
  return *this += point;
}

template <typename S>
fcl::Vector3<S> kIOS<S>::sphereCenter(int i) const {
  if (i == 0) return center0;
  const double o[3] = {cap_x[i - 1], cap_y[i - 1], cap_z[i - 1]};
  fcl::Vector3<S> center;
  for (int c = 0; c < 3; ++c) {
    center[c] = roundedTo<S>(double{center0[c]} + scaled(o[c], exponent));
  }
  return center;
}

template <typename S>
S kIOS<S>::sphereRadius(int i) const {
  if (i == 0) return radius0;
  // The returned centre is off by one rounding to S of each coordinate, in double one more.
  const fcl::Vector3<S> center = sphereCenter(i);
  const double shift = 2 * error_bounds::kUlp<S> *
                           (std::abs(double{center[0]}) + std::abs(double{center[1]}) +
                            std::abs(double{center[2]})) +
                       4 * double{std::numeric_limits<S>::denorm_min()};
  return saturate<S>(scaled(double{cap_r[i - 1]}, exponent) * (1 + 4 * kUlpDouble) + shift);
}

template <typename S>
void kIOS<S>::bounds(fcl::Vector3<S>& lower, fcl::Vector3<S>& upper) const {
  constexpr S kMax = std::numeric_limits<S>::max();
  lower.setConstant(k() == 0 ? kMax : -kMax);
  upper.setConstant(k() == 0 ? -kMax : kMax);
  const float* const offsets[3] = {cap_x, cap_y, cap_z};
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < k(); ++i) {
      const double o = i == 0 ? 0 : scaled(double{offsets[c][i - 1]}, exponent);
      const double r = i == 0 ? double{radius0} : scaled(double{cap_r[i - 1]}, exponent);
      // Three roundings of values below |c| + |o| + r.
      const double pad = 4 * kUlpDouble * (std::abs(double{center0[c]}) + std::abs(o) + r) +
                         std::numeric_limits<double>::min();
      const double low = double{center0[c]} + (o - r) - pad;
      const double high = double{center0[c]} + (o + r) + pad;
      constexpr S kInfinity = std::numeric_limits<S>::infinity();
      lower[c] = std::max(lower[c], std::nextafter(roundedTo<S>(low), -kInfinity));
      upper[c] = std::min(upper[c], std::nextafter(roundedTo<S>(high), kInfinity));
    }
  }
}

template <typename S>
S kIOS<S>::extent(int axis) const {
  fcl::Vector3<S> lower, upper;
  bounds(lower, upper);
  const double extent = double{upper[axis]} - double{lower[axis]};
  return extent > 0 ? saturate<S>(extent * (1 + 2 * kUlpDouble)) : S(0);
}

template <typename S>
S kIOS<S>::volume() const {
  if (k() == 0) return S(0);
  constexpr double kBall = 4.18879020478639098;  // 4 pi / 3, rounded up
  const double r = radius0;
  const double ball = kBall * r * r * r;
  const double box = double{width()} * double{height()} * double{depth()};
  return notBelow(radius0, saturate<S>(std::min(ball, box) * (1 + 8 * kUlpDouble)));
}

template <typename S>
S kIOS<S>::size() const {
  const double diameter = 2 * double{radius0};
  return notBelow(radius0, saturate<S>(diameter * diameter));
}

template <typename S>
kIOS<S> translate(const kIOS<S>& bv, const fcl::Vector3<S>& t) {
  if (bv.k() == 0) return bv;
  kIOS<S> moved = bv;
  double shift = 0;  // |rounding of the moved centre|_1
  for (int c = 0; c < 3; ++c) {
    moved.center0[c] = bv.center0[c] + t[c];
    shift += error_bounds::kUlp<S> * std::abs(double{moved.center0[c]});
  }
  moved.radius0 = saturate<S>((double{bv.radius0} + shift) * (1 + 4 * kUlpDouble));
  // The units stay: growth by a rounding error keeps S0 in range unless the offset dwarfs the
  // node, when the caps say nothing and S0 alone is kept.
  moved.exponent = static_cast<std::int16_t>(capExponent(moved.radius0));
  if (moved.exponent != bv.exponent) {
    completeCaps(moved, 1);
    return moved;
  }
  for (int i = 0; i + 1 < bv.k(); ++i) {
    moved.cap_r[i] = roundUpFloat(double{bv.cap_r[i]} + scaled(shift, -bv.exponent));
  }
  completeCaps(moved, bv.k());
  return moved;
}

template class kIOS<double>;
template class kIOS<float>;
template kIOS<double> translate(const kIOS<double>&, const fcl::Vector3<double>&);
template kIOS<float> translate(const kIOS<float>&, const fcl::Vector3<float>&);

}  // namespace kios
