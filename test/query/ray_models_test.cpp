// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Ray queries of models that change, and from many threads.

#include <gtest/gtest.h>

#include <atomic>

#include "model/deform.h"
#include "query/ray_cases.h"
#include "together.h"

namespace kios::testing {
namespace {

std::size_t expectAllRays(const Modeld& model, std::uint64_t seed) {
  HardRays<double> rays(model, seed);
  std::size_t hits = 0;
  for (int i = 0; i < 24; ++i) hits += expectBruteForce(model, rays.next());
  return hits;
}

TEST(RayModels, NeverStale) {
  const Mesh mesh = scenes::bumpyTorus(200);
  for (const bool refit : {true, false}) {
    for (const bool bottomup : {true, false}) {
      const auto replaced = kiosModel(mesh), updated = kiosModel(mesh);
      Modeld copy(*replaced);
      std::size_t hits = expectAllRays(*replaced, 1) + expectAllRays(*updated, 2);
      for (double phase = 0.5; phase < 3; phase += 0.5) {
        replace(*replaced, swayed(mesh, phase), refit, bottomup);
        update(*updated, swayed(mesh, -phase), refit, bottomup);
        hits += expectAllRays(*replaced, 3) + expectAllRays(*updated, 4) + expectAllRays(copy, 5);
      }
      EXPECT_GT(hits, 500u);
    }
  }
}

TEST(RayModels, DirectWritesNeedInvalidate) {
  const Mesh mesh = scenes::bumpyTorus(200);
  const auto model = kiosModel(mesh);
  EXPECT_GT(expectAllRays(*model, 1), 0u);
  for (int v = 0; v < model->num_vertices; ++v) model->vertices[v] += Vector3d(5, 0, 0);
  invalidate(*model);
  EXPECT_GT(expectAllRays(*model, 2), 0u);
  model->beginReplaceModel();
  EXPECT_THROW(firstHit(*model, kIdentity<double>, Rayd()), std::invalid_argument);
}

TEST(RayModels, ThreadsGiveOneThreadsAnswers) {
  constexpr int kThreads = 6, kRays = 200;
  const auto model = kiosModel(scenes::bumpyTorus(2000));
  const auto alone = kiosModel(scenes::bumpyTorus(2000));
  std::vector<Rayd> rays;
  HardRays<double> source(*model, 8);
  while (rays.size() < kRays) rays.push_back(source.next());
  std::vector<std::vector<RayHit<double>>> expected;
  for (const Rayd& ray : rays) expected.push_back(allHits(*alone, kIdentity<double>, ray));
  std::atomic<int> wrong{0};
  together(kThreads, [&](int t) {
    for (int i = 0; i < kRays; ++i) {
      const auto k = static_cast<std::size_t>((i + 31 * t) % kRays);
      const auto hits = allHits(*model, kIdentity<double>, rays[k]);
      const auto first = firstHit(*model, kIdentity<double>, rays[k]);
      bool right = hits.size() == expected[k].size() && first.has_value() == !hits.empty();
      for (std::size_t h = 0; right && h < hits.size(); ++h) {
        right = same(hits[h], expected[k][h]) && (h > 0 || same(*first, hits[0]));
      }
      wrong += right ? 0 : 1;
    }
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
