// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "fcl/mesh_cases.h"
#include "scenes/random.h"

// kios::distance with random options against the oracle: no bracket misses.

namespace kios::testing {
namespace {

using scenes::Random;

DistanceOptions<double> randomOptions(Random& random, double exact) {
  DistanceOptions<double> options;
  const auto sometimes = [&random](double p) { return random.uniform(0, 1) < p; };
  const auto power = [&random](double low, double high) {
    return std::pow(10, random.uniform(low, high));
  };
  if (sometimes(0.5)) options.rel_err = power(-4, 1);
  if (sometimes(0.3)) options.abs_err = power(-4, 0);
  if (sometimes(0.3)) options.far_enough = (exact + 1e-3) * random.uniform(0.1, 2);
  if (sometimes(0.3)) options.near_enough = (exact + 1e-3) * random.uniform(0.1, 2);
  if (sometimes(0.3)) options.max_expansions = static_cast<long long>(power(0, 3)) - 1;
  options.nearest_points = sometimes(0.5);
  return options;
}

TEST(Distance, RandomOptionsNeverMiss) {
  Random random(11);
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    const auto a = kiosModel(c.a), b = kiosModel(c.b);
    const scenes::MeshOracle oracle(c.a, c.b);
    WarmStart warm;
    for (const Frame& f : randomFrames(40, c.spread, 5)) {
      const double exact = oracle.distance(f.X_WA, f.X_WB);
      for (int i = 0; i < 8; ++i) {
        DistanceOptions<double> o = randomOptions(random, exact);
        if (i % 2 == 1) o.warm_start = &warm;
        const auto answer = kios::distance(*a, f.X_WA, *b, f.X_WB, o);
        ASSERT_LE(answer.lower_bound, exact);
        ASSERT_GE(answer.upper_bound, exact);
        ASSERT_LE(answer.lower_bound, answer.distance);
        ASSERT_LE(answer.distance, answer.upper_bound);
        ASSERT_EQ(answer.triangle1 < 0, answer.distance == std::numeric_limits<double>::infinity());
        SCOPED_TRACE(::testing::Message()
                     << "rel " << o.rel_err << " abs " << o.abs_err << " far " << o.far_enough
                     << " near " << o.near_enough << " budget " << o.max_expansions << " warm "
                     << (o.warm_start != nullptr) << " lower " << answer.lower_bound << " d "
                     << answer.distance << " exact " << exact);
        const double error = 1e-14;
        switch (answer.stop) {
          case DistanceStop::kTolerance:
            ASSERT_LE(answer.distance, exact + std::max(o.rel_err * exact, o.abs_err) + error);
            break;
          case DistanceStop::kNear:
            ASSERT_LE(answer.distance, o.near_enough);
            break;
          case DistanceStop::kFar:
            ASSERT_GE(answer.lower_bound, o.far_enough);
            break;
          case DistanceStop::kBudget:
            ASSERT_LE(answer.counts.expansions, o.max_expansions);
        }
      }
    }
  }
}

TEST(Distance, ExactIsFclsDistance) {
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    const auto a = kiosModel(c.a), b = kiosModel(c.b);
    WarmStart warm;
    for (const Frame& f : randomFrames(60, c.spread, 6)) {
      fcl::DistanceResultd result;
      const double d = distanceMeshes(*a, f.X_WA, *b, f.X_WB, fcl::DistanceRequestd(true), result);
      for (const bool warmed : {false, true}) {
        DistanceOptions<double> o;
        if (warmed) o.warm_start = &warm;
        const auto answer = kios::distance(*a, f.X_WA, *b, f.X_WB, o);
        ASSERT_EQ(answer.distance, d);
        ASSERT_EQ(answer.triangle1, result.b1);
        ASSERT_EQ(answer.triangle2, result.b2);
        ASSERT_EQ(answer.point1, result.nearest_points[0]);
        ASSERT_EQ(answer.point2, result.nearest_points[1]);
        ASSERT_LE(answer.upper_bound - answer.lower_bound, 1e-13);
      }
    }
  }
}

TEST(CloserThan, AgreesWithTheExactDistance) {
  Random random(12);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    const auto a = kiosModel(c.a), b = kiosModel(c.b);
    for (const Frame& f : randomFrames(40, c.spread, 7)) {
      const double d = kios::distance(*a, f.X_WA, *b, f.X_WB).distance;
      std::vector<double> ts = {0,
                                d,
                                std::nextafter(d, kInf),
                                std::nextafter(d, -1.),
                                0.9 * d,
                                1.1 * d,
                                d + 1e-15,
                                d - 1e-15,
                                d + 1e-12,
                                d - 1e-12,
                                1e-300,
                                -1,
                                kInf,
                                -kInf,
                                random.uniform(0, 2 * d)};
      for (const double t : ts) {
        DistanceAnswer<double> proof;
        ASSERT_EQ(closerThan(*a, f.X_WA, *b, f.X_WB, t, &proof), d <= t) << d << " " << t;
        if (d <= t) {
          ASSERT_LE(proof.distance, t);
        } else {
          ASSERT_GE(proof.lower_bound, std::max(0.0, t - 1e-13));
        }
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
