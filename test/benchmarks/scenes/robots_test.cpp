// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace kios::scenes {
namespace {

TEST(Robots, HumanoidHasItsLinks) {
  const Robot robot = humanoid();
  ASSERT_EQ(robot.links.size(), 19u);
  ASSERT_EQ(robot.centres.size(), 18u);
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    EXPECT_LT(robot.parents[i], static_cast<int>(i));
    EXPECT_GE(robot.links[i].mesh.triangles.size(), 1000u) << i;
    EXPECT_LE(robot.links[i].mesh.triangles.size(), 5000u) << i;
  }
}

TEST(Robots, HumanoidStandsUpright) {
  const Robot robot = humanoid();
  const auto poses = robotPoses(robot, fcl::Transform3d::Identity(), std::vector<double>(18, 0.0));
  double lowest = 1e9, highest = -1e9;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LE((poses[i].linear() - fcl::Matrix3d::Identity()).norm(), 1e-12) << i;
    for (const fcl::Vector3d& p : robot.links[i].mesh.vertices) {
      lowest = std::min(lowest, (poses[i] * p).z());
      highest = std::max(highest, (poses[i] * p).z());
    }
  }
  EXPECT_NEAR(highest - lowest, 1.8, 0.1);
  EXPECT_THROW(robotPoses(robot, fcl::Transform3d::Identity(), {0.0}), std::invalid_argument);
}

TEST(Robots, ScenesHoldWhatTheyPromise) {
  const Robot robot = robotOf(cadArm());
  const BodyScene two =
      twoRobots(robot, fcl::Transform3d::Identity(), fcl::Transform3d::Identity(), 3, true, 1);
  EXPECT_EQ(two.size(), 14);
  EXPECT_EQ(two.moving(), 14);
  EXPECT_TRUE(std::is_sorted(two.excluded.begin(), two.excluded.end()));
  EXPECT_GE(two.excluded.size(), 12u);

  const BodyScene crowd = driftingCrowd(50, 4, 1);
  EXPECT_EQ(crowd.size(), 50);
  ASSERT_EQ(crowd.frames.size(), 4u);
  for (int i = 0; i < 50; ++i) {
    const double step =
        (crowd.frames[1][i].translation() - crowd.frames[0][i].translation()).norm();
    EXPECT_LE(step, 0.01);
    EXPECT_GT(step, 0);
  }

  const BodyScene map = roadmap(robot, 60, 5, 1);
  EXPECT_EQ(map.size(), 67);
  EXPECT_EQ(map.moving(), 7);
  EXPECT_EQ(std::count(map.obstacle.begin(), map.obstacle.end(), true), 60);
  EXPECT_EQ(map.frames.size(), 5u);
}

}  // namespace
}  // namespace kios::scenes
