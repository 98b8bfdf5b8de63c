// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two models touch that nobody prepared: FCL's tree says it as long as that is cheaper.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "model/deform.h"

namespace kios::testing {
namespace {

bool touch(const Modeld& a, const Modeld& b, const Frame& frame, SearchCounts& counts) {
  fcl::CollisionResultd result;
  collideMeshes(a, frame.X_WA, b, frame.X_WB, fcl::CollisionRequestd(), result, &counts);
  return result.isCollision();
}

std::size_t bytesOf(const Modeld& a, const Modeld& b) {
  return preparedBytes(a) + preparedBytes(b);
}

TEST(Unprepared, TheVerdictIsTheSame) {
  for (const MeshCase& meshes : meshCases()) {
    SCOPED_TRACE(meshes.name);
    const auto a = modelAlone(meshes.a), b = modelAlone(meshes.b);
    prepare(*a);
    prepare(*b);
    int touching = 0;
    SearchCounts by_tree, by_engine;
    const auto frames = randomFrames(60, meshes.spread, 5);
    for (const Frame& frame : frames) {
      const auto fresh_a = kiosModel(meshes.a), fresh_b = kiosModel(meshes.b);
      const bool verdict = touch(*a, *b, frame, by_engine);
      EXPECT_EQ(touch(*fresh_a, *fresh_b, frame, by_tree), verdict);
      EXPECT_EQ(verdict, !leafPairs(meshes.a, meshes.b, frame).empty());
      touching += verdict;
    }
    EXPECT_GT(touching, 0);
    EXPECT_EQ(by_engine.tree_searches, 0);
    if (meshes.a.triangles.size() > 1) {
      EXPECT_GT(by_tree.tree_searches, 0);
    }
  }
}

TEST(Unprepared, ModelsArePreparedWhenItHasPaid) {
  const Mesh mesh = scenes::bumpyTorus(2000);
  const auto a = kiosModel(mesh), b = kiosModel(scenes::icosphere(0.5, 2));
  SearchCounts counts;
  int asked = 0;
  while (bytesOf(*a, *b) == 0 && asked < 100000) {
    for (const Frame& frame : randomFrames(10, 1.3, static_cast<std::uint64_t>(++asked))) {
      touch(*a, *b, frame, counts);
    }
  }
  // 50 ns a test, and 0.2 us a triangle to prepare.
  EXPECT_GT(counts.volume_tests + 4 * counts.leaf_pairs, 4 * a->num_tris);
  EXPECT_LT(counts.volume_tests + 4 * counts.leaf_pairs, 5 * a->num_tris);
  EXPECT_GT(preparedBytes(*a), 0U);
  EXPECT_GT(preparedBytes(*b), 0U);
  counts = {};
  for (const Frame& frame : randomFrames(50, 1.3, 3)) touch(*a, *b, frame, counts);
  EXPECT_EQ(counts.tree_searches, 0);
}

// A search of trees would take as long as a walk that the first nodes decide: who asks no more than
// that waits for trees, but not for ever.
TEST(Unprepared, ShortWalksPrepareLate) {
  const Mesh mesh = scenes::bumpyTorus(300);
  const auto a = kiosModel(mesh), b = kiosModel(mesh);
  std::vector<Frame> short_walks;
  for (const Frame& frame : randomFrames(200, 1.6, 7)) {
    const auto fresh_a = kiosModel(mesh), fresh_b = kiosModel(mesh);
    SearchCounts counts;
    touch(*fresh_a, *fresh_b, frame, counts);
    const long long tests = counts.volume_tests + 4 * counts.leaf_pairs;
    if (counts.tree_searches == 1 && tests >= 8 && tests <= 16) short_walks.push_back(frame);
  }
  ASSERT_FALSE(short_walks.empty());
  SearchCounts counts;
  for (int asked = 0; bytesOf(*a, *b) == 0 && asked < 10000; ++asked) {
    touch(*a, *b, short_walks[static_cast<std::size_t>(asked) % short_walks.size()], counts);
  }
  EXPECT_GT(bytesOf(*a, *b), 0U);
  EXPECT_GT(counts.volume_tests + 4 * counts.leaf_pairs, 4 * (4 * a->num_tris + 32));
}

// Two sheets that run close to each other everywhere: one question would take more than a tree.
TEST(Unprepared, OneQuestionTakesNoMoreThanATree) {
  const auto a = kiosModel(scenes::sheet(1, 1, 40, 40, 0));
  const auto b = kiosModel(scenes::sheet(1.01, 0.99, 41, 39, 0));
  const Frame close = {Transform3d::Identity(), Transform3d(fcl::Translation3d(0, 0, 1e-6))};
  SearchCounts counts;
  EXPECT_FALSE(touch(*a, *b, close, counts));
  EXPECT_GT(bytesOf(*a, *b), 0U);
  EXPECT_EQ(counts.tree_searches, 0);
  SearchCounts prepared;
  EXPECT_FALSE(touch(*a, *b, close, prepared));
  EXPECT_LE(counts.volume_tests,
            prepared.volume_tests + 4 * std::max(a->num_tris, b->num_tris) + 8);
  // The other way round, a contact that is found within the limit ends it.
  const Frame crossing = {Transform3d::Identity(),
                          Transform3d(fcl::AngleAxisd(1, Vector3d::UnitX()))};
  const auto fresh = kiosModel(scenes::sheet(1, 1, 41, 41, 0));
  EXPECT_TRUE(touch(*fresh, *b, crossing, counts));
}

TEST(Unprepared, OtherQuestionsPrepare) {
  const Mesh mesh = scenes::bumpyTorus(300);
  const Frame near = {Transform3d::Identity(), Transform3d(fcl::Translation3d(0.3, 0.2, 0.1))};
  for (int question = 0; question < 4; ++question) {
    const auto a = kiosModel(mesh), b = kiosModel(mesh);
    fcl::CollisionResultd contacts;
    fcl::DistanceResultd distance;
    const auto ask = [&](const fcl::CollisionRequestd& request) {
      fcl::collide(a.get(), near.X_WA, b.get(), near.X_WB, request, contacts);
    };
    if (question == 0) ask(fcl::CollisionRequestd(2));
    if (question == 1) ask(fcl::CollisionRequestd(1, true));
    if (question == 2) {
      fcl::distance(a.get(), near.X_WA, b.get(), near.X_WB, fcl::DistanceRequestd(true), distance);
      EXPECT_EQ(distance.min_distance, 0);
    }
    if (question == 3) closerThan(*a, near.X_WA, *b, near.X_WB, 0.1);
    EXPECT_GT(bytesOf(*a, *b), 0U) << question;
  }
}

TEST(Unprepared, DistanceZeroWithoutPointsPreparesNothing) {
  const auto a = kiosModel(scenes::bumpyTorus(2'000)), b = kiosModel(scenes::bumpyTorus(2'100));
  const fcl::Boxd box(1, 1, 1);
  const auto isApart = [&](const fcl::CollisionGeometryd& other, const fcl::DistanceRequestd& asked,
                           const Vector3d& at) {
    fcl::DistanceResultd result;
    fcl::distance(a.get(), Transform3d::Identity(), &other, Transform3d(fcl::Translation3d(at)),
                  asked, result);
    return result.min_distance > 0;
  };
  const Vector3d near(0.3, 0.2, 0.1);
  EXPECT_FALSE(isApart(*b, fcl::DistanceRequestd(), near));
  EXPECT_FALSE(isApart(box, fcl::DistanceRequestd(), {1, 0, 0}));
  EXPECT_EQ(bytesOf(*a, *b), 0U);
  EXPECT_FALSE(isApart(*b, fcl::DistanceRequestd(true), near));
  EXPECT_GT(bytesOf(*a, *b), 0U);
}

// Trees are refitted where there are some, which costs less than a search without.
TEST(Unprepared, DeformingModels) {
  const Mesh mesh = scenes::bumpyTorus(300);
  const auto prepared = kiosModel(mesh), fresh = kiosModel(mesh), other = kiosModel(mesh);
  prepare(*prepared);
  prepare(*other);
  SearchCounts of_prepared, of_fresh;
  for (int i = 1; i < 20; ++i) {
    replace(*prepared, swayed(mesh, i), true, i % 2 == 0);
    replace(*fresh, swayed(mesh, i), true, i % 2 == 1);
    for (const Frame& frame : randomFrames(3, 1.3, static_cast<std::uint64_t>(i))) {
      EXPECT_EQ(touch(*prepared, *other, frame, of_prepared),
                touch(*fresh, *other, frame, of_fresh));
    }
  }
  EXPECT_EQ(of_prepared.tree_searches, 0);
  EXPECT_GT(of_fresh.tree_searches, 0);
}

}  // namespace
}  // namespace kios::testing
