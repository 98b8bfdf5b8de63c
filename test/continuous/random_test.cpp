// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Random meshes on random motions against dense sampling by the exact oracle.

#include <cstdio>
#include <random>

#include "continuous/moving_meshes.h"

namespace kios::testing {
namespace {

class RandomMotions : public ::testing::TestWithParam<fcl::CCDMotionType> {};

/// Returns a motion of the type that rushes through about where the other object is.
Motion randomMotion(fcl::CCDMotionType type, double spread, std::mt19937_64& random,
                    const Vector3d& offset) {
  std::uniform_real_distribution<double> u(-1, 1);
  const auto pose = [&](double far) {
    const Vector3d axis(u(random), u(random), u(random));
    Transform3d X = at(u(random) * far, u(random) * far, u(random) * far, 3 * u(random), axis);
    X.translation() += offset;
    return X;
  };
  if (type != fcl::CCDM_SPLINE) return motionOf(type, pose(2.5 * spread), pose(2.5 * spread));
  const auto point = [&](double far) {
    return Vector3d(u(random) * far, u(random) * far, u(random) * far);
  };
  const double far = 3 * spread;
  return std::make_shared<fcl::SplineMotion<double>>(point(far) + offset, point(far) + offset,
                                                     point(far) + offset, point(far) + offset,
                                                     point(9), point(9), point(9), point(9));
}

TEST_P(RandomMotions, AgreeWithDenseSampling) {
  std::mt19937_64 random(17 + GetParam());
  Outcomes outcomes;
  for (const MeshCase& c : meshCases()) {
    const Pair pair(c.a, c.b);
    for (int i = 0; i < 12; ++i) {
      const Vector3d offset = i % 4 == 3 ? Vector3d(1e6, -1e6, 1e6) : Vector3d(0, 0, 0);
      const Motion a = randomMotion(GetParam(), c.spread, random, offset);
      const Motion b = randomMotion(GetParam(), c.spread, random, offset);
      const double toc_err = i % 3 == 0 ? 1e-2 : 1e-5;
      const Answer answer = ask(pair, *a, *b, toc_err);
      SCOPED_TRACE(std::string(c.name) + " " + std::to_string(i));
      expectRight(pair, *a, *b, answer.result, toc_err, 400, 20 * c.spread);
      outcomes.hits += answer.result.is_collide;
      ++outcomes.queries;
      outcomes.counts.steps += answer.counts.steps;
      outcomes.counts.volume_tests += answer.counts.volume_tests;
      outcomes.counts.leaf_tests += answer.counts.leaf_tests;
      EXPECT_LT(answer.counts.steps, 2000);
    }
  }
  outcomes.expectBothKinds();
}

INSTANTIATE_TEST_SUITE_P(Motions, RandomMotions, ::testing::ValuesIn(kMotionTypes));

}  // namespace
}  // namespace kios::testing
