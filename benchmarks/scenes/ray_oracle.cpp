// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ray_oracle.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "integers.h"

namespace kios::scenes {
namespace {

Vector operator+(const Vector& a, const Vector& b) {
  return {Integer(a[0] + b[0]), Integer(a[1] + b[1]), Integer(a[2] + b[2])};
}

Vector operator*(const Integer& s, const Vector& a) {
  return {Integer(s * a[0]), Integer(s * a[1]), Integer(s * a[2])};
}

bool isZero(const Vector& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

// n / d, d > 0.
struct Fraction {
  Integer n, d = 1;

  Fraction(Integer numerator, Integer denominator)
      : n(std::move(numerator)), d(std::move(denominator)) {
    if (d >= 0) return;
    n = -n;
    d = -d;
  }
  bool operator<(const Fraction& o) const { return n * o.d < o.n * d; }

  long double rounded(int exponent) const {
    using Float = mp::number<mp::cpp_bin_float<100>, mp::et_off>;
    return ldexp(Float(n) / Float(d), exponent).convert_to<long double>();
  }
};

// The line's parameters that remain after clipping.
struct Interval {
  Fraction low, high;

  // Those with a + t b >= 0.
  bool clip(const Integer& a, const Integer& b) {
    if (b == 0) return a >= 0;
    const Fraction at(-a, b);
    if (b > 0) {
      low = std::max(low, at);
    } else {
      high = std::min(high, at);
    }
    return !(high < low);
  }
};

// v in units of 2^exponent.
Fraction inUnits(double v, int exponent) {
  const IntegerPoints one({Eigen::Vector3d(v, 0, 0)});
  const int shift = one.exponent - exponent;
  const Integer& n = one.points[0][0];
  return shift >= 0 ? Fraction(n << shift, 1) : Fraction(n, Integer(1) << -shift);
}

// The points of a segment that lie on the line: of one, or of all.
bool clipBySegment(const Vector& o, const Vector& d, const Vector& p, const Vector& q,
                   Interval& part) {
  const Vector g = q - p, w = p - o, normal = cross(d, g);
  if (!isZero(normal)) {  // o + t d = p + s g
    const Integer square = dot(normal, normal);
    const Integer s = dot(cross(w, d), normal), t = dot(cross(w, g), normal);
    if (dot(w, normal) != 0 || s < 0 || s > square) return false;
    return part.clip(-t, square) && part.clip(t, -square);
  }
  if (!isZero(cross(d, w))) return false;
  const int c = d[0] != 0 ? 0 : (d[1] != 0 ? 1 : 2);
  const auto [low, high] = std::minmax({Fraction(p[c] - o[c], d[c]), Fraction(q[c] - o[c], d[c])});
  return part.clip(-low.n, low.d) && part.clip(high.n, -high.d);
}

}  // namespace

std::optional<RationalRayHit> rationalRayHit(const RationalRay& ray,
                                             const std::array<Eigen::Vector3d, 3>& triangle) {
  const IntegerPoints points({triangle[0], triangle[1], triangle[2], ray.origin});
  const IntegerPoints direction({ray.direction});
  const int exponent = points.exponent - direction.exponent;
  const Triangle v = {points.points[0], points.points[1], points.points[2]};
  const Vector &o = points.points[3], &d = direction.points[0];
  Interval part = {inUnits(ray.t_min, exponent), inUnits(ray.t_max, exponent)};
  RationalRayHit hit = {};

  const Vector edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const Vector normal = cross(edges[0], edges[1]);
  const Integer height = dot(normal, v[0] - o), slope = dot(normal, d);
  if (isZero(normal)) {  // the longest edge is all
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (dot(edges[k], edges[k]) > dot(edges[longest], edges[longest])) longest = k;
    }
    if (!clipBySegment(o, d, v[longest], v[kNext[longest]], part)) return std::nullopt;
  } else if (slope == 0) {
    if (height != 0) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
      const Vector inward = cross(normal, edges[k]);
      if (!part.clip(dot(inward, o - v[k]), dot(inward, d))) return std::nullopt;
    }
  } else {
    if (!part.clip(-height, slope) || !part.clip(height, -slope)) return std::nullopt;
    for (int k = 0; k < 3; ++k) {  // of the point where it is, times the slope
      const Vector at = slope * (o - v[k]) + height * d;
      const Fraction weight(dot(normal, cross(edges[k], at)), slope * dot(normal, normal));
      if (weight.n < 0) return std::nullopt;
      hit.weights[static_cast<std::size_t>(kNext[kNext[k]])] = weight.rounded(0);
    }
    hit.crosses = true;
    hit.along_normal = slope > 0;
  }
  if (part.high < part.low) return std::nullopt;  // t_min > t_max
  hit.t = part.low.rounded(exponent);
  return hit;
}

}  // namespace kios::scenes
