// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The pairs that scene queries leave out, and the input that they refuse: counts, laziness, memory,
// threads.

#include <gtest/gtest.h>

#include <limits>

#include "fcl_kios/scene.h"
#include "model/deform.h"
#include "scenes/robots.h"
#include "together.h"

namespace kios::testing {
namespace {

Transform3d at(double x, double y = 0, double z = 0) {
  return Transform3d(Eigen::Translation3d(x, y, z));
}

struct Row {
  explicit Row(int count, double spacing) {
    for (int i = 0; i < count; ++i) {
      models.push_back(kiosModel(scenes::icosphere(0.5, 2)));
      EXPECT_EQ(scene.add(models.back(), at(spacing * i)), i);
    }
  }
  std::vector<std::shared_ptr<Modeld>> models;
  SceneDistance<double> scene;
};

TEST(SceneSkipping, WhatStandsStillIsNotSearchedAgain) {
  Row row(12, 1.05);
  EXPECT_EQ(row.scene.pairsWithin(0.3).size(), 11u);
  EXPECT_EQ(row.scene.counts().queried, 11);
  EXPECT_EQ(row.scene.pairsWithin(0.3).size(), 11u);
  EXPECT_EQ(row.scene.counts().queried, 0);
  EXPECT_EQ(row.scene.counts().still, 11);
  // A smaller margin needs no more; a larger one whatever it reaches.
  EXPECT_EQ(row.scene.pairsWithin(0.01).size(), 0u);
  EXPECT_EQ(row.scene.counts().queried, 0);
  EXPECT_EQ(row.scene.pairsWithin(1.2).size(), 21u);
  EXPECT_EQ(row.scene.counts().queried, 10);
  // One moves: its own pairs only.
  row.scene.move(5, at(1.05 * 5 + 0.01));
  EXPECT_EQ(row.scene.pairsWithin(1.2).size(), 21u);
  EXPECT_EQ(row.scene.counts().queried, 4);
  // Away and back: the same relative pose again.
  row.scene.move(5, at(1000));
  row.scene.move(5, at(1.05 * 5 + 0.01));
  EXPECT_EQ(row.scene.pairsWithin(1.2).size(), 21u);
  EXPECT_EQ(row.scene.counts().queried, 0);
  row.scene.forget();
  EXPECT_EQ(row.scene.pairsWithin(1.2).size(), 21u);
  EXPECT_EQ(row.scene.counts().queried, 21);
}

TEST(SceneSkipping, RingsInRingsAreFarUntilTheyMeet) {
  // Boxes and root volumes overlap, the distance is large.
  const Mesh ring = scenes::bumpyTorus(800);
  Mesh thin = ring;
  for (Vector3d& p : thin.vertices) p *= 0.1;
  SceneDistance<double> scene;
  const int a = scene.add(kiosModel(ring), at(0));
  const int b = scene.add(kiosModel(thin), at(0));
  for (int frame = 0; frame <= 100; ++frame) {
    scene.move(b, at(1e-3 * frame));
    EXPECT_TRUE(scene.pairsWithin(0.1).empty());
  }
  for (int frame = 1; frame <= 100; ++frame) {  // both move far, but together
    scene.move(a, at(frame, 3 * frame));
    scene.move(b, at(frame + 0.125, 3 * frame));
    EXPECT_TRUE(scene.pairsWithin(0.1).empty());
    EXPECT_EQ(scene.counts().queried, frame == 1 ? 1 : 0) << "the same relative pose";
  }
  scene.move(b, at(100, 300));  // the centre again, and then the ring itself
  EXPECT_TRUE(scene.pairsWithin(0.1).empty());
  scene.move(a, at(100.6, 300));
  EXPECT_EQ(scene.pairsWithin(0.1).size(), 1u);
}

TEST(SceneSkipping, MemoryIsBoundedByWhatComesNear) {
  SceneDistance<double> scene;
  const auto model = kiosModel(scenes::icosphere(0.5, 0));
  constexpr int kObjects = 600;
  for (int i = 0; i < kObjects; ++i) scene.add(model, at(i % 30, i / 30));
  for (int frame = 0; frame < 30; ++frame) {
    const auto poses = scenes::randomPoses(kObjects, 12, frame);
    for (int i = 0; i < kObjects; ++i) scene.move(i, poses[i]);
    scene.pairsWithin(0.3);
    const SceneCounts& counts = scene.counts();
    const auto near = static_cast<std::size_t>(counts.queried + counts.still + counts.far_roots);
    EXPECT_LE(scene.rememberedPairs(), 2 * near + 1024);
  }
  scene.clearances();
  EXPECT_LE(scene.rememberedPairs(), SceneDistance<double>::kMaxRemembered);
  for (int i = 0; i < kObjects; ++i) scene.move(i, at(10 * i));
  scene.pairsWithin(0.3);
  EXPECT_LE(scene.rememberedPairs(), 1024u);
}

TEST(SceneSkipping, ObstaclesAreNotAskedAboutEachOther) {
  SceneDistance<double> scene;
  const auto model = kiosModel(scenes::icosphere(0.5, 1));
  for (int i = 0; i < 20; ++i) scene.add(model, at(0.1 * i), Role::kObstacle);
  EXPECT_FALSE(scene.closestPair());
  EXPECT_EQ(scene.counts().filtered, 190);
  const int body = scene.add(model, at(0, 1.2));
  const auto closest = scene.closestPair();
  ASSERT_TRUE(closest);
  EXPECT_EQ(closest->b, body);
}

TEST(SceneSkipping, ThreadsShareModels) {
  std::vector<std::shared_ptr<Modeld>> models;
  for (int i = 0; i < 6; ++i) models.push_back(kiosModel(scenes::bumpyTorus(300)));
  const auto run = [&models](std::uint64_t seed) {
    SceneDistance<double> scene;
    for (const auto& model : models) scene.add(model, Transform3d::Identity());
    double sum = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const auto poses = scenes::randomPoses(6, 4, seed + static_cast<std::uint64_t>(frame));
      for (int i = 0; i < 6; ++i) scene.move(i, poses[i]);
      sum += scene.closestPair()->distance;
      for (const auto& pair : scene.pairsWithin(0.5)) sum += pair.distance;
    }
    return sum;
  };
  std::vector<double> sums(4);
  together(4, [&](int t) { sums[t] = run(10 + t % 2); });
  for (int t = 0; t < 4; ++t) EXPECT_EQ(sums[t], run(10 + t % 2));
}

TEST(SceneRefuses, BadInput) {
  SceneDistance<double> scene;
  const auto model = kiosModel(scenes::icosphere(0.5, 0));
  const int id = scene.add(model, at(0));
  Transform3d bad = at(std::nan(""));
  EXPECT_THROW(scene.move(id, bad), std::invalid_argument);
  bad = at(0);
  bad.linear()(0, 0) = std::nan("");
  EXPECT_THROW(scene.move(id, bad), std::invalid_argument);
  bad.linear()(0, 0) = 1.1;
  EXPECT_THROW(scene.add(model, bad), std::invalid_argument);
  EXPECT_THROW(scene.move(id + 1, at(0)), std::invalid_argument);
  EXPECT_THROW(scene.remove(-1), std::invalid_argument);
  EXPECT_THROW(scene.ignorePair(id, 7), std::invalid_argument);
  EXPECT_THROW(scene.pairsWithin(std::nan("")), std::invalid_argument);
  EXPECT_THROW(scene.add(std::shared_ptr<Modeld>(), at(0)), std::invalid_argument);
  EXPECT_THROW(scene.add(std::make_shared<Modeld>(), at(0)), std::invalid_argument);
  EXPECT_EQ(scene.size(), 1u);
  EXPECT_FALSE(scene.closestPair());

  // An object's pose gone bad, and repaired: objects that moved meanwhile are not forgotten.
  fcl::CollisionObjectd first(model, at(3)), second(kiosModel(scenes::icosphere(0.5, 1)), at(9));
  scene.add(&first);
  scene.add(&second);
  EXPECT_EQ(scene.closestPair()->b, 1);
  first.setTransform(at(7.5));
  second.setTransform(at(std::nan("")));
  EXPECT_THROW(scene.closestPair(), std::invalid_argument);
  second.setTransform(at(9));
  EXPECT_EQ(scene.closestPair()->a, 1);
  EXPECT_EQ(scene.closestPair()->b, 2);
  EXPECT_THROW(scene.move(1, at(0)), std::invalid_argument);

  // A model that is being replaced can't be queried; then it can.
  const auto deforming = kiosModel(scenes::icosphere(0.5, 0));
  const int far = scene.add(deforming, at(100));
  ASSERT_EQ(deforming->beginReplaceModel(), fcl::BVH_OK);
  EXPECT_THROW(scene.closestPair(), std::invalid_argument);
  std::vector<Vector3d> vertices = scenes::icosphere(0.5, 0).vertices;
  for (Vector3d& p : vertices) p.x() -= 100;  // now at the first object
  ASSERT_EQ(deforming->replaceSubModel(vertices), fcl::BVH_OK);
  ASSERT_EQ(deforming->endReplaceModel(true, true), fcl::BVH_OK);
  const auto closest = scene.closestPair();
  EXPECT_EQ(closest->a, id);
  EXPECT_EQ(closest->b, far);
  EXPECT_EQ(closest->distance, 0);
}

}  // namespace
}  // namespace kios::testing
