// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Clearances, gradients and motions of robots, against all pairs, differences and samples: an arm
// of all joints and shapes, and the Panda where its files are.

#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// Returns an arm, of every joint if none is given, with shapes and meshes around it.
Robot cluttered(const Folder& folder, int meshes = 4, int shapes = 4, const Robot* arm = nullptr) {
  Robot robot = arm ? *arm : loadRobot(manyJoints(folder));
  Random random(5);
  for (int i = 0; i < meshes + shapes; ++i) {
    const Transform3d X =
        shifted(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1.4));
    Geometry geometry;
    if (i < meshes) {
      geometry = loadMesh(folder.write("o.obj", boxObj(0.1, 0.05 + 0.02 * i, 0.2)));
    } else if (i % 4 == 0) {
      geometry = std::make_shared<fcl::Sphered>(0.15);
    } else if (i % 4 == 1) {
      geometry = std::make_shared<fcl::Cylinderd>(0.1, 0.4);
    } else if (i % 4 == 2) {
      geometry = std::make_shared<fcl::Boxd>(0.2, 0.3, 0.1);
    } else {
      geometry = std::make_shared<fcl::Capsuled>(0.08, 0.3);
    }
    robot.addObstacle("o" + std::to_string(i), geometry, X);
  }
  return robot;
}

VectorXd free(const Robot& robot, Random& random) {
  VectorXd q;
  do {
    q = randomConfiguration(robot, random);
    q.head(2) *= 0.3;
  } while (robot.clearance(q).clearance < 1e-3);
  return q;
}

/// Finds the derivative by central differences, or nothing where the nearest pair changes on the
/// way.
bool differences(const Robot& robot, const VectorXd& q, const RobotClearance& at, VectorXd& slope) {
  constexpr double kStep = 1e-5;
  slope.resize(q.size());
  for (int k = 0; k < q.size(); ++k) {
    double d[2];
    for (int side = 0; side < 2; ++side) {
      VectorXd p = q;
      p[k] += side == 0 ? kStep : -kStep;
      const RobotClearance there = robot.clearance(p);
      if (there.a != at.a || there.b != at.b || (there.point_a - at.point_a).norm() > 10 * kStep ||
          (there.point_b - at.point_b).norm() > 10 * kStep) {
        return false;
      }
      d[side] = there.clearance;
    }
    slope[k] = (d[0] - d[1]) / (2 * kStep);
  }
  return true;
}

void expectGradients(const Robot& robot, int count, std::uint64_t seed) {
  Random random(seed);
  int unique = 0;
  for (int i = 0; i < count; ++i) {
    const VectorXd q = free(robot, random);
    const RobotClearance clearance = robot.clearance(q);
    ASSERT_EQ(clearance.gradient.size(), q.size());
    VectorXd slope;
    if (!differences(robot, q, clearance, slope)) continue;
    ++unique;
    EXPECT_LE((clearance.gradient - slope).lpNorm<Eigen::Infinity>(), 1e-6)
        << clearance.a << " " << clearance.b << " " << clearance.clearance;
  }
  EXPECT_GT(unique, count / 4);
}

TEST(RobotQueries, GradientsAreThoseOfDifferences) {
  const Folder folder;
  expectGradients(cluttered(folder), 200, 1);
  expectGradients(cluttered(folder, 6, 0), 100, 2);
  if (mbmFolder("panda").empty()) return;
  const Robot panda = loadMbm("panda");
  ASSERT_EQ(panda.coordinates(), 7);
  EXPECT_EQ(panda.joints()[3], "panda_joint4");
  EXPECT_EQ(panda.lower()[3], -3.1416);
  EXPECT_EQ(panda.state("ready")[1], -0.785);
  expectGradients(cluttered(folder, 0, 5, &panda), 100, 3);
}

TEST(RobotQueries, ClearanceToItselfAndToObstaclesApart) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  ClearanceRequest itself, obstacles;
  itself.among = RobotPairs::kItself;
  obstacles.among = RobotPairs::kObstacles;
  Random random(4);
  EXPECT_TRUE(robot.clearance(randomConfiguration(robot, random), obstacles).a.empty());
  robot.addObstacle("ball", std::make_shared<fcl::Sphered>(0.1), shifted(0.6, 0, 0.6));
  robot.attach("cup", "tool", std::make_shared<fcl::Sphered>(0.02), shifted(0, 0, 0.1));
  for (int i = 0; i < 100; ++i) {
    const VectorXd q = randomConfiguration(robot, random);
    const auto all = robot.clearance(q), own = robot.clearance(q, itself),
               others = robot.clearance(q, obstacles);
    EXPECT_EQ(all.clearance, std::min(own.clearance, others.clearance));
    EXPECT_NE(own.b, "ball");
    EXPECT_EQ(others.b, "ball");
  }
}

TEST(RobotQueries, AllLinksMayBePadded) {
  const Folder folder;
  RobotOptions options;
  options.padding = 0.01;
  const Robot all = loadRobot(manyJoints(folder), "", options);
  const Robot none = loadRobot(manyJoints(folder));
  const VectorXd q = VectorXd::Zero(8);
  EXPECT_NEAR(all.clearance(q).clearance, none.clearance(q).clearance - 0.02, 1e-15);
}

TEST(RobotQueries, MotionsBeyondLimitsAreRefusedWhereAsked) {
  const Folder folder;
  const Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q0 = VectorXd::Zero(8);
  VectorXd q1 = q0;
  q1[5] = 2.6;  // the elbow, up to 2.5
  RobotMotionRequest request;
  robot.checkMotion(q0, q1, request);
  request.within_limits = true;
  robot.checkMotion(q0, q0, request);
  expectRefused([&] { robot.checkMotion(q0, q1, request); },
                "q1 is beyond the limits of the joint 'elbow'");
  expectRefused([&] { robot.checkMotion(q1, q0, request); }, "q0 is beyond");
  expectRefused([&] { robot.checkMotions(q0, q1, request); }, "q1, column 0, is beyond");
}

TEST(RobotQueries, BatchesAnswerAsOneByOne) {
  const Folder folder;
  const Robot robot = cluttered(folder);
  Random random(7);
  Eigen::MatrixXd q0(8, 300), q1(8, 300);
  for (int i = 0; i < 300; ++i) {
    q0.col(i) = randomConfiguration(robot, random);
    q1.col(i) = q0.col(i) + 0.1 * VectorXd::Ones(8);
  }
  for (const int threads : {0, 1, 3}) {
    const auto contacts = robot.contacts(q0, threads);
    const auto clearances = robot.clearances(q0, {}, threads);
    const auto motions = robot.checkMotions(q0, q1, {}, threads);
    ASSERT_EQ(contacts.size(), 300u);
    for (int i = 0; i < 300; ++i) {
      EXPECT_EQ(contacts[i] != 0, robot.contact(q0.col(i)).has_value());
      const RobotClearance one = robot.clearance(q0.col(i));
      EXPECT_EQ(clearances[i].clearance, one.clearance);
      EXPECT_EQ(clearances[i].gradient, one.gradient);
      const RobotMotion motion = robot.checkMotion(q0.col(i), q1.col(i));
      EXPECT_EQ(motions[i].verdict, motion.verdict);
      EXPECT_EQ(motions[i].to, motion.to);
      EXPECT_EQ(motions[i].a, motion.a);
    }
  }
  EXPECT_TRUE(robot.contacts(Eigen::MatrixXd(8, 0)).empty());
  expectRefused([&] { robot.contacts(Eigen::MatrixXd::Zero(7, 3)); }, "rows");
  q0(2, 5) = std::numeric_limits<double>::quiet_NaN();
  expectRefused([&] { robot.contacts(q0); }, "column 5");
  expectRefused([&] { robot.contacts(q1, -1); }, "threads");
}

}  // namespace
}  // namespace kios::testing
