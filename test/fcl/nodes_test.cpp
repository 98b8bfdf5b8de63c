// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Our traversal nodes under FCL's own recursion: front lists, self-collision, queues, reuse.

#include <gtest/gtest.h>

#include <fcl/narrowphase/detail/collision_func_matrix.h>
#include <fcl/narrowphase/detail/distance_func_matrix.h>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

using CollisionNode = MeshCollisionTraversalNode<double>;
using DistanceNode = MeshDistanceTraversalNode<double>;

class Nodes : public ::testing::Test {
 protected:
  // B approaches A, passes through it and leaves.
  std::vector<Frame> passage(int frames) const {
    std::vector<Frame> result;
    const auto turns = scenes::randomPoses(2, 0, 101);
    for (int i = 0; i < frames; ++i) {
      Frame frame{turns[0], turns[1]};
      frame.X_WB.translation() = Vector3d(4.0 * i / frames - 2, 0.3, 0.1 * i / frames);
      result.push_back(frame);
    }
    return result;
  }

  const Mesh mesh_a_ = scenes::bumpyTorus(300), mesh_b_ = scenes::bumpyTorus(200);
  const std::shared_ptr<Modeld> model_a_ = kiosModel(mesh_a_), model_b_ = kiosModel(mesh_b_);
  const Modeld &a_ = *model_a_, &b_ = *model_b_;
  const scenes::MeshOracle oracle_{mesh_a_, mesh_b_};
};

TEST_F(Nodes, CollisionWithAFrontListThatMoves) {
  CollisionNode node;  // one node for all
  fcl::detail::BVHFrontList front;
  std::size_t contacts = 0;
  for (const Frame& frame : passage(60)) {
    fcl::CollisionResultd result;
    ASSERT_TRUE(initialize(node, a_, frame.X_WA, b_, frame.X_WB,
                           fcl::CollisionRequestd(kAllContacts), result));
    fcl::detail::collide<double>(&node, &front);
    EXPECT_EQ(contactPairs(result), oracle_.collidingPairs(frame.X_WA, frame.X_WB));
    EXPECT_FALSE(front.empty());
    contacts += result.numContacts();
  }
  EXPECT_GT(contacts, 0u);
}

TEST_F(Nodes, DistanceWithQueuesAndFrontLists) {
  DistanceNode node;  // one node for all
  for (const Frame& frame : passage(30)) {
    const double exact = oracle_.distance(frame.X_WA, frame.X_WB);
    for (const int qsize : {0, 2, 3, 7, 100}) {
      fcl::DistanceResultd result;
      ASSERT_TRUE(
          initialize(node, a_, frame.X_WA, b_, frame.X_WB, fcl::DistanceRequestd(true), result));
      fcl::detail::BVHFrontList front;
      fcl::detail::distance<double>(&node, qsize == 7 ? &front : nullptr, qsize);
      EXPECT_NEAR(result.min_distance, exact, 2e-12);
      EXPECT_EQ(result.min_distance == 0, exact == 0);
      if (exact == 0) continue;
      EXPECT_LE(distanceToTriangle(result.nearest_points[0], frame.X_WA, mesh_a_, result.b1),
                2e-12);
      EXPECT_LE(distanceToTriangle(result.nearest_points[1], frame.X_WB, mesh_b_, result.b2),
                2e-12);
    }
  }
}

// Each unordered pair of different triangles is tested once, and decided exactly. Neighbours touch,
// so the mesh that has them lies where the relative pose rounds nothing.
TEST_F(Nodes, SelfCollision) {
  const Transform3d here = Transform3d::Identity(), X_random = scenes::randomPoses(1, 2, 102)[0];
  const Mesh soup = scenes::randomSoup(90, 0.6, 1e-2, 1, 103);
  for (const auto& [mesh, X] : {std::pair(soup, here), {soup, X_random}, {mesh_a_, here}}) {
    const auto model = kiosModel(mesh);
    const Modeld& m = *model;
    CollisionNode node;
    fcl::CollisionResultd result;
    ASSERT_TRUE(initialize(node, m, X, m, X, fcl::CollisionRequestd(kAllContacts), result));
    fcl::detail::selfCollide<double>(&node);
    const Pairs found = contactPairs(result);
    EXPECT_EQ(found.size(), result.numContacts());
    EXPECT_FALSE(found.empty());
    const Pairs all = leafPairs(mesh, mesh, {X, X});
    const auto among = [](const Pairs& pairs, int i, int j) {
      return std::binary_search(pairs.begin(), pairs.end(), std::pair(i, j));
    };
    for (int i = 0; i < m.num_tris; ++i) {
      EXPECT_FALSE(among(found, i, i));
      for (int j = 0; j < i; ++j) {
        EXPECT_EQ(among(found, i, j) + among(found, j, i), among(all, i, j));
      }
    }
  }
}

// FCL's generic initialize() takes our nodes as their base class, moves the models and knows
// nothing of the relative pose; neither a qualified call nor arguments that aren't const may end
// there.
TEST_F(Nodes, InitializeIsOursHoweverItIsCalled) {
  Modeld a(a_), b(b_);
  const fcl::CollisionRequestd all(kAllContacts);
  const fcl::DistanceRequestd request;
  for (const bool qualified : {false, true}) {
    for (Frame frame : passage(4)) {
      Transform3d &X = frame.X_WA, &Y = frame.X_WB;
      CollisionNode collision;
      DistanceNode distance;
      fcl::CollisionResultd contacts;
      fcl::DistanceResultd result;
      ASSERT_TRUE(qualified ? fcl::detail::initialize(collision, a, X, b, Y, all, contacts)
                            : initialize(collision, a, X, b, Y, all, contacts));
      ASSERT_TRUE(qualified ? fcl::detail::initialize(distance, a, X, b, Y, request, result)
                            : initialize(distance, a, X, b, Y, request, result));
      EXPECT_TRUE(std::equal(a.vertices, a.vertices + a.num_vertices, a_.vertices));
      EXPECT_TRUE(std::equal(b.vertices, b.vertices + b.num_vertices, b_.vertices));
      ASSERT_TRUE(collision.X_AB.has_value() && distance.X_AB.has_value());
      fcl::detail::collide<double>(&collision);
      EXPECT_EQ(contactPairs(contacts), oracle_.collidingPairs(X, Y));
      fcl::detail::distance<double>(&distance);
      EXPECT_NEAR(result.min_distance, oracle_.distance(X, Y), 2e-12);
      // Mixtures compile, too.
      const Transform3d there = Y;
      EXPECT_TRUE(initialize(collision, a, X, b_, there, all, contacts));
      EXPECT_TRUE(initialize(collision, a_, there, b, Y, all, contacts));
      EXPECT_TRUE(initialize(distance, a, there, b, there, request, result));
    }
  }
}

// FCL's own functions for two models of one volume copy and move them; slow, but right.
TEST_F(Nodes, FclsGenericFunctions) {
  for (const Frame& frame : passage(12)) {
    fcl::DistanceResultd distance;
    fcl::detail::BVHDistance<kIOSd>(&a_, frame.X_WA, &b_, frame.X_WB, fcl::DistanceRequestd(),
                                    distance);
    EXPECT_NEAR(distance.min_distance, oracle_.distance(frame.X_WA, frame.X_WB), 1e-11);
    fcl::CollisionResultd contacts;
    fcl::detail::BVHCollide<kIOSd>(&a_, frame.X_WA, &b_, frame.X_WB,
                                   fcl::CollisionRequestd(kAllContacts), contacts);
    EXPECT_EQ(contactPairs(contacts), oracle_.collidingPairs(frame.X_WA, frame.X_WB));
  }
}

TEST_F(Nodes, CostSourcesAreThoseOfTheQuery) {
  std::size_t sources = 0;
  for (const Frame& frame : passage(20)) {
    for (const std::size_t most : {std::size_t{3}, kAllContacts}) {
      const fcl::CollisionRequestd request(kAllContacts, false, most, true);
      fcl::CollisionResultd query, nodes;
      fcl::collide(&a_, frame.X_WA, &b_, frame.X_WB, request, query);
      CollisionNode node;
      ASSERT_TRUE(initialize(node, a_, frame.X_WA, b_, frame.X_WB, request, nodes));
      fcl::detail::collide<double>(&node);
      EXPECT_EQ(contactPairs(nodes), contactPairs(query));
      std::vector<fcl::CostSourced> costs, expected;
      nodes.getCostSources(costs);
      query.getCostSources(expected);
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

TEST_F(Nodes, CollisionTestsFewVolumes) {
  CollisionNode node;
  fcl::CollisionResultd result;
  Transform3d X = Transform3d::Identity();
  const auto tests = [&](double gap) {
    X.translation() = Vector3d(2.93 + gap, 0, 0);  // the tori's rims are 2.9 apart at most
    initialize(node, a_, Transform3d::Identity(), b_, X, fcl::CollisionRequestd(), result);
    node.enable_statistics = true;
    node.num_bv_tests = node.num_leaf_tests = 0;
    fcl::detail::collide<double>(&node);
    EXPECT_FALSE(result.isCollision());
    EXPECT_EQ(node.num_leaf_tests, 0);
    return node.num_bv_tests;
  };
  EXPECT_EQ(tests(1), 1);
  EXPECT_LT(tests(0.1), 100);
}

TEST_F(Nodes, StatisticsAreCountedOnDemand) {
  const Frame frame = passage(4).front();
  DistanceNode node;
  fcl::DistanceResultd other, result;
  initialize(node, b_, frame.X_WA, b_, frame.X_WB, fcl::DistanceRequestd(), other);
  fcl::detail::distance<double>(&node);  // of other models
  initialize(node, a_, frame.X_WA, b_, frame.X_WB, fcl::DistanceRequestd(), result);
  fcl::detail::distance<double>(&node);
  EXPECT_NEAR(result.min_distance, oracle_.distance(frame.X_WA, frame.X_WB), 2e-12);
  EXPECT_EQ(node.num_bv_tests, 0);
  EXPECT_EQ(node.num_leaf_tests, 0);
  const double d = result.min_distance;
  node.enable_statistics = true;
  result.clear();  // the same node once more, into a fresh result
  fcl::detail::distance<double>(&node);
  EXPECT_EQ(result.min_distance, d);
  EXPECT_GT(node.num_bv_tests, 0);
  EXPECT_GT(node.num_leaf_tests, 0);
  EXPECT_LT(node.num_leaf_tests, a_.num_tris);
}

}  // namespace
}  // namespace kios::testing
