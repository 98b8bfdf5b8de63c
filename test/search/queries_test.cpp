// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance over prepared trees: FCL's requests, and the way out where floats
// can't serve.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

const Transform3d kHere = Transform3d::Identity();

/// Returns the distance, and that it was searched where it should be.
double distanceOf(const Modeld& a, const Frame& frame, const Modeld& b, long long tree_searches,
                  const fcl::DistanceRequestd& request = fcl::DistanceRequestd()) {
  fcl::DistanceResultd result;
  SearchCounts counts;
  const double d = distanceMeshes(a, frame.X_WA, b, frame.X_WB, request, result, &counts);
  EXPECT_EQ(counts.tree_searches, tree_searches);
  EXPECT_GT(counts.expansions + counts.leaf_pairs, 0);
  return d;
}

TEST(EngineQueries, ContactsUpToAnyNumber) {
  int touching = 0;
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    const auto a = kiosModel(c.a), b = kiosModel(c.b);
    prepare(*a);
    prepare(*b);
    for (const Frame& frame : randomFrames(12, c.spread, 21)) {
      const Pairs expected = leafPairs(c.a, c.b, frame);
      touching += !expected.empty();
      for (const std::size_t most : {std::size_t{1}, std::size_t{5}, kAllContacts}) {
        for (const bool contacts : {false, true}) {
          fcl::CollisionResultd result;
          SearchCounts counts;
          const fcl::CollisionRequestd request(most, contacts);
          const std::size_t n =
              collideMeshes(*a, frame.X_WA, *b, frame.X_WB, request, result, &counts);
          EXPECT_EQ(counts.tree_searches, 0);
          EXPECT_EQ(n, result.numContacts());
          EXPECT_EQ(n > 0, !expected.empty());
          const Pairs found = contactPairs(result);
          EXPECT_TRUE(std::includes(expected.begin(), expected.end(), found.begin(), found.end()));
          EXPECT_LE(n, most);
          EXPECT_TRUE(contacts || n == std::min(most, expected.size()));
          EXPECT_TRUE(most < kAllContacts || found == expected);
        }
      }
    }
  }
  EXPECT_GT(touching, 20);
}

// Contacts that a result holds on entry are kept, and count.
TEST(EngineQueries, ResultsAreAddedTo) {
  const Mesh mesh = scenes::icosphere(1, 1);
  const auto a = kiosModel(mesh), b = kiosModel(mesh);
  const Transform3d X(Eigen::Translation3d(0.4, 0.3, 0.2));
  fcl::CollisionResultd result;
  fcl::collide(a.get(), kHere, b.get(), X, fcl::CollisionRequestd(3), result);
  EXPECT_EQ(result.numContacts(), 3u);
  const fcl::Contactd first = result.getContact(0);
  EXPECT_EQ(fcl::collide(a.get(), kHere, b.get(), X, fcl::CollisionRequestd(5), result), 5u);
  EXPECT_EQ(result.getContact(0).b1, first.b1);
  EXPECT_EQ(fcl::collide(a.get(), kHere, b.get(), X, fcl::CollisionRequestd(5), result), 5u);
}

TEST(EngineQueries, BoundsAndErrorsOfRequests) {
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    const auto a = kiosModel(c.a), b = kiosModel(c.b);
    const double slack = 32 * 0x1p-52 * (extent(c.a) + extent(c.b) + 4 * c.spread);
    for (const Frame& frame : randomFrames(8, 2 * c.spread, 22)) {
      const double exact = leafDistance(c.a, c.b, frame);
      EXPECT_NEAR(distanceOf(*a, frame, *b, 0), exact, slack);
      for (const double rel_err : {0.0, 0.01, 0.5}) {
        for (const double abs_err : {0.0, 0.05}) {
          const fcl::DistanceRequestd request(true, false, rel_err, abs_err);
          const double d = distanceOf(*a, frame, *b, 0, request);
          EXPECT_GE(d, exact - slack);
          EXPECT_LE(d, exact + std::max(rel_err * exact, abs_err) + slack);
        }
      }
      for (const double bound : {0.5 * exact, exact + 1e-6, 2 * exact}) {
        if (!(bound > 0)) continue;
        fcl::DistanceResultd result;
        result.min_distance = bound;
        const double d = fcl::distance(a.get(), frame.X_WA, b.get(), frame.X_WB,
                                       fcl::DistanceRequestd(), result);
        EXPECT_EQ(d, result.min_distance);
        EXPECT_EQ(result.o1 == nullptr, bound < exact);
        EXPECT_NEAR(d, std::min(bound, exact), slack);
      }
    }
  }
}

TEST(EngineQueries, ScalesBeyondFloatsAreSearchedInDouble) {
  const Mesh one = scenes::bumpyTorus(140), other = scenes::icosphere(0.6, 1);
  const auto scaled = [](Mesh mesh, double scale) {
    for (Vector3d& p : mesh.vertices) p *= scale;
    return mesh;
  };
  for (const double scale : {1e-20, 1e-13, 1e-3, 1.0, 1e8, 1e15}) {
    const Mesh mesh_a = scaled(one, scale), mesh_b = scaled(other, scale);
    const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);
    const bool beyond = scale < 1e-10 || scale > 1e12;
    for (Frame frame : randomFrames(8, 1.5, 23)) {
      frame.X_WA.translation() *= scale;
      frame.X_WB.translation() *= scale;
      const double exact = leafDistance(mesh_a, mesh_b, frame);
      EXPECT_NEAR(distanceOf(*a, frame, *b, beyond), exact, 1e-14 * scale);
      EXPECT_EQ(distanceOf(*a, frame, *b, beyond) == 0, exact == 0);
      fcl::CollisionResultd contacts;
      fcl::collide(a.get(), frame.X_WA, b.get(), frame.X_WB, fcl::CollisionRequestd(kAllContacts),
                   contacts);
      EXPECT_EQ(contactPairs(contacts), leafPairs(mesh_a, mesh_b, frame));
    }
  }
}

// A mesh whose points are all one has no extent.
TEST(EngineQueries, Points) {
  const Mesh point = scenes::singleTriangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
  const Mesh ball = scenes::icosphere(0.5, 1);
  const auto a = kiosModel(point), b = kiosModel(ball);
  for (const Frame& frame : randomFrames(10, 1, 24)) {
    EXPECT_NEAR(distanceOf(*a, frame, *b, 0), leafDistance(point, ball, frame), 1e-14);
    EXPECT_NEAR(distanceOf(*b, {frame.X_WB, frame.X_WA}, *a, 0),
                leafDistance(ball, point, {frame.X_WB, frame.X_WA}), 1e-14);
  }
}

TEST(EngineQueries, FarApartInDoubleAndOfVeryDifferentSize) {
  const Mesh mesh = scenes::icosphere(1, 1);
  Mesh small = mesh;
  for (Vector3d& p : small.vertices) p *= 1e-7;
  const auto a = kiosModel(mesh), b = kiosModel(small);
  for (const Frame& frame : randomFrames(5, 1, 25)) {
    const Frame far = {frame.X_WA, Eigen::Translation3d(1e7, 0, -3) * frame.X_WB};
    const double exact = leafDistance(mesh, mesh, far);
    EXPECT_NEAR(distanceOf(*a, far, *a, 1), exact, 1e-15 * exact);
    EXPECT_NEAR(distanceOf(*a, frame, *b, 0), leafDistance(mesh, small, frame), 1e-14);
  }
}

// Far from the world's origin together, and from their own: only what is between the two counts.
TEST(EngineQueries, OffsetsCostNothing) {
  Mesh mesh = scenes::bumpyTorus(140);
  for (Vector3d& p : mesh.vertices) p += Vector3d(0x1p20, -0x1p20, 0x1p19);
  const auto a = kiosModel(mesh);
  for (const Transform3d& X : scenes::randomPoses(8, 1.5, 26)) {
    const Vector3d center(0x1p20, -0x1p20, 0x1p19);
    const Frame frame = {kHere, Eigen::Translation3d(center) * X * Eigen::Translation3d(-center)};
    EXPECT_NEAR(distanceOf(*a, frame, *a, 0), leafDistance(mesh, mesh, frame), 1e-14);
  }
}

TEST(EngineQueries, CostSourcesAreThoseOfFclsTree) {
  const auto a = kiosModel(scenes::icosphere(1, 1)), b = kiosModel(scenes::bumpyTorus(140));
  prepare(*a);
  prepare(*b);
  std::size_t sources = 0;
  for (const Frame& frame : randomFrames(20, 1.2, 28)) {
    for (const std::size_t most : {std::size_t{3}, kAllContacts}) {
      const fcl::CollisionRequestd request(kAllContacts, false, most, true);
      fcl::CollisionResultd ours, trees;
      SearchCounts counts;
      collideMeshes(*a, frame.X_WA, *b, frame.X_WB, request, ours, &counts);
      EXPECT_EQ(counts.tree_searches, 0);
      MeshCollisionTraversalNode<double> node;
      initialize(node, *a, frame.X_WA, *b, frame.X_WB, request, trees);
      fcl::detail::collide(&node);
      EXPECT_EQ(ours.numContacts(), trees.numContacts());
      std::vector<fcl::CostSourced> costs, expected;
      ours.getCostSources(costs);
      trees.getCostSources(expected);
      ASSERT_EQ(costs.size(), expected.size());
      for (std::size_t i = 0; i < costs.size(); ++i) {
        EXPECT_EQ(costs[i].total_cost, expected[i].total_cost);
        EXPECT_EQ(costs[i].aabb_min, expected[i].aabb_min);
      }
      sources += costs.size();
    }
  }
  EXPECT_GT(sources, 100U);
}

TEST(EngineQueries, FloatModels) {
  const Mesh mesh = scenes::bumpyTorus(140);
  const auto a = scenes::buildModel<kIOSf>(mesh);
  const auto b = scenes::buildModel<kIOSd>(mesh);
  for (const Frame& frame : randomFrames(12, 1.8, 27)) {
    fcl::DistanceResultf result;
    SearchCounts counts;
    const fcl::Transform3f X_WA = frame.X_WA.cast<float>(), X_WB = frame.X_WB.cast<float>();
    distanceMeshes(*a, X_WA, *a, X_WB, fcl::DistanceRequestf(), result, &counts);
    EXPECT_EQ(counts.tree_searches, 0);
    EXPECT_NEAR(result.min_distance, distanceOf(*b, frame, *b, 0), 2e-6);
  }
}

}  // namespace
}  // namespace kios::testing
