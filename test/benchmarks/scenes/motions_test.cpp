// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenes/oracle.h"
#include "scenes/pqp_data.h"
#include "scenes/shapes.h"

namespace kios::scenes {
namespace {

void expectRotation(const fcl::Matrix3d& R) {
  EXPECT_LE((R.transpose() * R - fcl::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(R.determinant(), 0);
}

TEST(Motions, FallingTouchesInSomeFramesAndNotInMost) {
  constexpr int kFrames = 150;
  const MeshOracle oracle(bentTorus(), knobbyTorus());
  const auto frames = fallingMotion(kFrames);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  const auto contacts = std::count_if(frames.begin(), frames.end(), [&](const Frame& frame) {
    return oracle.collide(frame.X_WA, frame.X_WB);
  });
  EXPECT_GT(contacts, kFrames / 12);
  EXPECT_LT(contacts, kFrames / 3);
}

TEST(Motions, SpinningFollowsThePaper) {
  const auto frames = spinningMotion(10);
  const fcl::Transform3d& X_WA = frames[9].X_WA;  // angles 1, 2, 3
  expectRotation(X_WA.linear());
  EXPECT_EQ(X_WA.translation(), fcl::Vector3d(-1, 0, 0));
  EXPECT_EQ(frames[9].X_WB.translation(), fcl::Vector3d(1, 0, 0));
  EXPECT_NEAR(X_WA.linear()(0, 2), std::sin(2.0), 1e-14);
  EXPECT_NEAR(X_WA.linear()(0, 0), std::cos(2.0) * std::cos(3.0), 1e-14);
  EXPECT_NEAR(frames[9].X_WB.linear()(0, 2), std::sin(1.0), 1e-14);
}

TEST(Motions, RandomPosesAreRigidAndSeeded) {
  const auto poses = randomPoses(100, 5, 11);
  fcl::Matrix3d mean = fcl::Matrix3d::Zero();
  for (const auto& X : poses) {
    expectRotation(X.linear());
    EXPECT_LE(X.translation().cwiseAbs().maxCoeff(), 5);
    mean += X.linear() / 100;
  }
  EXPECT_LE(mean.cwiseAbs().maxCoeff(), 0.25);  // uniform rotations average to zero
  EXPECT_EQ(poses[99].matrix(), randomPoses(100, 5, 11)[99].matrix());
}

TEST(Motions, GapMotionReachesItsGap) {
  const Mesh torus = bumpyTorus(400);
  const MeshOracle oracle(torus, torus);
  const auto distance = [&](const Frame& f) { return oracle.distance(f.X_WA, f.X_WB); };
  for (const double gap : {0.1, 1e-3}) {
    for (const Frame& frame : gapMotion(5, gap, 4, 1, distance)) {
      EXPECT_NEAR(distance(frame), gap, 2e-6 * gap);
    }
  }
  for (const Frame& frame : gapMotion(5, 0, 4, 1, distance)) EXPECT_EQ(distance(frame), 0);
  EXPECT_THROW(gapMotion(5, 4, 4, 1, distance), std::invalid_argument);
}

TEST(Motions, FarMotionKeepsItsDistances) {
  for (const Frame& frame : farMotion(50, 3, 10, 7)) {
    expectRotation(frame.X_WA.linear());
    expectRotation(frame.X_WB.linear());
    const double distance = (frame.X_WB.translation() - frame.X_WA.translation()).norm();
    EXPECT_GE(distance, 3 - 1e-12);
    EXPECT_LE(distance, 10 + 1e-12);
  }
}

// Returns the loader's message about a file of the given text; empty if it takes the file.
template <typename Load>
std::string complaint(const std::string& text, const Load& load) {
  const auto file =
      std::filesystem::temp_directory_path() /
      ("kios_loader_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + ".txt");
  std::ofstream(file) << text;
  std::string message;
  try {
    load(file);
  } catch (const std::runtime_error& error) {
    message = error.what();
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  }
  std::filesystem::remove(file);
  return message;
}

TEST(PqpData, ReadsTrisAndNamesFaults) {
  EXPECT_EQ(complaint("1\n0 0 0\n1 0 0\n0 1 0\n", loadTris), "");
  EXPECT_NE(complaint("x", loadTris).find("number of triangles"), std::string::npos);
  EXPECT_NE(complaint("0", loadTris).find("number of triangles"), std::string::npos);
  EXPECT_NE(complaint("2\n0 0 0\n1 0 0\n0 1 0\n", loadTris).find("ends within triangle 1"),
            std::string::npos);
  EXPECT_NE(complaint("1\n0 0 q\n", loadTris).find("no finite number in triangle 0"),
            std::string::npos);
  EXPECT_NE(complaint("1\n0 0 0\n1 0 0\n0 1 0\n7", loadTris).find("goes on"), std::string::npos);
  EXPECT_THROW(loadTris("/nonexistent/mesh.tris"), std::runtime_error);
}

TEST(PqpData, ReadsPathRowByRow) {
  std::vector<fcl::Transform3d> poses;
  EXPECT_EQ(complaint("1\n1 2 3\n4 5 6\n7 8 9\n10 11 12\n\n",
                      [&](const auto& file) { poses = loadPath(file); }),
            "");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].linear()(0, 1), 2);
  EXPECT_EQ(poses[0].translation(), fcl::Vector3d(10, 11, 12));
}

TEST(PqpData, PaperScenes) {
  const auto folder = findData();
  if (!folder) GTEST_SKIP() << "no data folder: set KIOS_DATA";
  const MovingPair falling = loadFalling(*folder);
  EXPECT_EQ(falling.a.triangles.size(), 1332u);
  EXPECT_EQ(falling.b.triangles.size(), 3240u);
  EXPECT_EQ(falling.frames.size(), 2398u);
  const MeshOracle oracle(falling.a, falling.b);
  EXPECT_EQ(
      std::count_if(falling.frames.begin(), falling.frames.end(),
                    [&](const Frame& frame) { return oracle.collide(frame.X_WA, frame.X_WB); }),
      392);
  const MovingPair spinning = loadSpinning(*folder, 20);
  EXPECT_EQ(spinning.a.triangles.size(), 2204u);
  EXPECT_EQ(spinning.b.triangles.size(), 1332u);
  EXPECT_EQ(spinning.frames.size(), 20u);
}

}  // namespace
}  // namespace kios::scenes
