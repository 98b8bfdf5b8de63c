// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "benchmarks/scenes/mesh_checks.h"
#include "scenes/arms.h"
#include "scenes/cad_parts.h"
#include "scenes/cad_shapes.h"
#include "scenes/mesh_folder.h"
#include "scenes/oracle.h"
#include "scenes/pqp_data.h"
#include "scenes/ur5_data.h"
#include "scenes/worlds.h"

namespace kios::scenes {
namespace {

TEST(Robots, MotionIsSmoothSeededAndInRange) {
  const Robot arm = cadArm();
  const auto motion = jointMotion(arm, 400, true, 1);
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
  EXPECT_EQ(motion, jointMotion(arm, 400, true, 1));
  EXPECT_NE(motion, jointMotion(arm, 400, true, 2));
}

TEST(Robots, ScenesHoldWhatTheyPromise) {
  const Robot robot = cadArm();
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

// A link's mesh reaches from its joint to the next, at any angles.
TEST(Robots, LinksOfAChainReachFromJointToJoint) {
  std::vector<Mesh> meshes = {filletedBar(0.1, 0.05, 0.4, 0.01, 3), tube(0.02, 0.05, 0.3, 12),
                              boredBlock({0.5, 0.1, 0.1}, 0.01, 0.01, 0.03, 16)};
  meshes[1] =
      moved(fcl::Transform3d(fcl::AngleAxisd(std::acos(0.0), fcl::Vector3d::UnitX())), meshes[1]);
  const Robot chain = chainOf(meshes);
  EXPECT_NEAR(chainLength(chain), 1.2, 1e-12);
  ASSERT_EQ(chain.centres.size(), 2u);
  const auto poses = robotPoses(chain, fcl::Transform3d::Identity(), {0, 0});
  double top = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double low = 1e9, high = -1e9;
    for (const fcl::Vector3d& p : meshes[i].vertices) {
      low = std::min(low, (poses[i] * p).z());
      high = std::max(high, (poses[i] * p).z());
    }
    EXPECT_NEAR(low, top, 1e-12);
    top = high;
  }
  EXPECT_NEAR(top, 1.2, 1e-12);
}

TEST(Robots, FoldersOfMeshesAreReadByName) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / "kios_mesh_folder";
  fs::remove_all(folder);
  fs::create_directories(folder);
  EXPECT_THROW(loadMeshes(folder), std::runtime_error);
  const auto write = [&folder](const char* name, int corners) {
    std::ofstream file(folder / name);
    file << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 0\nf";
    for (int i = 1; i <= corners; ++i) file << ' ' << i;
    file << '\n';
  };
  write("b.obj", 3);
  write("a.OBJ", 4);
  write("notes.txt", 3);
  const std::vector<Mesh> meshes = loadMeshes(folder);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].triangles.size(), 2u);
  EXPECT_EQ(meshes[0].vertices.size(), 4u);
  EXPECT_EQ(meshes[1].triangles.size(), 1u);
  EXPECT_THROW(loadUr5("/nonexistent"), std::runtime_error);
}

TEST(Robots, TheUr5OfTheDataFolder) {
  const auto folder = findData();
  if (!folder || !holdsUr5(*folder)) GTEST_SKIP() << "no data folder: set KIOS_DATA";
  const Robot arm = loadUr5(*folder);
  ASSERT_EQ(arm.links.size(), 7u);
  const std::size_t triangles[] = {235, 674, 1176, 1050, 702, 702, 446};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(arm.links[i].mesh.triangles.size(), triangles[i]);
    EXPECT_LT(arm.links[i].mesh.vertices.size(), 3 * triangles[i] / 4);
  }
  // The wrist's centre with all joints at 0: UR's published lengths.
  const auto poses = robotPoses(arm, fcl::Transform3d::Identity(), std::vector<double>(6, 0));
  const fcl::Vector3d wrist = poses[6] * arm.links[6].X_LM.inverse() * fcl::Vector3d::Zero();
  EXPECT_LE((wrist - fcl::Vector3d(-0.81725, -0.19145, -0.005491)).norm(), 1e-9);
}

}  // namespace
}  // namespace kios::scenes
