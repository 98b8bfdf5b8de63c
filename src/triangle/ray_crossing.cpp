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

/// The side on which the turned ray passes the edge from corner i to j, relative to the origin, is
/// the sign of d . (i x j), by along_ray(i, j), else of its term in e, component(i, j, 0), else of
/// that in e^2. All three vanish only where the corners lie on a line with the origin.
template <typename Dot, typename Component>
Crossing turnedVerdict(Sign height, const Dot& along_ray, const Component& component) {
  Sign sides[3];
  for (int i = 0; i < 3; ++i) {
    const int j = kNext[i];
    sides[i] = along_ray(i, j);
    for (int axis = 0; axis < 2 && sides[i] == kZero; ++axis) sides[i] = component(i, j, axis);
  }
  return verdict(height, sides);
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
  if (unknown) return crossExactly(t, corners);
  const Sign height = filteredSign(t.from_origin[0], t.from_origin[1], t.from_origin[2]);
  if (height == kUnknown) return crossExactly(t, corners);
  return verdict(height, sides);
}

Crossing RayCrossing::crossExactly(const ScaledOrigin::Corners& t,
                                   const TriangleVertices<double>& corners) const {
  Magnitudes sizes;
  Expansion<2> p[3][3];
  for (int c = 0; c < 3; ++c) {
    sizes.add(origin_[c]);
    sizes.add(direction_[c]);
    for (int i = 0; i < 3; ++i) {
      sizes.add(t.corner[i][c]);
      p[i][c] = difference(t.corner[i][c], origin_[c]);
    }
  }
  if (!sizes.suitExpansions()) return crossInIntegers(corners);
  const auto row = [&](Expansion<2>(&m)[3][3], int r, int i) {
    for (int c = 0; c < 3; ++c) m[r][c] = p[i][c];
  };
  Expansion<2> m[3][3];
  for (int i = 0; i < 3; ++i) row(m, i, i);
  const Sign height = signOf(determinant(m));
  if (height == kZero) return ifOrigin(corners);
  const auto along_ray = [&](int i, int j) {
    for (int c = 0; c < 3; ++c) {
      m[0][c] = Expansion<2>();
      m[0][c].append(direction_[c]);
    }
    row(m, 1, i);
    row(m, 2, j);
    return signOf(determinant(m));
  };
  return turnedVerdict(height, along_ray, [&](int i, int j, int axis) {
    const int y = kNext[axis], z = kNext[y];
    return signOf(sum(product(p[i][y], p[j][z]), negated(product(p[i][z], p[j][y]))));
  });
}

Crossing RayCrossing::crossInIntegers(const TriangleVertices<double>& corners) const {
  const IntegerVector origin = integers(given_origin_), d = integers(direction_);
  IntegerVector p[3];
  for (int i = 0; i < 3; ++i) p[i] = integers(corners[i]) - origin;
  const Sign height = signOf(dot(p[0], kios::cross(p[1], p[2])));
  if (height == kZero) return ifOrigin(corners);
  return turnedVerdict(
      height, [&](int i, int j) { return signOf(dot(d, kios::cross(p[i], p[j]))); },
      [&](int i, int j, int axis) { return signOf(kios::cross(p[i], p[j])[axis]); });
}

Crossing RayCrossing::ifOrigin(const TriangleVertices<double>& corners) const {
  TriangleHit hit;
  return hitInIntegers({given_origin_, direction_, 0, 0, 0}, corners, hit) ? Crossing::kOrigin
                                                                           : Crossing::kNone;
}

}  // namespace kios
