// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A program that knows FCL alone, with the library linked before libfcl.
#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

#include <gtest/gtest.h>
#include "preload/fcl_meshes.h"

namespace {

using fcl::Transform3d;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

// Before the first query: copies that don't all find room.
const bool little_memory = [] {
  setenv("FCL_KIOS_PRELOAD_MIB", "1", 1);
  return true;
}();

bool touch(const Model& a, const Model& b, const Transform3d& X_WB) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, Transform3d::Identity(), &b, X_WB, fcl::CollisionRequestd(), result) > 0;
}

TEST(Threads, SharedModelsWhileOthersComeAndGo) {
  ASSERT_TRUE(little_memory);
  const auto a = build<fcl::OBBRSSd>(torus(20, 14)), b = build<fcl::OBBRSSd>(torus(18, 12));
  constexpr int kPoses = 40, kThreads = 4, kRounds = 60;
  std::mt19937 random(1);
  std::vector<Transform3d> poses;
  std::vector<double> distances;
  std::vector<bool> verdicts;
  for (int i = 0; i < kPoses; ++i) {
    poses.push_back(randomPose(random, 2.2, 3.4));
    distances.push_back(distanceOf(*a, *b, poses[i]));
    verdicts.push_back(touch(*a, *b, poses[i]));
  }
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < kRounds; ++round) {
        // Each thread's own, in memory that others had, of two shapes by turns.
        const double size = (round + t) % 2 == 0 ? 1 : 0.7;
        const auto own = build<fcl::OBBRSSd>(torus(16, 10, size));
        for (int i = 0; i < kPoses; ++i) {
          if (std::abs(distanceOf(*a, *b, poses[i]) - distances[i]) > 1e-12) ++wrong;
          if (touch(*a, *b, poses[i]) != verdicts[i]) ++wrong;
          // Its size shows on a line through its middle, whatever else is asked about.
          Transform3d X_WO = Transform3d::Identity();
          X_WO.translation() = fcl::Vector3d(5 + 0.01 * i, 0, 0);
          const double own_distance = distanceOf(*own, *own, X_WO);
          if (std::abs(own_distance - (5 + 0.01 * i)) > 3.2 * size) ++wrong;
          if (size == 1 ? own_distance > 2.6 + 0.01 * i : own_distance < 2.6 + 0.01 * i) ++wrong;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
