// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangle against solid where it is hard: bounds of points, and sets that touch.

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
