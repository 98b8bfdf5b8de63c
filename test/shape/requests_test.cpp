// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Requests and results of a mesh over k-IOS against a shape: bounds and errors that are honoured,
// pruning, closed meshes, what is refused, and FCL's OBBRSS where that is right.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fcl/expect_refused.h"
#include "fcl/mesh_cases.h"
#include "shape/shape_oracle.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

double distanceOf(const Modeld& model, const fcl::CollisionGeometryd& shape, const Frame& frame,
                  const fcl::DistanceRequestd& request = fcl::DistanceRequestd()) {
  fcl::DistanceResultd result;
  return fcl::distance(&model, frame.X_WA, &shape, frame.X_WB, request, result);
}

class Requests : public ::testing::TestWithParam<Shape> {
 protected:
  Geometry shape(std::uint64_t seed) const {
    scenes::Random random(seed);
    return makeShape<double>(randomShape(GetParam(), random));
  }
};

TEST_P(Requests, BoundsAndErrorsAreHonouredAndNodesPruned) {
  const auto model = kiosModel(scenes::bumpyTorus(4000));
  long long exact_work = 0, loose_work = 0, leaves = 0, queries = 0;
  for (const Frame& frame : randomFrames(20, 3, 41)) {
    const Geometry s = shape(queries);
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    SearchCounts exact, loose;
    const double d = distanceShape(*model, frame.X_WA, *s, frame.X_WB, request, result, &exact);
    ++queries;
    leaves += exact.leaf_kernels;
    exact_work += exact.volume_tests;
    if (d == 0) continue;
    request.rel_err = 0.3;
    fcl::DistanceResultd near;
    distanceShape(*model, frame.X_WA, *s, frame.X_WB, request, near, &loose);
    loose_work += loose.volume_tests;
    EXPECT_GE(near.min_distance, d * (1 - 1e-13));
    EXPECT_LE(near.min_distance, 1.3 * d);
    request.rel_err = 0;
    request.abs_err = 0.05;
    const double off = distanceOf(*model, *s, frame, request);
    EXPECT_GE(off, d * (1 - 1e-13));
    EXPECT_LE(off, d + 0.05);
    request.abs_err = -1;
    EXPECT_THROW(distanceOf(*model, *s, frame, request), std::invalid_argument);
  }
  EXPECT_LT(leaves, queries * 4000 / 20);
  EXPECT_LT(exact_work, queries * 4000 / 5);
  EXPECT_LE(loose_work, exact_work);
}

// FCL is right about most of this scene: its verdicts, costs, and contacts that need no GJK.
TEST_P(Requests, AgreeWithObbrssModels) {
  const Mesh mesh = scenes::bumpyTorus(400);
  const auto ours = kiosModel(mesh);
  const auto theirs = scenes::buildModel<fcl::OBBRSSd>(mesh);
  const Shape kind = GetParam();
  const bool unbounded = kind == Shape::kPlane || kind == Shape::kHalfspace;
  const bool round = kind == Shape::kEllipsoid || kind == Shape::kCone || kind == Shape::kCylinder;
  int hits = 0;
  for (const Frame& frame : randomFrames(60, 1.2, 42)) {
    const Geometry s = shape(hits);
    fcl::CollisionResultd a, b;
    const fcl::CollisionRequestd request(kAllContacts, true, 100000, true, false);
    fcl::collide(ours.get(), frame.X_WA, s.get(), frame.X_WB, request, a);
    fcl::collide(theirs.get(), frame.X_WA, s.get(), frame.X_WB, request, b);
    EXPECT_EQ(contactPairs(a), contactPairs(b));
    hits += a.isCollision();
    std::vector<fcl::CostSourced> costs, their_costs;
    a.getCostSources(costs);
    b.getCostSources(their_costs);
    ASSERT_EQ(costs.size(), their_costs.size());
    for (std::size_t c = 0; c < costs.size(); ++c) {
      const double excess = costs[c].total_cost - their_costs[c].total_cost;
      EXPECT_LE(excess, 1e-12);
      // FCL's box of a turned round shape is that of its bounding box: larger.
      EXPECT_TRUE(round || excess >= -1e-12) << excess;
    }
    if (!unbounded && kind != Shape::kSphere) continue;
    ASSERT_EQ(a.numContacts(), b.numContacts());
    std::map<std::intptr_t, fcl::Contactd> by_triangle;
    for (std::size_t c = 0; c < b.numContacts(); ++c) {
      by_triangle[b.getContact(c).b1] = b.getContact(c);
    }
    for (std::size_t c = 0; c < a.numContacts(); ++c) {
      const fcl::Contactd &x = a.getContact(c), &y = by_triangle[x.b1];
      if (kind == Shape::kSphere) {  // FCL takes the last edge in reach; its depth is < 0
        EXPECT_GT(x.normal.dot(y.normal), 0);
        EXPECT_GE(x.penetration_depth, -y.penetration_depth - 1e-12);
        continue;
      }
      EXPECT_LE((x.normal - y.normal).norm(), 1e-7);
      EXPECT_NEAR(x.penetration_depth, y.penetration_depth, 1e-12);
      EXPECT_LE((x.pos - y.pos).norm(), 1e-9);
    }
  }
  EXPECT_GT(hits, 3);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Requests, ::testing::ValuesIn(kShapes), NameOfShape());

// Meshes are soups: a shape strictly inside a closed mesh doesn't touch it. Shapes are full: a mesh
// inside one does.
TEST(Nested, ShapesAreFullAndMeshesAreNot) {
  const auto shell = kiosModel(scenes::icosphere(2, 3)),
             small = kiosModel(scenes::icosphere(0.1, 1));
  const Frame here{Transform3d::Identity(), Transform3d::Identity()};
  scenes::Random random(9);
  for (const Shape kind : kShapes) {
    if (kind == Shape::kPlane || kind == Shape::kHalfspace) continue;
    ShapeSpec spec = randomShape(kind, random);
    spec.size.setConstant(0.9);
    if (kind == Shape::kConvex) spec.hull = scenes::icosphere(0.9, 1);
    const auto s = makeShape<double>(spec);
    const double apart = distanceOf(*shell, *s, here);
    EXPECT_GT(apart, 0.6) << nameOf(kind);
    EXPECT_LT(apart, 2) << nameOf(kind);
    fcl::CollisionResultd none, all;
    EXPECT_EQ(fcl::collide(shell.get(), here.X_WA, s.get(), here.X_WB, {}, none), 0u);
    EXPECT_EQ(distanceOf(*small, *s, here), 0) << nameOf(kind);
    fcl::collide(small.get(), here.X_WA, s.get(), here.X_WB,
                 fcl::CollisionRequestd(kAllContacts, true), all);
    EXPECT_EQ(all.numContacts(), static_cast<std::size_t>(small->num_tris)) << nameOf(kind);
  }
}

TEST(Refused, ShapesOfImpossibleSizes) {
  const auto model = kiosModel(scenes::icosphere(1, 1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [&](const fcl::CollisionGeometryd& shape, const std::string& what) {
    const Transform3d I = Transform3d::Identity();
    fcl::CollisionResultd contacts;
    fcl::DistanceResultd distance;
    expectRefused([&] { fcl::collide(model.get(), I, &shape, I, {}, contacts); }, what);
    expectRefused(
        [&] { fcl::distance(&shape, I, model.get(), I, fcl::DistanceRequestd(), distance); }, what);
    EXPECT_EQ(contacts.numContacts(), 0u);
    EXPECT_EQ(distance.o1, nullptr);
  };
  refused(fcl::Sphered(-1), "fcl::Sphere has radius -1");
  refused(fcl::Sphered(nan), "fcl::Sphere has radius");
  refused(fcl::Boxd(1, infinite, 1), "fcl::Box has side inf");
  refused(fcl::Capsuled(1, -2), "fcl::Capsule has length -2");
  refused(fcl::Coned(nan, 1), "fcl::Cone has radius");
  refused(fcl::Cylinderd(-1, 1), "fcl::Cylinder has radius -1");
  refused(fcl::Ellipsoidd(1, 1, -1), "fcl::Ellipsoid has radius -1");
  fcl::Planed plane(Vector3d::UnitZ(), 0);
  plane.n.setZero();
  refused(plane, "fcl::Plane has a normal of no direction");
  refused(fcl::Halfspaced(Vector3d::UnitZ(), nan), "fcl::Halfspace has an offset");
}

}  // namespace
}  // namespace kios::testing
