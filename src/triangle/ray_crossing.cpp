// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/ray_crossing.h"

#include "triangle/determinant.h"
#include "triangle/integer.h"
#include "triangle/ray_triangle.h"

namespace kios {
namespace {

Sign signOf(const Integer& v) { return static_cast<Sign>(v.sign()); }

Crossing verdict(Sign height, const Sign (&sides)[3]) {
  for (const Sign side : sides) {
    if (side != height) return Crossing::kNone;
  }
  return height > 0 ? Crossing::kForward : Crossing::kBackward;
}

}  // namespace

RayCrossing::RayCrossing(const Point<double>& origin, const Point<double>& direction,
                         double largest)
    : given_origin_(origin), direction_(direction), origin_(origin, largest) {}

// With u, v, w the corners relative to the origin and h = u . (v x w): the direction d is (d . (v x
// w) u + d . (w x u) v + d . (u x v) w) / h, so that the ray is in their cone if and only if the
// three sides have h's sign. The mesh's plane then lies ahead, and the ray leaves it along its
// normal if h > 0.
Crossing RayCrossing::cross(const TriangleVertices<double>& corners) const {
  ScaledOrigin::Corners t;
  if (!origin_.scale(corners, t)) return crossInIntegers(corners);
  Sign sides[3];
  bool left = false, right = false, unknown = false;
  for (int i = 0; i < 3; ++i) {
    sides[i] = filteredSign(direction_.data(), t.from_origin[i], t.from_origin[kNext[i]]);
    left |= sides[i] == kPlus;
    right |= sides[i] == kMinus;
    unknown |= sides[i] == kUnknown;
  }
  if (left && right) return Crossing::kNone;  // the line misses the closed triangle
  if (unknown) return crossInIntegers(corners);
  const Sign height = filteredSign(t.from_origin[0], t.from_origin[1], t.from_origin[2]);
  if (height == kUnknown) return crossInIntegers(corners);
  return verdict(height, sides);
}

// The side on which the turned ray passes the edge from corner i to j, relative to the origin, is
// the sign of d . (i x j), else of its term in e, that product's x, else of that in e^2. All three
// vanish only where the corners lie on a line with the origin.
Crossing RayCrossing::crossInIntegers(const TriangleVertices<double>& corners) const {
  const IntegerVector origin = integers(given_origin_), d = integers(direction_);
  IntegerVector p[3];
  for (int i = 0; i < 3; ++i) p[i] = integers(corners[i]) - origin;
  const Sign height = signOf(dot(p[0], kios::cross(p[1], p[2])));
  if (height == kZero) return ifOrigin(corners);
  Sign sides[3];
  for (int i = 0; i < 3; ++i) {
    const IntegerVector across = kios::cross(p[i], p[kNext[i]]);
    sides[i] = signOf(dot(d, across));
    for (int axis = 0; axis < 2 && sides[i] == kZero; ++axis) sides[i] = signOf(across[axis]);
  }
  return verdict(height, sides);
}

Crossing RayCrossing::ifOrigin(const TriangleVertices<double>& corners) const {
  TriangleHit hit;
  return hitInIntegers({given_origin_, direction_, 0, 0, 0}, corners, hit) ? Crossing::kOrigin
                                                                           : Crossing::kNone;
}

}  // namespace kios
