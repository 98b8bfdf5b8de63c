// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// near_enough within rounding of a distance that a search meets: features and triangles may lie on
// either side of it, and the answer must still say why the search ended.

#include <gtest/gtest.h>

#include <cmath>

#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

template <typename S>
S steps(S x, int count) {
  const S to = count < 0 ? -std::numeric_limits<S>::infinity() : std::numeric_limits<S>::infinity();
  for (int i = 0; i < std::abs(count); ++i) x = std::nextafter(x, to);
  return x;
}

KIOS_SCALAR_SUITE(NearEnough);

// From the pairs that end a search downwards: each one's distance, a few ulps up and down.
TYPED_TEST(NearEnough, SaysWhyItEnded) {
  using S = TypeParam;
  const Mesh mesh_a = rounded<S>(scenes::bumpyTorus(1200)),
             mesh_b = rounded<S>(scenes::bumpyTorus(1000));
  const auto a = modelOf<S>(mesh_a), b = modelOf<S>(mesh_b);
  int ended = 0, done = 0;
  for (const auto& [X_WA, X_WB] : posesOf<S>(mesh_a, mesh_b, 60, 1.5 * scenes::extent(mesh_a), 3)) {
    const auto exact = kios::distanceBracket(*a, X_WA, *b, X_WB);
    if (exact.distance == 0) continue;
    DistanceBracketRequest<S> options;
    options.near_enough = 4 * exact.distance;
    for (int i = 0; i < 6; ++i) {
      const auto found = kios::distanceBracket(*a, X_WA, *b, X_WB, options);
      if (found.stop != DistanceStop::kNear) break;
      for (int step = -8; step <= 2; ++step) {
        options.near_enough = steps(found.distance, step);
        const auto answer = kios::distanceBracket(*a, X_WA, *b, X_WB, options);
        ASSERT_EQ(faultOf(answer, options, double{exact.distance}), nullptr);
        if (answer.stop == DistanceStop::kNear) {
          ++ended;
        } else {
          ASSERT_EQ(answer.stop, DistanceStop::kTolerance);
          ASSERT_EQ(answer.distance, exact.distance) << options.near_enough;
          ++done;
        }
      }
      options.near_enough = found.distance * (1 - 4 * std::numeric_limits<S>::epsilon());
    }
  }
  EXPECT_GT(ended, 100);
  EXPECT_GT(done, 20);
}

}  // namespace
}  // namespace kios::testing
