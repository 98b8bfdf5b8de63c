// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/solid_angle.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle.h"
#include "triangle/predicates.h"
#include "triangle/twofold.h"
#include "volume/balls.h"

namespace kios {
namespace {

constexpr double kTurn = 6.283185307179586;

double rootOf(double v) { return std::sqrt(v); }
Twofold rootOf(const Twofold& v) {
  const double root = std::sqrt(v.high + v.low);
  if (!(root > 0)) return {0, 0};
  double square, error;
  twoProduct(root, root, square, error);
  return {root, ((v.high - square) - error + v.low) / (2 * root)};
}

/// A vector of doubles or of Twofold.
template <typename T>
using Row = T[3];

template <typename T>
T dot(const Row<T>& a, const Row<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The tangent of half of the solid angle is y / x (van Oosterom and Strackee 1983); x and y are
/// the corners' distances multiplied, `size`, times numbers of at most 4.
template <typename T>
struct Tangent {
  explicit Tangent(const Row<T> (&v)[3]) {
    const T a = rootOf(dot(v[0], v[0])), b = rootOf(dot(v[1], v[1])), c = rootOf(dot(v[2], v[2]));
    const Row<T>& w = v[2];
    y = v[0][0] * (v[1][1] * w[2] - v[1][2] * w[1]) + v[0][1] * (v[1][2] * w[0] - v[1][0] * w[2]) +
        v[0][2] * (v[1][0] * w[1] - v[1][1] * w[0]);
    size = a * b * c;
    x = size + dot(v[0], v[1]) * c + dot(v[1], w) * a + dot(w, v[0]) * b;
  }
  T x, y, size;
};

/// For p in the plane of the triangle or near an edge, where x and y lose their digits. Twofold
/// ones keep 2^-100 of `size`, and the sign of y is exact.
double accurateAngle(const Pointd& p, const TriangleVerticesd& t) {
  const TriangleVerticesd at_p = {p, p, p};
  if (trianglesIntersect(at_p, t)) return 0;
  const auto coordinates = coordinatesOf(at_p, t);
  const int side = PairPredicates(coordinates).orient3d(3, 4, 5, 0);
  if (side == 0) return 0;
  double magnitude = 0;
  for (const Pointd& q : t) magnitude = std::max(magnitude, (q - p).cwiseAbs().maxCoeff());
  const int exponent = exponentOf(magnitude);
  Row<Twofold> v[3];
  for (std::size_t k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) {
      const Twofold d = twofoldDifference(t[k][c], p[c]);
      v[k][c] = {std::ldexp(d.high, -exponent), std::ldexp(d.low, -exponent)};
    }
  }
  const Tangent<Twofold> of(v);
  return std::copysign(std::atan2(std::abs(of.y.high + of.y.low), of.x.high + of.x.low), side) /
         kTurn;
}

}  // namespace

// x and y in doubles are off by 32 u `size` at most, u = 2^-53, and the angle by that over |(x,
// y)|.
double solidAngle(const Pointd& p, const TriangleVerticesd& t) {
  Row<double> v[3];
  for (std::size_t k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) v[k][c] = t[k][c] - p[c];
  }
  const Tangent<double> of(v);
  const double y = std::abs(of.y);
  // Products of three lengths that neither over- nor underflow; else NaN goes the long way.
  const bool ordinary = of.size > 0x1p-900 && of.size < 0x1p1000;
  if (ordinary && of.x > 0x1p-4 * of.size) {
    const double r = of.y / of.x;
    if (std::abs(r) > 0x1p-5) return std::atan(r) / kTurn;
    const double q = r * r;  // the next term is below 2^-57 r
    return r * (1 - q * (1 / 3.0 - q * (1 / 5.0 - q * (1 / 7.0 - q * (1 / 9.0 - q / 11.0))))) /
           kTurn;
  }
  if (ordinary && y > 0x1p-4 * of.size) return std::atan2(of.y, of.x) / kTurn;
  return accurateAngle(p, t);
}

}  // namespace kios
