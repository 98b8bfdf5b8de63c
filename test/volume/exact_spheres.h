// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "fcl_kios/paper.h"
#include "fcl_kios/volume.h"
#include "volume/point_sets.h"

namespace kios::testing {

template <typename S>
kIOS<S> fitted(const Points<S>& points, const FitOptions& options = FitMethod::kTuned) {
  kIOS<S> v;
  fit(points.data(), static_cast<int>(points.size()), v, options);
  return v;
}

// A 64-bit significand to filter, 100 digits to decide. Neither over- nor underflows: squares of
// doubles lie within 2^-2150 .. 2^2048.
using Exact = boost::multiprecision::cpp_bin_float_100;
static_assert(std::numeric_limits<long double>::digits >= 64 &&
                  std::numeric_limits<long double>::max_exponent > 16000,
              "the filter needs x87 or wider long doubles");
constexpr long double kFilterUlp = std::numeric_limits<long double>::epsilon();

/// Sphere i (S0, then four caps whether k counts them or not) exactly as v stores it, in T.
template <typename T>
struct StoredSphere {
  T center0[3], offset[3], radius;

  template <typename S>
  StoredSphere(const kIOS<S>& v, int i) {
    const float zero = 0;
    const float* const stored[3] = {i ? &v.cap_x[i - 1] : &zero, i ? &v.cap_y[i - 1] : &zero,
                                    i ? &v.cap_z[i - 1] : &zero};
    using std::ldexp;
    for (int c = 0; c < 3; ++c) {
      center0[c] = v.center0[c];
      offset[c] = ldexp(T(*stored[c]), v.exponent);
    }
    radius = i ? ldexp(T(v.cap_r[i - 1]), v.exponent) : T(v.radius0);
  }

  /// Returns |p - centre|, and in `error` the sum of the magnitudes that its rounding is relative
  /// to.
  T distanceTo(const T p[3], T* error) const {
    T sum = 0;
    *error = 0;
    for (int c = 0; c < 3; ++c) {
      const T from_center0 = p[c] - center0[c], d = from_center0 - offset[c];
      using std::abs;
      *error += abs(from_center0) + abs(offset[c]);
      sum += d * d;
    }
    using std::sqrt;
    return sqrt(sum);
  }
};

/// Returns the centre of cap i from S0's, and its radius, in the model's units.
inline fcl::Vector3d capOffset(const kIOSd& v, int i) {
  return fcl::Vector3d(StoredSphere<double>(v, i + 1).offset);
}
inline double capRadius(const kIOSd& v, int i) { return StoredSphere<double>(v, i + 1).radius; }

/// Returns true if stored sphere i contains p + t, without rounding.
template <typename S>
bool sphereContains(const kIOS<S>& v, int i, const fcl::Vector3<S>& p,
                    const fcl::Vector3<S>& t = fcl::Vector3<S>::Zero()) {
  if (t.isZero(0)) {
    const StoredSphere<long double> sphere(v, i);
    const long double q[3] = {p[0], p[1], p[2]};
    long double error;
    const long double distance = sphere.distanceTo(q, &error);
    if (distance + 16 * kFilterUlp * error <= sphere.radius) return true;
  }
  const StoredSphere<Exact> sphere(v, i);
  const Exact q[3] = {Exact(p[0]) + Exact(t[0]), Exact(p[1]) + Exact(t[1]),
                      Exact(p[2]) + Exact(t[2])};
  Exact error;
  return sphere.distanceTo(q, &error) <= sphere.radius;
}

/// Returns true if all spheres that k counts contain p, without rounding.
template <typename S>
bool containsExactly(const kIOS<S>& v, const fcl::Vector3<S>& p) {
  for (int i = 0; i < v.k(); ++i) {
    if (!sphereContains(v, i, p)) return false;
  }
  return true;
}

/// Names what is wrong with v as a volume around the points (moved by t), or is empty.
template <typename S>
std::string violation(const kIOS<S>& v, const Points<S>& points,
                      const fcl::Vector3<S>& t = fcl::Vector3<S>::Zero()) {
  const int k = v.k();
  if (k != 1 && k != 3 && k != 5) return "k = " + std::to_string(k);
  if (!v.center0.allFinite() || !std::isfinite(v.radius0) || !std::isfinite(v.reach)) {
    return "S0 or reach is not finite";
  }
  using std::sqrt;
  for (int i = 0; i < 4; ++i) {
    const long double x = v.cap_x[i], y = v.cap_y[i], z = v.cap_z[i];
    const long double farthest = sqrt(x * x + y * y + z * z) + v.cap_r[i];
    if (!std::isfinite(farthest)) return "cap is not finite";
    if (!(v.reach >= farthest * (1 - 4 * kFilterUlp))) return "reach is too small for a cap";
  }
  if (!(std::ldexp(static_cast<long double>(v.reach), v.exponent) >= v.radius0)) {
    return "reach is too small for S0";
  }
  for (const auto& p : points) {
    for (int i = 0; i <= kIOS<S>::kCaps; ++i) {
      if (!sphereContains(v, i, p, t)) return "point outside sphere " + std::to_string(i);
    }
  }
  return {};
}

/// Checks it for what v computes from its spheres; the points as they are.
template <typename S>
std::string measureViolation(const kIOS<S>& v, const Points<S>& points) {
  constexpr long double kLeast = std::numeric_limits<S>::min();
  constexpr S kMax = std::numeric_limits<S>::max();
  fcl::Vector3<S> lower, upper, least = points[0], greatest = points[0];
  v.bounds(lower, upper);
  for (const auto& p : points) {
    if (!v.contain(p)) return "contain() denies a point";
    if (!((lower.array() <= p.array()).all() && (p.array() <= upper.array()).all())) {
      return "point outside bounds()";
    }
    least = least.cwiseMin(p);
    greatest = greatest.cwiseMax(p);
  }
  const S extents[3] = {v.width(), v.height(), v.depth()};
  for (int c = 0; c < 3; ++c) {
    const long double content = static_cast<long double>(greatest[c]) - least[c];
    if (!std::isfinite(lower[c]) || !std::isfinite(upper[c]) || !std::isfinite(extents[c])) {
      return "bounds are not finite";
    }
    if (!(extents[c] >= content)) return "width(), height() or depth() below the content's";
  }
  if (!std::isfinite(v.volume()) || v.volume() < 0) return "volume()";
  const long double diameter = 2 * static_cast<long double>(v.radius0);
  const long double size = diameter * diameter;
  if (!std::isfinite(v.size()) || v.size() < 0) return "size() is not finite";
  // Rounded outwards, coarsely where it under- or nearly overflows.
  const long double low = size * (1 - 1e-12L) - kLeast, high = size * 1.000001L + 2 * kLeast;
  if (size >= kMax ? v.size() != kMax : v.size() < low || (size <= kMax / 2 && v.size() > high)) {
    return "size() is not the squared diameter";
  }
  for (int i = 0; i < v.k(); ++i) {
    kIOS<S> rounded;  // sphere i as its accessors give it
    rounded.center0 = v.sphereCenter(i);
    rounded.radius0 = v.sphereRadius(i);
    for (const auto& p : points) {
      if (!sphereContains(rounded, 0, p)) return "point outside sphereRadius()";
    }
  }
  return {};
}

/// Asks whether they are equal bit by bit, signs of zeros included.
template <typename S>
bool bitwiseEqual(const kIOS<S>& a, const kIOS<S>& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::memcmp(&x, &y, sizeof(x)) == 0;
  };
  return same(a.center0, b.center0) && same(a.radius0, b.radius0) && same(a.cap_x, b.cap_x) &&
         same(a.cap_y, b.cap_y) && same(a.cap_z, b.cap_z) && same(a.cap_r, b.cap_r) &&
         same(a.reach, b.reach) && a.exponent == b.exponent && a.num_spheres == b.num_spheres;
}

}  // namespace kios::testing
