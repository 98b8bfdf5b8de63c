// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Newton's method for the nearest point of an ellipsoid, and the early end of its distances by the
// slab where a triangle is nearest in units of the radii.

#include <gtest/gtest.h>

#include <cmath>

#include "not_finite.h"
#include "shape/nearest_point.h"
#include "shape/solid_cases.h"

namespace kios::testing {
namespace {

using shape::Solid;
using shape::Triangle;
using shape::Vec;

// Radii from 1e-9 of the largest, points from far away to 1e-12 off the surface, on axes and planes
// of symmetry.
TEST(Ellipsoid, NearestPointsAreExact) {
  SolidCases cases(71);
  Real worst = 0;
  double off_surface = 0;
  for (int i = 0; i < 30000; ++i) {
    Solid s;
    s.kind = shape::Kind::kEllipsoid;
    for (int c = 0; c < 3; ++c) s.half[c] = cases.pick(2) ? 1.0 : cases.power(-9, 0);
    Vec u = cases.vector().normalized();
    for (int c = 0; c < 3; ++c) {
      if (cases.pick(4) == 0) u[c] = cases.pick(2) ? 0.0 : u[c] * cases.power(-12, 0);
    }
    if (!(u.norm() > 0)) continue;
    const Vec on = s.half.cwiseProduct(u.normalized());
    const Vec p = cases.pick(3) ? Vec(on + cases.power(-12, 3) * cases.vector())
                                : Vec(on * (1 + cases.power(-12, 3)));
    const Real exact = pointLevel(s, p.cast<Real>());  // by bisection
    const auto q = shape::nearestPoint(s, p);
    if (!(exact > 0)) continue;
    const Real size = p.norm() + s.half.maxCoeff();
    worst = std::max(worst, std::abs(q.distance - exact) / size);
    off_surface = std::max(off_surface, q.on_shape.cwiseQuotient(s.half).norm() - 1);
    EXPECT_NEAR(q.normal.norm(), 1, 1e-14);
  }
  EXPECT_LE(worst, 0x1p-49L);
  EXPECT_LE(off_surface, 0x1p-49);
}

// A distance that ends early is no more than an upper bound, and only where that is farther than
// was asked; one that doesn't is the same, bitwise.
TEST(Ellipsoid, FarTrianglesEndEarly) {
  SolidCases cases(72);
  int ended = 0, nearer = 0;
  for (int i = 0; i < 20000; ++i) {
    const Size size = kSizes[cases.pick(3)];
    const Solid s = cases.solid(shape::Kind::kEllipsoid, size);
    const Triangle t = cases.triangle(cases.power(-1, 1) * cases.vector(), cases.power(-3, 1));
    const auto full = shape::distance(s, t, kInfinity);
    if (full.distance == 0) continue;
    const double L = s.reach() + shape::sizeOf(t);
    const double enough = full.distance * (1 + (cases.pick(2) ? 1 : -1) * cases.power(-16, 0));
    const auto d = shape::distance(s, t, enough);
    if (d.distance != full.distance) {
      ++ended;
      EXPECT_GE(d.distance, full.distance - 0x1p-43 * L);
      EXPECT_GE(full.distance, enough - 0x1p-43 * L);
      EXPECT_LE(d.lower, full.distance + 0x1p-43 * L);
    } else if (full.distance > enough + 0x1p-43 * L) {
      continue;
    } else {
      ++nearer;
    }
  }
  EXPECT_GT(ended, 1000);
  EXPECT_GT(nearer, 1000);
}

}  // namespace
}  // namespace kios::testing
