// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Scene queries against fcl::distance over all pairs: equal in every frame, bit for bit.

#include "scene/random_scene.h"

namespace kios::testing {
namespace {

using Truth = std::map<std::pair<int, int>, fcl::DistanceResultd>;

void expectSum(const SceneCounts& counts, std::size_t objects) {
  EXPECT_EQ(counts.total, static_cast<long long>(objects * (objects - 1) / 2));
  EXPECT_EQ(counts.total, counts.filtered + counts.far_boxes + counts.far_roots + counts.still +
                              counts.ties + counts.queried);
  EXPECT_LE(counts.proven_farther, counts.queried);
}

void expectPoints(const ScenePair<double>& pair, const fcl::DistanceResultd& truth) {
  if (pair.distance > 1e4) return;  // FCL's tree, which serves there, takes any of equal distances
  EXPECT_EQ(pair.nearest_a, truth.nearest_points[0]);
  EXPECT_EQ(pair.nearest_b, truth.nearest_points[1]);
  EXPECT_EQ(pair.triangle_a, truth.b1);
  EXPECT_EQ(pair.triangle_b, truth.b2);
}

void expectClosest(RandomScene& random, const Truth& truth, bool points) {
  SceneRequest request;
  request.nearest_points = points;
  const auto closest = random.scene().closestPair(request);
  expectSum(random.scene().counts(), random.objects().size());
  ASSERT_EQ(closest.has_value(), !truth.empty());
  if (!closest) return;
  auto best = truth.begin();
  for (auto it = truth.begin(); it != truth.end(); ++it) {
    if (it->second.min_distance < best->second.min_distance) best = it;
  }
  EXPECT_EQ(std::pair(closest->a, closest->b), best->first);
  EXPECT_EQ(closest->distance, best->second.min_distance);
  if (points && closest->distance > 0) expectPoints(*closest, best->second);
}

void expectWithin(RandomScene& random, const Truth& truth, double margin, bool exact, bool points) {
  SceneRequest request;
  request.exact = exact;
  request.nearest_points = points;
  const auto pairs = random.scene().pairsWithin(margin, request);
  expectSum(random.scene().counts(), random.objects().size());
  auto it = pairs.begin();
  for (const auto& [ids, result] : truth) {
    if (!(result.min_distance <= margin)) continue;
    ASSERT_NE(it, pairs.end());
    ASSERT_EQ(std::pair(it->a, it->b), ids);
    if (exact) {
      EXPECT_EQ(it->distance, result.min_distance);
      if (points && it->distance > 0) expectPoints(*it, result);
    } else {
      // Other triangles with the same nearest points may round otherwise.
      EXPECT_GE(it->distance, result.min_distance * (1 - 1e-13));
      EXPECT_LE(it->distance, margin);
    }
    ++it;
  }
  EXPECT_EQ(it, pairs.end());
}

void expectClearances(RandomScene& random, const Truth& truth, bool points) {
  SceneRequest request;
  request.nearest_points = points;
  const auto pairs = random.scene().clearances(request);
  expectSum(random.scene().counts(), random.objects().size());
  ASSERT_EQ(pairs.size(), truth.size());
  auto it = pairs.begin();
  for (const auto& [ids, result] : truth) {
    ASSERT_EQ(std::pair(it->a, it->b), ids);
    EXPECT_EQ(it->distance, result.min_distance);
    if (points && it->distance > 0) expectPoints(*it, result);
    ++it;
  }
}

/// Returns a margin below, at, just above or far above a distance of the scene, or anything.
double anyMargin(RandomScene& random, const Truth& truth) {
  const double how = random.random().unit();
  if (how < 0.1) return 0;
  if (how < 0.15) return std::numeric_limits<double>::infinity();
  if (how < 0.2) return -1;
  if (how < 0.6 || truth.empty()) return std::pow(10, random.random().uniform(-3, 1));
  auto it = truth.begin();
  std::advance(it, static_cast<int>(random.random().unit() * static_cast<double>(truth.size())));
  const double distance = it->second.min_distance;
  return how < 0.8 ? distance : std::nextafter(distance, 1e9);
}

void runFrames(const SceneSettings& settings, int frames, std::uint64_t seed) {
  RandomScene random(settings, seed);
  for (int frame = 0; frame < frames; ++frame) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " frame " << frame);
    random.change();
    const Truth truth = random.bruteForce();
    const double kind = random.random().unit();
    const bool points = random.random().unit() < 0.3;
    if (kind < 0.5) expectClosest(random, truth, points);
    if (kind > 0.3 && kind < 0.9) {
      expectWithin(random, truth, anyMargin(random, truth), random.random().unit() < 0.6, points);
    }
    if (kind > 0.8) expectClearances(random, truth, points);
    if (kind < 0.01) random.scene().forget();
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(SceneDistance, EqualsBruteForceWhereCrowded) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) runFrames({6, 1}, 150, seed);
}

TEST(SceneDistance, EqualsBruteForceWhereLoose) {
  for (std::uint64_t seed = 20; seed < 60; ++seed) runFrames({7, 4}, 150, seed);
}

TEST(SceneDistance, EqualsBruteForceWhereSparse) {
  for (std::uint64_t seed = 140; seed < 160; ++seed) runFrames({8, 40}, 150, seed);
}

TEST(SceneDistance, EqualsBruteForceFarFromTheOrigin) {
  for (std::uint64_t seed = 160; seed < 175; ++seed) {
    runFrames({6, 2, Vector3d(1e9, -2e9, 5e8)}, 120, seed);
  }
}

TEST(SceneDistance, EqualsBruteForceAmongObstacles) {
  SceneSettings settings{9, 3};
  settings.obstacles = true;
  for (std::uint64_t seed = 180; seed < 200; ++seed) runFrames(settings, 120, seed);
}

// Many bodies that fly straight: near pairs are listed for several frames.
TEST(SceneDistance, EqualsBruteForceInAStream) {
  constexpr int kBodies = 24;
  scenes::Random random(7);
  std::vector<std::shared_ptr<Modeld>> models;
  std::vector<Vector3d> velocities;
  SceneDistance<double> scene;
  auto poses = scenes::randomPoses(kBodies, 3, 70);
  for (int i = 0; i < kBodies; ++i) {
    models.push_back(kiosModel(i % 2 == 0 ? scenes::icosphere(0.2, 0) : scenes::bumpyTorus(100)));
    velocities.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    scene.add(models.back(), poses[i]);
  }
  for (int frame = 0; frame < 500; ++frame) {
    const double speed = frame < 250 ? 0.02 : 0.1;
    for (int i = 0; i < kBodies; ++i) {
      Vector3d t = poses[i].translation() + speed * velocities[i];
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(t[axis]) > 3) velocities[i][axis] = -velocities[i][axis];
      }
      poses[i].translation() += speed * velocities[i];
      scene.move(i, poses[i]);
    }
    std::vector<std::tuple<double, int, int>> truth;
    for (int a = 0; a < kBodies; ++a) {
      for (int b = a + 1; b < kBodies; ++b) {
        fcl::DistanceResultd result;
        const double distance = fcl::distance(models[a].get(), poses[a], models[b].get(), poses[b],
                                              fcl::DistanceRequestd(), result);
        truth.emplace_back(distance, a, b);
      }
    }
    std::sort(truth.begin(), truth.end());
    if (frame % 3 != 0) {
      const auto closest = scene.closestPair();
      expectSum(scene.counts(), kBodies);
      ASSERT_EQ(std::tuple(closest->distance, closest->a, closest->b), truth[0]) << frame;
    }
    const double margin = frame % 100 < 50 ? 0.05 : 0.3;
    std::vector<std::tuple<double, int, int>> within;
    for (const auto& pair : scene.pairsWithin(margin)) {
      within.emplace_back(pair.distance, pair.a, pair.b);
    }
    expectSum(scene.counts(), kBodies);
    std::sort(within.begin(), within.end());
    truth.erase(std::lower_bound(truth.begin(), truth.end(), std::tuple(margin, -1, -1)),
                truth.end());
    ASSERT_EQ(within, truth) << frame;
  }
}

}  // namespace
}  // namespace kios::testing
