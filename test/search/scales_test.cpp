// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All lengths that a pair may have, near and close: nothing of the searches in float may over- or
// underflow.

#include <gtest/gtest.h>

#include "scalars.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

/// Counts wrong answers at one pose, with and without a bound on entry.
template <typename S>
int wrongAnswers(const PosedPair<S>& posed, TriangleDistanced& nearest) {
  constexpr double kNoBound = std::numeric_limits<double>::max();
  int wrong = 0;
  const AllPairs all = posed.all();
  const double slack = 16 * std::numeric_limits<double>::epsilon() * all.extent;
  SearchCounts counts;
  for (const double at_most : {3 * all.distance, 1.001 * all.distance, kNoBound}) {
    if (!(at_most > 0)) continue;
    engine::PairQuery query;
    if (at_most < kNoBound) query.far_enough = at_most;
    nearest.distance = at_most;
    const auto found = engine::nearestTriangles(posed.pair(), query, counts);
    if (found.found() && found.nearest.distance < at_most) nearest = found.nearest;
    const double expected = std::min(at_most, all.distance);
    wrong += !(std::abs(nearest.distance - expected) <= slack);
  }
  const auto hits = engine::intersectingTriangles(posed.pair(), 1000000, counts);
  wrong += hits.size() != all.hits.size();
  wrong += engine::intersectingTriangles(posed.pair(), 1, counts).empty() != all.hits.empty();
  return wrong;
}

/// Wrong answers over pairs of shapes that come close, all lengths times 2^e. 0, too, if the scale
/// is refused.
template <typename S>
int wrongAnswers(int e) {
  const double scale = std::ldexp(1, e);
  const fcl::Vector3d zero = fcl::Vector3d::Zero();
  const Mesh ball = transformed(scenes::icosphere(1, 1), scale, zero);
  const Mesh box = transformed(scenes::subdividedBox({1, 1.5, 2}, 2), scale, zero);
  int wrong = 0;
  for (const Mesh* b : {&ball, &box}) {
    PosedPair<S> posed(ball, *b);
    for (const fcl::Transform3d& X : scenes::randomPoses(12, 4, 61)) {
      fcl::Transform3<S> X_A = fcl::Transform3<S>::Identity(), X_B = X.cast<S>();
      X_B.translation() *= static_cast<S>(scale);
      for (int step = 0; step < 4; ++step) {  // to a hundredth of the distance each
        if (!posed.pose(X_A, X_B)) return 0;
        TriangleDistanced nearest;
        nearest.point_a = nearest.point_b = fcl::Vector3d::Zero();
        wrong += wrongAnswers(posed, nearest);
        X_B.translation() -= ((1 - 1e-2) * (nearest.point_b - nearest.point_a)).template cast<S>();
      }
    }
  }
  return wrong;
}

KIOS_SCALAR_SUITE(Scales);

TYPED_TEST(Scales, ModerateLengths) {
  for (int e = -16; e <= 24; e += 4) EXPECT_EQ(wrongAnswers<TypeParam>(e), 0) << "scale 2^" << e;
}

// Down to kLeastReach and up to kLargestReach, and what is refused beyond. Squares of squares of
// lengths over- and underflow there: provesApart(), in leaf_cull-inl.h, then takes leaves for
// apart.
TYPED_TEST(Scales, ExtremeLengths) {
  for (int e = -38; e < -16; e += 2) EXPECT_EQ(wrongAnswers<TypeParam>(e), 0) << "scale 2^" << e;
  for (int e = 25; e <= 41; e += 2) EXPECT_EQ(wrongAnswers<TypeParam>(e), 0) << "scale 2^" << e;
}

}  // namespace
}  // namespace kios::testing
