// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// near_enough within rounding of a distance that a search meets: features and triangles may lie on
// either side of it, and the answer must still say why the search ended.

#include <gtest/gtest.h>

#include <cmath>

#include "query/query_cases.h"

namespace kios::testing {
namespace {

using fcl::Vector3d;

template <typename S>
S steps(S x, int count) {
  const S to = count < 0 ? -std::numeric_limits<S>::infinity() : std::numeric_limits<S>::infinity();
  for (int i = 0; i < std::abs(count); ++i) x = std::nextafter(x, to);
  return x;
}

template <typename S>
class NearEnough : public ::testing::Test {
 protected:
  NearEnough() {
    const auto model_of = [](const Mesh& mesh, bool engine) { return modelOf<S>(mesh, engine); };
    const Mesh a = rounded<S>(scenes::bumpyTorus(1200)), b = rounded<S>(scenes::bumpyTorus(1000));
    for (const bool engine : {true, false}) {
      pairs.push_back({model_of(a, engine), model_of(b, engine)});
    }
    poses = posesOf<S>(a, b, 60, 1.5 * scenes::extent(a), 3);
  }

  struct Pair {
    std::shared_ptr<Model<S>> a, b;
  };
  std::vector<Pair> pairs;  ///< searched by the engine, and in FCL's tree
  std::vector<Poses<S>> poses;
};
using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(NearEnough, Scalars);

// From the pairs that end a search downwards: each one's distance, a few ulps up and down.
TYPED_TEST(NearEnough, SaysWhyItEnded) {
  using S = TypeParam;
  int ended = 0, done = 0;
  for (const auto& [a, b] : this->pairs) {
    for (const auto& [X_WA, X_WB] : this->poses) {
      const auto exact = kios::distance(*a, X_WA, *b, X_WB);
      if (exact.distance == 0) continue;
      DistanceOptions<S> options;
      options.near_enough = 4 * exact.distance;
      for (int i = 0; i < 6; ++i) {
        const auto found = kios::distance(*a, X_WA, *b, X_WB, options);
        if (found.stop != DistanceStop::kNear) break;
        for (int step = -8; step <= 2; ++step) {
          options.near_enough = steps(found.distance, step);
          const auto answer = kios::distance(*a, X_WA, *b, X_WB, options);
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
  }
  EXPECT_GT(ended, 100);
  EXPECT_GT(done, 20);
}

// far_enough below the rounding of the distance: nothing is proven to be so far, and pairs that are
// nearer than the one found were left out.
TYPED_TEST(NearEnough, FarEnoughWithinRounding) {
  using S = TypeParam;
  const auto mesh = [](const Vector3d& apex, const Vector3d& first) {
    const Vector3d point(-0.0248, -0.0175, -0.0411);
    Mesh result;
    result.vertices = {first, first, apex, point, point, point};
    result.triangles = {{0, 1, 2}, {3, 4, 5}};
    return rounded<S>(result);
  };
  const Vector3d apex(0.5317, 0.3753, 0.8784);
  const Mesh a = mesh(apex, {0, 0, 1}), b = mesh(apex, {0, 0, 0});
  const S eps = std::numeric_limits<S>::epsilon();
  for (const bool engine : {true, false}) {
    const auto model_a = modelOf<S>(a, engine), model_b = modelOf<S>(b, engine);
    for (int i = 1; i < 200; ++i) {
      fcl::Transform3<S> X_WA = fcl::Transform3<S>::Identity(), X_WB = X_WA;
      X_WB.translation()[2] = -eps * S(i) / 7;
      const auto exact = kios::distance(*model_a, X_WA, *model_b, X_WB);
      for (const S share : {S(0.01), S(0.2), S(0.9), S(1), S(1.5)}) {
        DistanceOptions<S> options;
        options.near_enough = exact.distance;
        options.far_enough = share * exact.distance;
        const auto answer = kios::distance(*model_a, X_WA, *model_b, X_WB, options);
        ASSERT_EQ(faultOf(answer, options, double{exact.distance}), nullptr);
        if (answer.stop == DistanceStop::kTolerance) {
          ASSERT_EQ(answer.distance, exact.distance);
        }
      }
    }
  }
}

// A budget may end it, too, and holds for the whole query: more of it never gives a larger
// distance or a smaller lower bound.
TYPED_TEST(NearEnough, FarEnoughWithinRoundingAndABudget) {
  using S = TypeParam;
  for (const auto& [a, b] : this->pairs) {
    for (std::size_t i = 0; i < 20; ++i) {
      const auto& [X_WA, X_WB] = this->poses[i];
      const auto exact = kios::distance(*a, X_WA, *b, X_WB);
      for (const int step : {-2, 0, 2, 20}) {
        S lower = 0, distance = std::numeric_limits<S>::infinity();
        for (const long long budget : {0, 1, 5, 20, 60, 100, 200, 400, 800, 100000}) {
          DistanceOptions<S> options;
          options.far_enough = steps(exact.distance, step);
          options.max_expansions = budget;
          const auto answer = kios::distance(*a, X_WA, *b, X_WB, options);
          ASSERT_EQ(faultOf(answer, options, double{exact.distance}), nullptr) << budget;
          ASSERT_GE(answer.lower_bound, lower) << budget;
          ASSERT_LE(answer.distance, distance) << budget;
          lower = answer.lower_bound;
          distance = answer.distance;
        }
      }
    }
  }
}

// A scene that was asked for verdicts only must not take them for distances. It searches with a
// near_enough that is its margin less a rounding bound: margins are swept across the one that gives
// the distance of a pair which ends the search.
TYPED_TEST(NearEnough, ScenesKeepOnlyExactDistances) {
  using S = TypeParam;
  const auto& [a, b] = this->pairs[0];
  const S radii = a->getBV(0).bv.radius0 + b->getBV(0).bv.radius0;
  for (const auto& [X_WA, X_WB] : this->poses) {
    const auto exact = kios::distance(*a, X_WA, *b, X_WB);
    DistanceOptions<S> options;
    options.near_enough = 4 * exact.distance;
    options.far_enough = options.near_enough * (1 + S(1) / 32);
    for (int i = 0; i < 6; ++i) {
      const auto found = kios::distance(*a, X_WA, *b, X_WB, options);
      if (found.stop != DistanceStop::kNear) break;
      const S rounding = 64 * std::numeric_limits<S>::epsilon() * (found.distance + 2 * radii);
      for (int step = -24; step <= 24; ++step) {
        SceneDistance<S> scene;
        scene.add(a, X_WA);
        scene.add(b, X_WB);
        SceneRequest verdicts;
        verdicts.exact = false;
        scene.pairsWithin(steps(found.distance + rounding, step), verdicts);
        const auto pair = scene.closestPair();
        ASSERT_TRUE(pair.has_value());
        ASSERT_EQ(pair->distance, exact.distance);
      }
      options.near_enough = found.distance * (1 - 4 * std::numeric_limits<S>::epsilon());
    }
  }
}

}  // namespace
}  // namespace kios::testing
