// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// The cases that floating point leaves open: rays that start on a triangle or lie in its plane,
// degenerate triangles, hits at the ray's ends, coordinates of very different size.

#include <algorithm>
#include <limits>
#include <vector>

#include "triangle/integer.h"
#include "triangle/ray_triangle.h"

namespace kios {
namespace {

/// Lowers `unit` to the largest exponent of a power of two of which all coordinates are multiples.
void divide(const Point<double>& p, int& unit) {
  for (int c = 0; c < 3; ++c) {
    if (p[c] != 0) unit = std::min(unit, lowestBit(p[c]));
  }
}

/// numerator / denominator 2^exponent, denominator > 0.
struct Fraction {
  Integer numerator, denominator;

  bool operator<(const Fraction& o) const {
    return numerator * o.denominator < o.numerator * denominator;
  }
};

Fraction fraction(const Integer& n, const Integer& d) {
  return d < 0 ? Fraction{-n, -d} : Fraction{n, d};
}

Fraction toFraction(double v, int exponent) {
  if (v == 0) return {0, 1};
  const int unit = std::min(exponent, lowestBit(v));
  return {integer(v, unit), Integer(1) << (exponent - unit)};
}

/// To nearest, of two the even; subnormal results too.
double rounded(const Fraction& f, int exponent) {
  if (f.numerator == 0) return 0;
  Integer n = abs(f.numerator), d = f.denominator;
  // 55 or 56 bits of the quotient, the last one set if anything is below.
  const int shift = 55 + static_cast<int>(msb(d)) - static_cast<int>(msb(n));
  if (shift > 0) {
    n <<= shift;
  } else {
    d <<= -shift;
  }
  Integer quotient, rest;
  divide_qr(n, d, quotient, rest);
  auto q = static_cast<unsigned long long>(quotient) | (rest != 0 ? 1U : 0U);
  const int unit = exponent - shift;  // of q's bit 0
  const int bits = static_cast<int>(msb(Integer(q))) + 1;
  const int drop = std::max(bits - 53, -1074 - unit);
  if (drop > bits) return f.numerator < 0 ? -0.0 : 0.0;
  const unsigned long long half = 1ULL << (drop - 1), below = q & (2 * half - 1);
  q >>= drop;
  if (below > half || (below == half && q % 2 == 1)) ++q;
  const double v = std::ldexp(static_cast<double>(q), unit + drop);
  return f.numerator < 0 ? -v : v;
}

/// A point of the ray's line with its barycentric coordinates.
struct LinePoint {
  Fraction t;
  double weights[3];
};

class IntegerTest {
 public:
  IntegerTest(const GivenRay& ray, const TriangleVertices<double>& corners) : ray_(ray) {
    int points = kNone, directions = kNone;
    divide(ray.origin, points);
    divide(ray.direction, directions);
    for (const Point<double>& p : corners) divide(p, points);
    if (points == kNone) points = 0;  // all at zero
    exponent_ = points - directions - ray.exponent;
    direction_ = integers(ray.direction, directions);
    const IntegerVector origin = integers(ray.origin, points);
    for (int i = 0; i < 3; ++i) corner_[i] = integers(corners[i], points) - origin;
    t_min_ = toFraction(ray.t_min, exponent_);
    t_max_ = toFraction(ray.t_max, exponent_);
  }

  bool run(TriangleHit& hit) const {
    Integer side[3], slope = 0;
    bool left = false, right = false;
    for (int i = 0; i < 3; ++i) {
      side[i] = dot(direction_, cross(corner_[i], corner_[kNext[i]]));
      left |= side[i] > 0;
      right |= side[i] < 0;
      slope += side[i];
    }
    if (left && right) return false;
    if (!left && !right) return coplanar(hit);
    const Fraction t = fraction(dot(corner_[0], cross(corner_[1], corner_[2])), slope);
    if (t < t_min_ || t_max_ < t) return false;
    hit.t = rounded(t, exponent_);
    hit.side = slope.sign();
    for (int i = 0; i < 3; ++i) {
      hit.weights[kNext[kNext[i]]] = rounded(fraction(side[i], slope), 0);
    }
    return true;
  }

 private:
  static constexpr int kNone = std::numeric_limits<int>::max();

  /// The ray's line and the triangle lie in a plane, or the latter is a segment or a point. The
  /// line's part in it ends at vertices on the line and where it crosses edges.
  bool coplanar(TriangleHit& hit) const {
    const std::vector<LinePoint> ends = common();
    if (ends.empty()) return false;
    const auto by_t = [](const LinePoint& a, const LinePoint& b) { return a.t < b.t; };
    const auto [first, last] = std::minmax_element(ends.begin(), ends.end(), by_t);
    if (last->t < t_min_ || t_max_ < first->t) return false;
    const bool from_start = first->t < t_min_;
    hit.t = from_start ? ray_.t_min : rounded(first->t, exponent_);
    hit.side = 0;
    const double share = from_start ? shareOf(t_min_, first->t, last->t) : 0;
    for (int i = 0; i < 3; ++i) {
      hit.weights[i] = (1 - share) * first->weights[i] + share * last->weights[i];
    }
    return true;
  }

  /// (t - from) / (to - from)
  static double shareOf(const Fraction& t, const Fraction& from, const Fraction& to) {
    const auto difference = [](const Fraction& a, const Fraction& b) {
      return Integer(a.numerator * b.denominator - b.numerator * a.denominator);
    };
    return rounded({difference(t, from) * to.denominator, difference(to, from) * t.denominator}, 0);
  }

  std::vector<LinePoint> common() const {
    int along = 0;  // a coordinate that changes along the line
    for (int c = 1; c < 3; ++c) {
      if (abs(direction_[c]) > abs(direction_[along])) along = c;
    }
    // Beside the line each corner lies at a multiple of one vector: any coordinate tells.
    IntegerVector beside[3];
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
      beside[i] = cross(direction_, corner_[i]);
      for (int c = 0; c < 3; ++c) {
        if (beside[i][c] != 0) axis = c;
      }
    }
    std::vector<LinePoint> ends;
    for (int i = 0; i < 3; ++i) {
      const int j = kNext[i];
      const Integer &of_i = beside[i][axis], &of_j = beside[j][axis];
      if (of_i == 0) {
        LinePoint& end = ends.emplace_back();
        end.t = fraction(corner_[i][along], direction_[along]);
        for (int k = 0; k < 3; ++k) end.weights[k] = k == i ? 1 : 0;
      } else if (of_i.sign() * of_j.sign() < 0) {
        LinePoint& end = ends.emplace_back();
        const Integer sum = of_j - of_i;
        end.t =
            fraction(of_j * corner_[i][along] - of_i * corner_[j][along], sum * direction_[along]);
        end.weights[i] = rounded(fraction(of_j, sum), 0);
        end.weights[j] = rounded(fraction(-of_i, sum), 0);
        end.weights[kNext[j]] = 0;
      }
    }
    return ends;
  }

  const GivenRay& ray_;
  int exponent_;
  IntegerVector direction_, corner_[3];  ///< corners from the origin
  Fraction t_min_, t_max_;
};

}  // namespace

bool hitInIntegers(const GivenRay& ray, const TriangleVertices<double>& corners, TriangleHit& hit) {
  return IntegerTest(ray, corners).run(hit);
}

}  // namespace kios
