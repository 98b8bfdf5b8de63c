// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "solid/solid_meshes.h"

namespace kios {
namespace {

using scenes::Random;

TEST(ContainsPosed, ThePointIsMappedIntoTheModel) {
  const auto model = testing::solidOf(scenes::subdividedBox({2, 4, 6}, 3));
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const fcl::Transform3d X = testing::wholePose(random, 100);
    const fcl::Vector3d p(random.uniform(-1.5, 1.5), random.uniform(-3, 3), random.uniform(-4, 4));
    const fcl::Vector3d out = p.cwiseAbs() - fcl::Vector3d(1, 2, 3);
    if (std::abs(out.maxCoeff()) < 1e-9) continue;
    EXPECT_EQ(contains<double>(*model, X, X * p), out.maxCoeff() < 0);
  }
}

TEST(ContainsPosed, ModelsBeyondTheRangeOfPreparedTreesAreServed) {
  const auto model =
      testing::solidOf(testing::transformed(scenes::icosphere(1, 2), 1e-30, {0, 0, 0}));
  EXPECT_TRUE(contains<double>(*model, fcl::Transform3d::Identity(), {1e-31, 0, 0}));
  EXPECT_FALSE(contains<double>(*model, fcl::Transform3d::Identity(), {1e-30, 1e-30, 0}));
}

TEST(ContainsPosed, BadArgumentsAreRefused) {
  const auto soup = testing::modelOf(scenes::icosphere(1, 1));
  const fcl::Transform3d X = fcl::Transform3d::Identity();
  EXPECT_THROW(contains<double>(*soup, X, {0, 0, 0}), std::invalid_argument);
  const auto model = testing::solidOf(scenes::icosphere(1, 1));
  EXPECT_THROW(contains<double>(*model, X, {0, NAN, 0}), std::invalid_argument);
  fcl::Transform3d skew = X;
  skew.linear() *= 2;
  EXPECT_THROW(contains<double>(*model, skew, {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace kios
