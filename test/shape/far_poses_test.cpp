// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The promises of docs/shapes.md through FCL's own calls: a triangle near a box, capsule, sphere or
// octree cell, both far from the world's origin, with triangles up to 1000 times as large.

#include <gtest/gtest.h>

#include <cmath>

#include <fcl/geometry/octree/octree.h>
#include <fcl_kios/fcl_kios.h>

#include "shape/shape_solid.h"
#include "shape/solid_cases.h"

namespace kios::testing {
namespace {

using fcl::Transform3d;
using shape::Kind;
using shape::Vec;

/// Returns FCL's shape of the sizes of a solid.
std::shared_ptr<fcl::CollisionGeometryd> shapeOf(const shape::Solid& s) {
  switch (s.kind) {
    case Kind::kBox:
      return std::make_shared<fcl::Boxd>(2 * s.half);
    case Kind::kCapsule:
      return std::make_shared<fcl::Capsuled>(s.radius, 2 * s.half_length);
    case Kind::kSphere:
      return std::make_shared<fcl::Sphered>(s.radius);
    default:
      throw std::invalid_argument("not here");
  }
}

/// Returns a pose of both, by exact rotations: about an axis by right angles.
Transform3d farPose(SolidCases& cases) {
  Transform3d X = Transform3d::Identity();
  X.linear() << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  if (cases.pick(2)) X.linear().setIdentity();
  X.translation() = cases.power(0, 6) * cases.vector();
  return X;
}

class FarPoses : public ::testing::TestWithParam<Kind> {};

TEST_P(FarPoses, PromisesAreKept) {
  SolidCases cases(51 + static_cast<int>(GetParam()));
  for (const Size size : {Size::kPlain, Size::kThin, Size::kZero}) {
    for (int i = 0; i < 400; ++i) {
      const NearPair pair = nearPair(cases, GetParam(), size);
      const auto geometry = shapeOf(pair.solid);
      const auto& t = pair.triangle;
      const auto model = makeModel<double>({t[0], t[1], t[2]}, {fcl::Triangle(0, 1, 2)});
      const Transform3d X = farPose(cases);
      fcl::DistanceResultd d;
      fcl::CollisionResultd c;
      const fcl::CollisionGeometryd& shape = *geometry;
      fcl::distance(model.get(), X, &shape, X, fcl::DistanceRequestd(true), d);
      fcl::collide(&shape, X, model.get(), X, fcl::CollisionRequestd(), c);
      const Real band = 0x1p-46L * pair.extent;
      if (d.min_distance > 0 && pair.depth == 0) {
        EXPECT_LE(std::abs(d.min_distance - pair.distance), band);
        // Nearest points are rounded in the world.
        const double world = X.translation().norm() + static_cast<double>(pair.extent);
        const double apart = (d.nearest_points[0] - d.nearest_points[1]).norm();
        EXPECT_NEAR(apart, d.min_distance, 0x1p-48 * world);
      }
      EXPECT_EQ(d.min_distance == 0, c.isCollision());
      EXPECT_FALSE(c.isCollision() && pair.distance > band);
      EXPECT_FALSE(!c.isCollision() && pair.depth > band);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FarPoses,
                         ::testing::Values(Kind::kBox, Kind::kSphere, Kind::kCapsule),
                         NameOfKind());

#if FCL_HAVE_OCTOMAP
// One cell, which isn't about the octree's origin.
TEST(OctreeCell, PromisesAreKept) {
  SolidCases cases(61);
  const double side = 0.5;
  auto tree = std::make_shared<octomap::OcTree>(side);
  tree->updateNode(octomap::point3d(0.75f, 1.25f, -0.25f), true);
  const fcl::OcTreed octree{std::shared_ptr<const octomap::OcTree>(tree)};
  const Vec center(0.75, 1.25, -0.25);
  for (int i = 0; i < 1500; ++i) {
    NearPair pair;
    pair.solid.kind = Kind::kBox;
    pair.solid.half.setConstant(side / 2);
    pair.faces = coreFaces(pair.solid);
    pair.triangle = cases.triangle(cases.vector(), cases.power(-3, 3));
    setGap(cases.power(-14, -1), pair);
    // As the mesh stores it: about the octree's origin, rounded.
    std::vector<fcl::Vector3d> stored;
    for (Vec& p : pair.triangle) {
      stored.push_back(p + center);
      p = stored.back() - center;
    }
    measure(pair);
    const auto model = makeModel<double>(stored, {fcl::Triangle(0, 1, 2)});
    fcl::DistanceResultd d;
    fcl::CollisionResultd c;
    const Transform3d I = Transform3d::Identity();
    const fcl::CollisionGeometryd& cell = octree;
    fcl::distance(model.get(), I, &cell, I, fcl::DistanceRequestd(), d);
    fcl::collide(model.get(), I, &cell, I, fcl::CollisionRequestd(), c);
    const Real band = 0x1p-46L * (pair.extent + center.norm());
    if (pair.depth == 0) {
      EXPECT_LE(std::abs(d.min_distance - pair.distance), band);
    }
    EXPECT_FALSE(c.isCollision() && pair.distance > band);
    EXPECT_FALSE(!c.isCollision() && pair.depth > band);
  }
}
#endif

}  // namespace
}  // namespace kios::testing
