// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Very many pairs that are equally near: a search ends without looking at each, and finds what is
// nearer by however little.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

/// Returns segments (triangles of no area) along y over [0, 1], or along x at height `z`; all pairs
/// of both are as near.
Mesh segments(int count, bool along_x, double z) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) / count;
    const std::size_t k = mesh.vertices.size();
    for (const double s : {0.0, 1.0, 0.5}) {
      mesh.vertices.push_back(along_x ? Vector3d(s, at, z) : Vector3d(at, s, z));
    }
    mesh.triangles.emplace_back(k, k + 1, k + 2);
  }
  return mesh;
}

struct Found {
  double distance;
  std::intptr_t a, b;
  long long exact;
};

Found ask(const Mesh& a, const Mesh& b) {
  const auto model_a = kiosModel(a), model_b = kiosModel(b);
  fcl::DistanceResultd result;
  SearchCounts counts;
  distanceMeshes(*model_a, Transform3d::Identity(), *model_b, Transform3d::Identity(),
                 fcl::DistanceRequestd(), result, &counts);
  return {result.min_distance, result.b1, result.b2, counts.exact};
}

TEST(Ties, EndTheSearch) {
  constexpr int kCount = 1000;
  const Mesh a = segments(kCount, false, 0), b = segments(kCount, true, 1);
  const Found first = ask(a, b);
  EXPECT_EQ(first.distance, 1);
  EXPECT_LT(first.exact, 4 * kCount) << "of a million pairs";
  const Found again = ask(a, b);
  EXPECT_EQ(again.a, first.a);
  EXPECT_EQ(again.b, first.b);
}

TEST(Ties, WhatIsNearerIsFound) {
  const double kMost = 16 * std::numeric_limits<double>::epsilon() * std::sqrt(3.0);
  scenes::Random random(3);
  for (int i = 0; i < 60; ++i) {
    const Mesh a = segments(300, false, 0);
    Mesh b = segments(300, true, 1);
    const double nearer = std::exp2(-1.0 - i % 53);
    const auto which = static_cast<std::size_t>(random.uniform(0, 300));
    for (std::size_t k = 0; k < 3; ++k) b.vertices[3 * which + k].z() -= nearer;
    EXPECT_NEAR(ask(a, b).distance, 1 - nearer, kMost) << nearer;
  }
}

}  // namespace
}  // namespace kios::testing
