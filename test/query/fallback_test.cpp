// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of lengths beyond floats are searched in double: with the same answers by every call,
// without looking at more than a depth-first search needs, and with budgets that never prove less.

#include <limits>

#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <gtest/gtest.h>
#include "all_pairs.h"
#include "fcl_kios/contact.h"
#include "fcl_kios/scene.h"
#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(Fallback);

template <typename S>
fcl::Transform3<S> poseNear(scenes::Random& random) {
  const auto seed = static_cast<std::uint64_t>(random.uniform(0, 1e9));
  fcl::Transform3<S> X = scenes::randomPoses(1, 1, seed)[0].cast<S>();
  X.translation() *= static_cast<S>(std::pow(10, random.uniform(-3, 1)));
  return X;
}

/// The factor by which meshes of about 1 become larger or smaller than floats can search.
template <typename S>
double beyondFloats(int i) {
  return std::ldexp(1.0, (i % 2 == 0 ? 1 : -1) * (sizeof(S) == sizeof(double) ? 300 : 48));
}

Mesh scaled(const Mesh& mesh, double by) { return transformed(mesh, by, fcl::Vector3d::Zero()); }

/// Two small soups of such lengths; edges are of `size` to 100 times that.
template <typename S>
struct SoupPair {
  SoupPair(int i, double size, scenes::Random& random)
      : scale(beyondFloats<S>(i)),
        a(modelOf<S>(scaled(
            scenes::randomSoup(1 + i % 23, 1, size, 100 * size, static_cast<std::uint64_t>(i)),
            scale))),
        b(modelOf<S>(scaled(
            scenes::randomSoup(1 + i % 13, 1, size, 100 * size, static_cast<std::uint64_t>(i) + 7),
            scale))),
        X_WA(poseNear<S>(random)),
        X_WB(poseNear<S>(random)) {
    X_WA.translation() *= static_cast<S>(scale);
    X_WB.translation() *= static_cast<S>(scale);
  }

  const double scale;
  const std::shared_ptr<Model<S>> a, b;
  fcl::Transform3<S> X_WA, X_WB;
};

TYPED_TEST(Fallback, EveryCallNamesTheNearestOfBruteForce) {
  using S = TypeParam;
  scenes::Random random(1);
  for (int i = 0; i < 400; ++i) {
    const SoupPair<S> pair(i, 1e-2, random);
    const auto& [scale, a, b, X_WA, X_WB] = pair;
    const AllPairs all(trianglesOf(*a), trianglesOf(*b), RelativePosed(X_WA, X_WB));
    const auto answer = kios::distanceBracket(*a, X_WA, *b, X_WB);
    ASSERT_EQ(answer.counts.tree_searches, 1);
    ASSERT_EQ(answer.distance, all.rounded<S>());
    fcl::DistanceResult<S> result;
    ASSERT_EQ(distanceMeshes(*a, X_WA, *b, X_WB, fcl::DistanceRequest<S>(), result),
              all.rounded<S>());
    fcl::CollisionResult<S> contacts;
    collideMeshes(*a, X_WA, *b, X_WB, fcl::CollisionRequest<S>(100000), contacts);
    ASSERT_EQ(contacts.numContacts(), all.hits.size());
    if (all.distance == 0) continue;
    ASSERT_EQ(std::make_pair(answer.triangle_a, answer.triangle_b), all.nearest);
    ASSERT_EQ(result.b1, all.nearest.first);
    ASSERT_EQ(result.b2, all.nearest.second);
  }
}

TYPED_TEST(Fallback, LargerBudgetsNeverProveLess) {
  using S = TypeParam;
  scenes::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    // Triangles so small that their volumes know their distance as well as the kernel does.
    const SoupPair<S> pair(i, i % 2 == 0 ? 1e-2 : 1e-7, random);
    const auto& [scale, a, b, X_WA, X_WB] = pair;
    const S exact = kios::distanceBracket(*a, X_WA, *b, X_WB).distance;
    S distance = std::numeric_limits<S>::infinity(), lower = 0;
    for (int budget = 0; budget < 30; ++budget) {
      DistanceBracketRequest<S> options;
      options.max_expansions = budget;
      const auto answer = kios::distanceBracket(*a, X_WA, *b, X_WB, options);
      ASSERT_LE(answer.distance, distance) << i << " " << budget;
      ASSERT_GE(answer.lower_bound, lower) << i << " " << budget;
      ASSERT_LE(answer.lower_bound, exact);
      distance = answer.distance;
      lower = answer.lower_bound;
    }
  }
}

TEST(FallbackWork, DistancesAreInDoubleVeryDifferentSizesAreNot) {
  const auto a = modelOf<double>(scenes::icosphere(1, 1)),
             small = modelOf<double>(scaled(scenes::icosphere(1, 1), 1e-7));
  const fcl::Transform3d here = fcl::Transform3d::Identity();
  for (const fcl::Transform3d& near : scenes::randomPoses(5, 1, 25)) {
    const fcl::Transform3d far = Eigen::Translation3d(1e7, 0, -3) * near;
    for (const auto& [b, X] : {std::pair(a, far), std::pair(small, near)}) {
      const AllPairs all(trianglesOf(*a), trianglesOf(*b), RelativePosed(here, X));
      const auto answer = kios::distanceBracket(*a, here, *b, X);
      EXPECT_EQ(answer.counts.tree_searches, b == a ? 1 : 0);
      EXPECT_NEAR(answer.distance, all.distance, 1e-14 + 1e-15 * all.distance);
    }
  }
}

// Overlapping models: volumes that overlap deeply don't make the search a breadth-first one.
TEST(FallbackWork, ContactsAreFoundOnTheWayDown) {
  const double scale = beyondFloats<double>(0);
  const auto torus = modelOf<double>(scaled(scenes::bumpyTorus(20000), scale));
  fcl::Transform3d X_B = fcl::Transform3d::Identity();
  for (const double shift : {0.0, 0.01, 0.3}) {
    X_B.translation().x() = scale * shift;
    const auto answer = kios::distanceBracket(*torus, fcl::Transform3d::Identity(), *torus, X_B);
    EXPECT_EQ(answer.distance, 0);
    EXPECT_LT(answer.counts.volume_tests, 5000) << shift;
  }
}

// Lengths near the least numbers of float: boxes and bounds of scenes pay for what vanishes.
TEST(FallbackWork, ScenesOfVanishingBodies) {
  scenes::Random random(3);
  int pairs = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(random.uniform(-146, -118)));
    SceneDistance<float> scene;
    std::vector<std::shared_ptr<Modelf>> models;
    std::vector<fcl::Transform3f> poses;
    for (int k = 0; k < 2; ++k) {
      Mesh mesh =
          scenes::randomSoup(1 + i % 3, size, 0.5, 1, static_cast<std::uint64_t>(2 * i + k));
      if (i % 2 == 0) {  // points
        for (fcl::Vector3d& v : mesh.vertices) v = mesh.vertices[0];
      }
      models.push_back(modelOf<float>(mesh));
      poses.push_back(
          scenes::randomPoses(1, 1, static_cast<std::uint64_t>(i + k))[0].cast<float>());
      poses.back().translation() *= static_cast<float>(3 * size);
      if (i % 4 < 2) poses.back().linear() = poses[0].linear();
      scene.add(models.back(), poses.back());
    }
    fcl::DistanceResultf result;
    const float d =
        distanceMeshes(*models[0], poses[0], *models[1], poses[1], fcl::DistanceRequestf(), result);
    const auto closest = scene.closestPair();
    ASSERT_TRUE(closest) << i << " " << d;
    ASSERT_EQ(closest->distance, d) << i;
    ASSERT_EQ(scene.pairsWithin(d).size(), 1u) << i;
    // It holds after a move that stays near.
    poses[1].translation().x() += static_cast<float>(1e-3 * size);
    scene.move(1, poses[1]);
    fcl::DistanceResultf moved;
    const float after =
        distanceMeshes(*models[0], poses[0], *models[1], poses[1], fcl::DistanceRequestf(), moved);
    ASSERT_EQ(scene.pairsWithin(after).size(), 1u) << i;
    ++pairs;
  }
  EXPECT_EQ(pairs, 20000);
}

}  // namespace
}  // namespace kios::testing
