// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No two balls that touch are lost, at any scale, and few are found in vain.

#include "volume/ball_lanes.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "not_finite.h"
#include "volume/float_lanes.h"

namespace kios::testing {
namespace {

using fcl::Vector3d;
using scenes::Random;

TEST(BallLanes, FindAllThatTouch) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const double scale = kFloatScales[i % 8];
    const auto count = static_cast<std::size_t>(random.uniform(1, 23));
    BallLanes lanes;
    lanes.clear();
    std::vector<Vector3d> centers;
    std::vector<double> radii;
    for (std::size_t k = 0; k < count; ++k) {
      centers.push_back(pointWithin(random, scale));
      radii.push_back(random.unit() < 0.02 ? kInfinity : 0.6 * scale * random.unit());
      if (k > 0 && i % 3 == 0 && radii[0] < kInfinity) {  // touching
        radii[k] = std::max(0.0, (centers[k] - centers[0]).norm() * (1 + 1e-15) - radii[0]);
      }
      std::vector<char> found(k, 0);
      lanes.add(centers[k], radii[k], [&](std::size_t at) {
        EXPECT_EQ(std::exchange(found.at(at), 1), 0) << "found twice";
        return false;
      });
      for (std::size_t at = 0; at < k; ++at) {
        const long double apart =
            (centers[k].cast<long double>() - centers[at].cast<long double>()).stableNorm();
        const long double reach = static_cast<long double>(radii[k]) + radii[at];
        if (apart <= reach) {
          EXPECT_EQ(found[at], 1) << i;
        }
        if (scale > 1e-12 && scale < 1e17 && apart > reach + kVain * (scale + reach)) {
          EXPECT_EQ(found[at], 0) << i;
        }
      }
    }
  }
}

TEST(BallLanes, EndWhenToldTo) {
  BallLanes balls;
  for (int i = 0; i < 9; ++i) balls.add({0, 0, 0}, 1, [](std::size_t) { return false; });
  std::vector<std::size_t> seen;
  EXPECT_TRUE(balls.add({1, 0, 0}, 1, [&](std::size_t at) {
    seen.push_back(at);
    return at == 5;
  }));
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace kios::testing
