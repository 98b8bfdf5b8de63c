// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The options of kios::distanceBracket: exact answers are fcl::distance's whatever they start from,
// tolerances are honoured everywhere. mesh_fuzz asks for every other one, at any distance that a
// search passes.

#include "fcl_kios/distance.h"

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

template <typename S>
struct Scene {
  const char* name;
  double extent;  ///< of A
  std::shared_ptr<Model<S>> model_a, model_b;
  std::vector<std::pair<fcl::Transform3<S>, fcl::Transform3<S>>> poses;
};

/// Returns pairs on their way and at random poses.
template <typename S>
std::vector<Scene<S>> scenesOf() {
  using namespace scenes;
  std::vector<Scene<S>> all;
  const auto add = [&all](const char* name, const Mesh& a, const Mesh& b,
                          const std::vector<Frame>& frames) {
    all.push_back({name, extent(a), modelOf<S>(a), modelOf<S>(b), {}});
    for (const Frame& f : frames) {
      all.back().poses.emplace_back(f.X_WA.template cast<S>(), f.X_WB.template cast<S>());
    }
  };
  const int frames = 150;
  add("falling", bentTorus(), knobbyTorus(), fallingMotion(frames));
  add("spinning", bumpyBlob(), bentTorus(), spinningMotion(frames / 2));
  const Mesh box = subdividedBox({1, 1.5, 2}, 6);
  std::vector<Frame> grid;  // ties everywhere
  for (int i = 0; i < frames; ++i) {
    Frame f{fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
    f.X_WB.translation() = fcl::Vector3d(i % 5 - 2, 1.75 - i % 3, (i % 7) * 0.5);
    grid.push_back(f);
  }
  add("boxes", box, box, grid);
  const Mesh soup = randomSoup(80, 1, 1e-2, 1, 3);
  add("soup", soup, soup, randomFrames(frames, 1.2, 4));
  const Mesh points = degenerateMesh(60, 3, 8);
  add("degenerate", points, points, randomFrames(frames, 1.2, 5));
  return all;
}

template <typename S>
bool sameAnswer(const DistanceBracketResult<S>& a, const DistanceBracketResult<S>& b) {
  return a.distance == b.distance && a.triangle_a == b.triangle_a && a.triangle_b == b.triangle_b &&
         a.point_a == b.point_a && a.point_b == b.point_b && a.lower_bound == b.lower_bound &&
         a.upper_bound == b.upper_bound && a.stop == b.stop;
}

KIOS_SCALAR_SUITE(Distance);

// The last answer, wrong models' ids, random ids: an exact answer shows nothing of its start.
TYPED_TEST(Distance, ExactAnswersDontDependOnTheStart) {
  using S = TypeParam;
  Random random(21);
  for (const auto& scene : scenesOf<S>()) {
    SCOPED_TRACE(scene.name);
    WarmStart last;
    for (const auto& [X_WA, X_WB] : scene.poses) {
      const auto cold = kios::distanceBracket(*scene.model_a, X_WA, *scene.model_b, X_WB);
      fcl::DistanceResult<S> result;
      SearchCounts counts;
      distanceMeshes(*scene.model_a, X_WA, *scene.model_b, X_WB, fcl::DistanceRequest<S>(true),
                     result, &counts);
      ASSERT_EQ(cold.distance, result.min_distance);
      ASSERT_EQ(cold.triangle_a, result.b1);
      ASSERT_EQ(cold.triangle_b, result.b2);
      ASSERT_EQ(cold.counts.expansions, counts.expansions);
      ASSERT_EQ(cold.counts.exact, counts.exact);
      WarmStart wrong = {static_cast<int>(random.uniform(-10, 1e4)),
                         static_cast<int>(random.uniform(-10, 1e2))};
      for (WarmStart* const start : {&last, &wrong}) {
        DistanceBracketRequest<S> options;
        options.warm_start = start;
        const auto warm =
            kios::distanceBracket(*scene.model_a, X_WA, *scene.model_b, X_WB, options);
        ASSERT_EQ(start->triangle_a, cold.triangle_a);
        ASSERT_EQ(start->triangle_b, cold.triangle_b);
        ASSERT_TRUE(sameAnswer(warm, cold)) << warm.distance << " " << cold.distance;
        // Bounds that don't stop the search change nothing either, but what is proven.
        options.near_enough = S(0.5) * cold.distance;
        options.far_enough = 2 * cold.distance + S(1);
        const auto bounded =
            kios::distanceBracket(*scene.model_a, X_WA, *scene.model_b, X_WB, options);
        ASSERT_EQ(bounded.distance, cold.distance);
        if (cold.distance > 0) {
          ASSERT_EQ(bounded.triangle_a, cold.triangle_a);
          ASSERT_EQ(bounded.triangle_b, cold.triangle_b);
          ASSERT_EQ(bounded.stop, DistanceStop::kTolerance);
        }
      }
    }
  }
}

// Work falls as errors grow, in sum, and no answer errs by more than was allowed.
TYPED_TEST(Distance, TolerancesAreHonouredAndSaveWork) {
  using S = TypeParam;
  for (const auto& scene : scenesOf<S>()) {
    SCOPED_TRACE(scene.name);
    const double eps = std::numeric_limits<S>::epsilon(), size = scene.extent;
    long long last_work = std::numeric_limits<long long>::max() / 2;
    for (const S e : {S(0), S(1e-2), S(0.1), S(0.5), S(10)}) {
      long long work = 0;
      for (const auto& [X_WA, X_WB] : scene.poses) {
        const S exact = kios::distanceBracket(*scene.model_a, X_WA, *scene.model_b, X_WB).distance;
        fcl::DistanceRequest<S> request;
        request.rel_err = e;
        fcl::DistanceResult<S> result;
        SearchCounts counts;
        distanceMeshes(*scene.model_a, X_WA, *scene.model_b, X_WB, request, result, &counts);
        ASSERT_LE(result.min_distance, double{exact} * (1 + double{e}) + 100 * eps * size);
        ASSERT_EQ(result.min_distance == 0, exact == 0);  // either tolerance, and 0 has none
        DistanceBracketRequest<S> options;
        options.abs_err = e;
        const auto answer =
            kios::distanceBracket(*scene.model_a, X_WA, *scene.model_b, X_WB, options);
        ASSERT_LE(answer.distance, double{exact} + double{e} + 100 * eps * size);
        work += counts.volume_tests + answer.counts.volume_tests;
      }
      EXPECT_LE(work, last_work + last_work / 50) << e;
      last_work = work;
    }
  }
}

TEST(DistanceOptionsTest, BadOnesAreRefused) {
  const auto model = modelOf<double>(scenes::bumpyTorus(200));
  const auto X = fcl::Transform3d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const auto& change) {
    DistanceBracketRequest<double> options;
    change(options);
    EXPECT_THROW(kios::distanceBracket(*model, X, *model, X, options), std::invalid_argument);
  };
  refused([](auto& o) { o.rel_err = -0.1; });
  refused([nan](auto& o) { o.rel_err = nan; });
  refused([](auto& o) { o.abs_err = -1; });
  refused([nan](auto& o) { o.abs_err = nan; });
  refused([nan](auto& o) { o.far_enough = nan; });
  refused([nan](auto& o) { o.near_enough = nan; });
  refused([](auto& o) { o.max_expansions = -1; });
  EXPECT_THROW(closerThan(*model, X, *model, X, nan), std::invalid_argument);
  fcl::Transform3d sheared = X;
  sheared.linear()(0, 1) = 0.1;
  EXPECT_THROW(kios::distanceBracket(*model, X, *model, sheared), std::invalid_argument);
  EXPECT_THROW(closerThan(*model, X, *model, sheared, 1), std::invalid_argument);
  EXPECT_THROW(kios::distanceBracket(Modeld(), X, *model, X), std::invalid_argument);
  EXPECT_THROW(closerThan(Modeld(), X, *model, X, -1), std::invalid_argument);
}

TEST(DistanceOptionsTest, NothingLookedAt) {
  const auto model = modelOf<double>(scenes::bumpyTorus(200));
  const auto X = fcl::Transform3d::Identity();
  fcl::Transform3d far = X;
  far.translation().x() = 100;
  for (const double far_enough : {0.0, -1.0, 50.0}) {
    DistanceBracketRequest<double> options;
    options.far_enough = far_enough;
    WarmStart warm = {7, 8};
    options.warm_start = &warm;
    const auto answer = kios::distanceBracket(*model, X, *model, far, options);
    EXPECT_EQ(answer.stop, DistanceStop::kFar);
    EXPECT_EQ(answer.distance, std::numeric_limits<double>::infinity());
    EXPECT_EQ(answer.triangle_a, -1);
    EXPECT_TRUE(std::isnan(answer.point_a.x()));
    EXPECT_EQ(warm.triangle_a, 7);
  }
}

}  // namespace
}  // namespace kios::testing
