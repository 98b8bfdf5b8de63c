// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangle against solid where it is hard: nearly touching, touching, flat and tiny shapes,
// slivers, great distances and scales.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "not_finite.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"

namespace kios::testing {
namespace {

using shape::Kind;
using shape::Solid;
using shape::Triangle;
using shape::Vec;

constexpr Shape kBounded[] = {Shape::kBox,  Shape::kSphere,   Shape::kEllipsoid, Shape::kCapsule,
                              Shape::kCone, Shape::kCylinder, Shape::kConvex};

Vec randomUnit(scenes::Random& random) {
  Vec n;
  do {
    n = Vec(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  } while (n.norm() < 0.1 || n.norm() > 1);
  return n.normalized();
}

class HardCases : public ::testing::TestWithParam<Shape> {};

// A triangle whose inside, edge or corner is `gap` above the shape's support point along n: the
// distance is `gap` by construction, the sign of which is the verdict.
TEST_P(HardCases, NearlyTouching) {
  scenes::Random random(21);
  double worst = 0, witness = 0;
  for (int i = 0; i < 3000; ++i) {
    const ShapeSpec spec = randomShape(GetParam(), random);
    const auto geometry = makeShape<double>(spec);
    const Solid solid = toSolid(*geometry);
    const Vec n = randomUnit(random), u = n.unitOrthogonal(), v = n.cross(u);
    const Vec p = shape::coreSupport(solid, n) + solid.margin() * n;
    const double gap = std::pow(10.0, random.uniform(-15, -1)) * (random.unit() < 0.5 ? 1 : -1);
    const double size = std::pow(10.0, random.uniform(-4, 1));
    const Vec at = p + gap * n;
    const auto away = [&](double lift) {
      const double a = random.uniform(-M_PI, M_PI);
      return Vec(at + size * (std::cos(a) * u + std::sin(a) * v + lift * n));
    };
    Triangle t;
    switch (i % 3) {
      case 0:  // a corner
        t = {at, away(random.unit()), away(random.unit())};
        break;
      case 1: {  // an edge
        const double a = random.uniform(-M_PI, M_PI);
        const Vec d = size * (std::cos(a) * u + std::sin(a) * v);
        t = {Vec(at + d), Vec(at - random.uniform(0.1, 1) * d), away(random.unit())};
        break;
      }
      default: {  // the inside
        const double a = random.uniform(-M_PI, M_PI);
        for (int k = 0; k < 3; ++k) {
          t[k] =
              at + size * (std::cos(a + 2 * M_PI * k / 3) * u + std::sin(a + 2 * M_PI * k / 3) * v);
        }
      }
    }
    const double scale = solid.reach() + std::max({t[0].norm(), t[1].norm(), t[2].norm()});
    const auto d = shape::distance(solid, t, kInfinity);
    EXPECT_EQ(d.distance == 0, shape::intersects(solid, t));
    if (gap > 1e-14 * scale) {
      EXPECT_GT(d.distance, 0) << gap << " " << i % 3;
    } else if (gap < 0 && level(spec, at.cast<Real>(), false) < -1e-14 * scale) {  // not beyond it
      EXPECT_EQ(d.distance, 0) << gap << " " << i % 3;
    }
    if (gap < 0) continue;
    worst = std::max(worst, std::abs(d.distance - gap) / scale);
    witness = std::max(witness, std::abs((d.on_triangle - d.on_shape).norm() - d.distance) / scale);
  }
  EXPECT_LE(worst, 1e-13);
  EXPECT_LE(witness, 1e-14);
}

// Distances scale with the pair, and great distances are right to rounding.
TEST_P(HardCases, ScalesAndFarTriangles) {
  scenes::Random random(22);
  for (int i = 0; i < 60; ++i) {
    const ShapeSpec spec = randomShape(GetParam(), random);
    const auto geometry = makeShape<double>(spec);
    const Solid solid = toSolid(*geometry);
    const double away = std::pow(10.0, random.uniform(0, 9));
    const Vec n = randomUnit(random), center = away * n;
    const Triangle t = {center + randomUnit(random), center + randomUnit(random),
                        center + randomUnit(random)};
    const auto d = shape::distance(solid, t, kInfinity);
    const double expected = static_cast<double>(
        oracleDistance(spec, {t[0].cast<Real>(), t[1].cast<Real>(), t[2].cast<Real>()}));
    EXPECT_NEAR(d.distance, expected, 1e-14 * (away + 3));
    for (const double scale : {0x1p-90, 0x1p-20, 0x1p20, 0x1p90}) {
      Solid scaled = solid;
      scaled.half *= scale;
      scaled.radius *= scale;
      scaled.half_length *= scale;
      for (Vec& p : scaled.points) p *= scale;
      const auto s = shape::distance(
          scaled, {Vec(scale * t[0]), Vec(scale * t[1]), Vec(scale * t[2])}, kInfinity);
      EXPECT_NEAR(s.distance / scale, d.distance, 1e-14 * (away + 3));
    }
  }
}

// Shapes without an inside: points, segments, disks.
TEST_P(HardCases, FlatShapes) {
  scenes::Random random(23);
  for (int i = 0; i < 200; ++i) {
    const auto geometry = makeShape<double>(randomShape(GetParam(), random));
    Solid solid = toSolid(*geometry);
    const int which = i % 4;
    if (which == 0 || which == 3) solid.radius = solid.half[0] = 0;
    if (which == 1 || which == 3) solid.half_length = solid.half[2] = 0;
    for (Vec& p : solid.points) p[which % 3] = 0;
    const Vec n = randomUnit(random), p = shape::coreSupport(solid, n) + solid.margin() * n;
    const double gap = std::pow(10.0, random.uniform(-9, 0));
    const Vec u = n.unitOrthogonal(), v = n.cross(u), at = p + gap * n;
    const Triangle t = {Vec(at + u), Vec(at - u + v), Vec(at - u - v)};
    const auto d = shape::distance(solid, t, kInfinity);
    EXPECT_NEAR(d.distance, gap, 1e-12);
    EXPECT_TRUE(d.on_triangle.allFinite() && d.on_shape.allFinite());
    // through the support point
    const Vec w = randomUnit(random);
    const Triangle through = {Vec(p + w), Vec(p - w + v), Vec(p - w - v)};
    EXPECT_LE(shape::distance(solid, through, kInfinity).distance, 1e-13);
    const auto c = shape::contact(solid, {p, p, p});
    EXPECT_TRUE(c.position.allFinite() && c.normal.allFinite());
    EXPECT_NEAR(c.normal.norm(), 1, 1e-12);
    if (GetParam() != Shape::kEllipsoid) {  // whose exit is sought by steps
      EXPECT_LE(c.depth, 1e-13);
    }
  }
}

// The bound of points behind the pruning: never above the distance.
TEST_P(HardCases, PointBoundsAreBounds) {
  scenes::Random random(24);
  double loosest = 0;
  for (int i = 0; i < 2000; ++i) {
    const ShapeSpec spec = randomShape(GetParam(), random);
    const auto geometry = makeShape<double>(spec);
    const Solid solid = toSolid(*geometry);
    const Vec p = std::pow(10.0, random.uniform(-2, 2)) * randomUnit(random);
    const double exact = static_cast<double>(std::max(Real(0), level(spec, p.cast<Real>(), true)));
    const double bound = shape::pointBound(solid, p);
    EXPECT_LE(bound, exact + 0x1p-48 * (p.lpNorm<1>() + solid.reach()));
    if (exact > 0) loosest = std::max(loosest, (exact - bound) / exact);
  }
  if (GetParam() != Shape::kEllipsoid && GetParam() != Shape::kConvex) {
    EXPECT_LE(loosest, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, HardCases, ::testing::ValuesIn(kBounded), NameOfShape());

// Touching in coordinates that doubles hold: judged exactly.
TEST(Touching, ClosedSetsMeet) {
  Solid box;
  box.kind = Kind::kBox;
  box.half = Vec(0.5, 0.25, 0.75);
  Solid ball;
  ball.radius = 0.5;
  Solid cylinder;
  cylinder.kind = Kind::kCylinder;
  cylinder.radius = 0.5;
  cylinder.half_length = 0.75;
  Solid cone = cylinder;
  cone.kind = Kind::kCone;
  Solid capsule = cylinder;
  capsule.kind = Kind::kCapsule;
  capsule.half_length = 0.25;
  Solid ellipsoid = box;
  ellipsoid.kind = Kind::kEllipsoid;
  for (const Solid& s : {box, ball, cylinder, capsule, ellipsoid}) {
    const double x = 0.5;
    const Triangle at = {Vec(x, -1, -1), Vec(x, 3, -1), Vec(x, -1, 3)};
    EXPECT_TRUE(shape::intersects(s, at));
    EXPECT_EQ(shape::distance(s, at, kInfinity).distance, 0);
    const double above = x + 0x1p-40;
    const Triangle off = {Vec(above, -1, -1), Vec(above, 3, -1), Vec(above, -1, 3)};
    EXPECT_FALSE(shape::intersects(s, off));
    EXPECT_NEAR(shape::distance(s, off, kInfinity).distance, 0x1p-40, 1e-15);
  }
  for (const Solid& s : {box, cylinder, cone, capsule, ellipsoid}) {  // the top
    const Triangle at = {Vec(-1, -1, 0.75), Vec(3, -1, 0.75), Vec(-1, 3, 0.75)};
    EXPECT_TRUE(shape::intersects(s, at));
    EXPECT_EQ(shape::distance(s, at, kInfinity).distance, 0);
  }
}

}  // namespace
}  // namespace kios::testing
