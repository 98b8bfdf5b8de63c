// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that all but lie on something, a hair above it or below, in worlds turned at random: every
// contact is found, and no pair of triangles is
// asked about where a gap is wider than what rounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scalars.h"
#include "scenes/cad_shapes.h"
#include "scenes/shapes.h"
#include "search/prepared_pair.h"
#include "volume/rotation.h"

namespace kios::testing {
namespace {

/// Adds four posts of 0.2 x 0.2 x 1 on z = 0: nothing small that stands between them is above all.
Mesh withPosts(const Mesh& place) {
  std::vector<Mesh> all = {place};
  for (const double x : {-1.85, 1.85}) {
    for (const double y : {-1.85, 1.85}) {
      all.push_back(scenes::moved(fcl::Transform3d(Eigen::Translation3d(x, y, 0.5)),
                                  scenes::subdividedBox({0.2, 0.2, 1}, 1)));
    }
  }
  return scenes::merged(all);
}

std::vector<Mesh> standingPlaces() {
  const Mesh slab = scenes::moved(fcl::Transform3d(Eigen::Translation3d(0, 0, -0.05)),
                                  scenes::subdividedBox({4, 4, 0.1}, 1));
  const Mesh floor = scenes::sheet(4, 4, 1, 1, 0), grid = scenes::sheet(4, 4, 8, 8, 0);
  return {floor, slab, grid, withPosts(floor), withPosts(slab), withPosts(grid)};
}

std::vector<Mesh> standingBodies() {
  return {scenes::subdividedBox({0.3, 0.2, 0.15}, 1), scenes::stripCylinder(12, 0.3, 0.05),
          scenes::stripCylinder(60, 0.4, 0.015), scenes::uvSphere(0.2, 10, 12)};
}

struct HoverSum {
  long wrong = 0, touching = 0, apart = 0, hovering = 0;
  long long exact = 0;  ///< pairs that were asked about where bodies hovered
};

/// `size`: of everything. `gaps`: times 4 size, the width of a place.
template <typename S>
void hover(const Mesh& place, const Mesh& body, double size, const std::vector<double>& gaps,
           bool refitted, std::uint64_t seed, HoverSum& sum) {
  Random random(seed);
  PosedPair<S> posed(transformed(place, size, fcl::Vector3d::Zero()),
                     transformed(body, size, fcl::Vector3d::Zero()), refitted);
  double low = std::numeric_limits<double>::infinity();
  for (const fcl::Vector3d& v : body.vertices) low = std::min(low, v.z());
  for (const double gap : gaps) {
    fcl::Transform3d X_AB(
        Eigen::AngleAxisd(random.uniform(0, 6), fcl::Vector3d::UnitZ()).toRotationMatrix());
    X_AB.translation() =
        size * fcl::Vector3d(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), 4 * gap - low);
    fcl::Transform3d X_WA(
        Eigen::AngleAxisd(random.uniform(0, 6), inCube(random).normalized()).toRotationMatrix());
    X_WA.translation() = size * inCube(random);
    ASSERT_TRUE(posed.pose(X_WA.cast<S>(), (X_WA * X_AB).template cast<S>()));
    const AllPairs all = posed.all();
    ++(all.hits.empty() ? sum.apart : sum.touching);
    SearchCounts counts;
    auto found = engine::intersectingTriangles(posed.pair(),
                                               std::numeric_limits<std::size_t>::max(), counts);
    std::vector<std::pair<int, int>> ids;
    for (const auto& pair : found) ids.emplace_back(pair.a, pair.b);
    sum.wrong += ids != all.hits;
    SearchCounts of_first;
    sum.wrong +=
        engine::intersectingTriangles(posed.pair(), 1, of_first).empty() != all.hits.empty();
    if (gap < 2e-6) continue;
    ++sum.hovering;
    sum.exact += counts.exact + of_first.exact;
  }
}

KIOS_SCALAR_SUITE(Hovering);

TYPED_TEST(Hovering, ContactsAreFoundAndNothingElseIsLookedAt) {
  using S = TypeParam;
  std::vector<double> gaps = {0};
  for (int e = -30; e <= -8; e += 2) gaps.insert(gaps.end(), {std::ldexp(1, e), -std::ldexp(1, e)});
  HoverSum sum;
  std::uint64_t seed = 0;
  for (const Mesh& place : standingPlaces()) {
    for (const Mesh& body : standingBodies()) {
      for (const double size : {1.0, 1e-5, 1e5}) {
        for (const bool refitted : {false, true}) {
          hover<S>(place, body, size, gaps, refitted, ++seed, sum);
        }
      }
    }
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GT(sum.touching, 1000);
  EXPECT_GT(sum.apart, 1000);
  EXPECT_GT(sum.hovering, 500);
  EXPECT_EQ(sum.exact, 0);
}

}  // namespace
}  // namespace kios::testing
