// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/arms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace kios::scenes {
namespace {

TEST(Arms, CadLinksHaveTheirTriangles) {
  const Arm arm = cadArm();
  ASSERT_EQ(arm.links.size(), 7u);
  for (const Link& link : arm.links) {
    EXPECT_GE(link.mesh.triangles.size(), 1000u);
    EXPECT_LE(link.mesh.triangles.size(), 5000u);
  }
}

TEST(Arms, StripChainHasItsStrips) {
  const Arm chain = stripChain();
  ASSERT_EQ(chain.links.size(), 4u);
  for (const Link& link : chain.links) {
    EXPECT_GE(link.mesh.triangles.size(), 400u);
    EXPECT_LE(link.mesh.triangles.size(), 1600u);
  }
  // Stretched along x: each link's mesh begins where the one before ends.
  const auto poses = linkPoses(chain, fcl::Transform3d::Identity(), {0, 0, 0});
  for (int i = 0; i < 4; ++i) {
    EXPECT_LE((poses[i].translation() - fcl::Vector3d(0.6 * i, 0, 0)).norm(), 1e-12);
    EXPECT_LE((poses[i].linear().col(2) - fcl::Vector3d::UnitX()).norm(), 1e-12);
  }
}

TEST(Arms, CadArmStretchesUpward) {
  const Arm arm = cadArm();
  const auto poses = linkPoses(arm, fcl::Transform3d::Identity(), std::vector<double>(6, 0));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE((poses[i].linear().col(2) - fcl::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_GT(poses[i].translation().z(), poses[i - 1].translation().z());
  }
}

TEST(Arms, JointsTurnAboutTheirAxis) {
  const Arm chain = stripChain();
  const auto straight = linkPoses(chain, fcl::Transform3d::Identity(), {0, 0, 0});
  const auto bent = linkPoses(chain, fcl::Transform3d::Identity(), {0.5, 0, 0});
  EXPECT_EQ(straight[0].matrix(), bent[0].matrix());
  EXPECT_NEAR(straight[1].linear().col(2).dot(bent[1].linear().col(2)), std::cos(0.5), 1e-12);
  EXPECT_THROW(linkPoses(chain, fcl::Transform3d::Identity(), {0, 0}), std::invalid_argument);
}

TEST(Arms, MotionIsSmoothSeededAndInRange) {
  const Arm arm = cadArm();
  const auto motion = armMotion(arm, 400, 1);
  ASSERT_EQ(motion.size(), 400u);
  for (std::size_t joint = 0; joint < 6; ++joint) {
    for (std::size_t frame = 0; frame < motion.size(); ++frame) {
      const double angle = motion[frame][joint];
      EXPECT_LE(std::abs(angle - arm.centres[joint]), arm.amplitudes[joint]);
      if (frame > 0) {
        EXPECT_LE(std::abs(angle - motion[frame - 1][joint]), 0.15 * arm.amplitudes[joint]);
      }
    }
  }
  EXPECT_EQ(motion, armMotion(arm, 400, 1));
  EXPECT_NE(motion, armMotion(arm, 400, 2));
}

}  // namespace
}  // namespace kios::scenes
