// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies of few triangles, at any scale.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "query/small_bodies.h"
#include "scalars.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(FewTriangles);

/// Returns a few triangles: soups, or ones that share vertices, in one plane or not.
Mesh fewTriangles(int count, Random& random) {
  const double kind = random.uniform(0, 1);
  Mesh mesh;
  if (kind < 0.25) {
    mesh = nastySoup(count, random);
  } else if (kind < 0.4) {
    mesh = gridSoup(count, random);
  } else {  // a fan about vertex 0
    const double height = kind < 0.8 ? 0 : random.uniform(-1, 1);
    mesh.vertices.emplace_back(0, 0, height);
    for (int i = 0; i <= count; ++i) {
      const double angle = 1.5 * i;
      mesh.vertices.emplace_back(std::cos(angle), random.uniform(0.5, 1) * std::sin(angle), 0);
    }
    for (int i = 1; i <= count; ++i) mesh.triangles.emplace_back(0, i, i + 1);
  }
  // Coordinates of their own frame may be far larger than the triangles.
  const double far = random.uniform(0, 1) < 0.3 ? random.uniform(-1e4, 1e4) : 0;
  for (auto& p : mesh.vertices) p += fcl::Vector3d(far, -far, far / 3);
  return mesh;
}

// The distance is within the contract, and that of the triangles that are named, whoever asks.
TYPED_TEST(FewTriangles, TheyAreAsNearAsAllPairsTell) {
  using S = TypeParam;
  constexpr double kEps = std::numeric_limits<S>::epsilon();
  Random random(16);
  int apart = 0, touching = 0, other = 0;
  for (int i = 0; i < 20000; ++i) {
    const int most = i % 3 == 0 ? 4 : i % 3 == 1 ? 24 : 128;
    const int num_a = 1 + i / 3 % std::min(most, 64);
    const int num_b = 1 + i / 3 / most % std::min(most / num_a, num_a > 32 ? 2 : 32);
    Mesh mesh_a = fewTriangles(num_a, random), mesh_b = fewTriangles(num_b, random);
    if (num_a > 32) mesh_b = transformed(mesh_b, 0.1, fcl::Vector3d::Zero());
    auto X = poseAt<double>(5 * i + 1 + i % 3, std::pow(10, random.uniform(-5, 1)), random);
    // Their own frames' origins lie where the bodies are not.
    X.X_WA.translation() -= X.X_WA.linear() * mesh_a.vertices[0];
    X.X_WB.translation() -= X.X_WB.linear() * mesh_b.vertices[0];
    const int range = i % 5 != 0 ? 0 : (sizeof(S) == sizeof(double) ? 900 : 60);
    const double scale = std::ldexp(1.0, static_cast<int>(random.uniform(-range, range)));
    for (auto* mesh : {&mesh_a, &mesh_b}) {
      for (auto& p : mesh->vertices) p *= scale;
    }
    for (auto* pose : {&X.X_WA, &X.X_WB}) pose->translation() *= scale;
    const Poses<S> XS = {X.X_WA.template cast<S>(), X.X_WB.template cast<S>()};
    const auto a = modelOf<S>(mesh_a, range == 0), b = modelOf<S>(mesh_b, range == 0);
    const AllPairs all = allPairs(*a, *b, XS);
    const auto ask = [&](bool points) {
      fcl::DistanceResult<S> result;
      distanceMeshes(*a, XS.X_WA, *b, XS.X_WB, fcl::DistanceRequest<S>(points), result);
      return result;
    };
    const auto found = ask(true);
    const S d = found.min_distance;
    ASSERT_EQ(d == 0, !all.hits.empty()) << i;
    const std::pair<int, int> ids = {found.b1, found.b2};
    if (d == 0) {
      ++touching;
      ASSERT_TRUE(std::binary_search(all.hits.begin(), all.hits.end(), ids)) << i;
    } else {
      ++apart;
      ASSERT_GE(d, all.rounded<S>()) << i;
      ASSERT_LE(double{d} - all.distance, 16 * kEps * all.extent) << i;
      other += ids != all.nearest;
      const auto corners = trianglesOf(*b)[static_cast<std::size_t>(ids.second)];
      const RelativePosed X_AB(XS.X_WA, XS.X_WB);
      ASSERT_EQ(d, roundedAnswer<S>(
                       triangleDistance(trianglesOf(*a)[static_cast<std::size_t>(ids.first)],
                                        {X_AB * corners[0], X_AB * corners[1], X_AB * corners[2]})
                           .distance))
          << i;
    }
    const auto bracket = kios::distance(*a, XS.X_WA, *b, XS.X_WB);
    ASSERT_EQ(bracket.distance, d) << i;
    ASSERT_EQ(std::make_pair(bracket.triangle_a, bracket.triangle_b), ids) << i;
    ASSERT_LE(bracket.lower_bound, all.distance) << i;
    DistanceOptions<S> near;
    near.near_enough = d / 2;
    const auto not_near = kios::distance(*a, XS.X_WA, *b, XS.X_WB, near);
    ASSERT_EQ(not_near.distance, d) << i;
    ASSERT_EQ(not_near.triangle_a, ids.first) << i;
    for (const S more : {S(1), S(1.01), S(1.5)}) {  // as if a pair so far were known
      if (d == 0) break;
      fcl::DistanceResult<S> known;
      known.min_distance = std::nextafter(more * d, std::numeric_limits<S>::infinity());
      distanceMeshes(*a, XS.X_WA, *b, XS.X_WB, fcl::DistanceRequest<S>(false), known);
      ASSERT_EQ(known.min_distance, d) << i;
      ASSERT_EQ(std::make_pair(static_cast<int>(known.b1), static_cast<int>(known.b2)), ids) << i;
    }
    const auto again = ask(true);
    ASSERT_EQ(again.min_distance, d) << i;
    ASSERT_EQ(std::make_pair(static_cast<int>(again.b1), static_cast<int>(again.b2)), ids) << i;
    ASSERT_EQ(again.nearest_points[0], found.nearest_points[0]) << i;
    ASSERT_EQ(again.nearest_points[1], found.nearest_points[1]) << i;
    ASSERT_EQ(ask(false).min_distance, d) << i;
  }
  EXPECT_GT(apart, 5000);
  EXPECT_GT(touching, 1000);
  EXPECT_LT(other, apart / 10) << "pairs that share vertices, some of which differ by rounding";
}

}  // namespace
}  // namespace kios::testing
