// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges that are nearly parallel and close, where float can't tell where they are nearest: 29 % of
// the answers were wrong at 3e-4 rad without the slack that the search takes off.

#include <gtest/gtest.h>

#include "scalars.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

/// Returns a wedge hanging from the edge between p and q, turned about the edge so that the edge is
/// what is nearest from above (below for `down` = -1).
Mesh wedge(const fcl::Vector3d& p, const fcl::Vector3d& q, double down, Random& random) {
  const fcl::Vector3d third =
      p + random.uniform(-0.5, 1.5) * (q - p) +
      fcl::Vector3d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -down);
  return scenes::singleTriangle(p, q, third);
}

struct Edges {
  Mesh a, b;
};

/// Bundles of `count` edges along x, and above them as many that are turned by `angle`.
Edges bundles(int count, double angle, double gap, Random& random) {
  std::vector<Mesh> a, b;
  for (int i = 0; i < count; ++i) {
    const double y = 0.3 * i, from = random.uniform(-1.5, -0.5), to = random.uniform(0.5, 1.5);
    a.push_back(wedge({from, y, 0}, {to, y, 0}, 1, random));
    const fcl::Vector3d along(std::cos(angle), std::sin(angle), random.uniform(-0.3, 0.3) * gap);
    const fcl::Vector3d middle(random.uniform(-0.5, 0.5),
                               y + random.uniform(-1, 1) * (gap + 0.5 * std::sin(angle)),
                               gap * random.uniform(1, 1.1));
    b.push_back(wedge(middle - random.uniform(0.5, 1.5) * along,
                      middle + random.uniform(0.5, 1.5) * along, -1, random));
  }
  return {scenes::merged(a), scenes::merged(b)};
}

KIOS_SCALAR_SUITE(ParallelEdges);

TYPED_TEST(ParallelEdges, AreAsNearAsTheKernelsSay) {
  using S = TypeParam;
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  Random random(53);
  int apart = 0, wrong = 0;
  for (int angle = 1; angle <= 9; ++angle) {
    for (int gap = 2; gap <= 7; ++gap) {
      const auto poses = scenes::randomPoses(12, 1, static_cast<std::uint64_t>(angle * 10 + gap));
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const double turned = angle == 9 ? 0 : random.uniform(0.3, 3) * std::pow(10, -angle);
        const Edges edges = bundles(i % 2 == 0 ? 1 : 10, turned, std::pow(10, -gap), random);
        PosedPair<S> posed(edges.a, edges.b);
        const fcl::Transform3d X_B = i % 3 == 0 ? poses[0] : poses[i];
        const fcl::Transform3d X_A = i % 3 == 0 ? poses[0] : poses[i];
        ASSERT_TRUE(posed.pose(X_A.cast<S>(), X_B.cast<S>()));
        const AllPairs all = posed.all();
        SearchCounts counts;
        const auto nearest = engine::nearestTriangles(posed.pair(), {}, counts).nearest;
        EXPECT_EQ(nearest.distance == 0, all.distance == 0);
        const double error = std::abs(nearest.distance - all.distance);
        wrong += error > 16 * kEps * all.extent;
        apart += all.distance > 0;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(apart, 300);
}

}  // namespace
}  // namespace kios::testing
