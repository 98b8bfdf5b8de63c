// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The least clearance over ranges of joints: mechanisms whose minima are known, random trees of
// joints against dense samples, and budgets.
#include "linkage/joint_ranges.h"

namespace kios::testing {
namespace {

double leastAt(const RobotCase& robot, const Joints& q) {
  double least = kInf;
  const auto X = robot.poses(q);
  const int count = static_cast<int>(robot.bodies.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (!robot.checked(a, b)) continue;
      const bool meet = robot.meet(a, X[a], b, X[b], 0);
      least = std::min(least, meet ? 0 : distanceOf(robot, a, b, X));
    }
  }
  return least;
}

/// The straight path, the box of its ends, and both the other way round.
void expectLeastOfTurn(const RobotCase& robot, double from, double to, double least, double width) {
  const Joints q0 = joints({from}), q1 = joints({to});
  expectLeast(robot, leastClearance(robot.linkage, q0, q1, fine(width)), least, width);
  expectLeast(robot, leastClearance(robot.linkage, q1, q0, fine(width)), least, width);
  expectLeast(robot, leastClearance(robot.linkage, JointBox{{from}, {to}}, fine(width)), least,
              width);
}

// The far edge of a leaf passes the jamb: its corners are nearest where they point at it.
TEST(JointRange, ADoorOnItsHinge) {
  Random random(1);
  for (const double gap : {0.003, 0.05, 0.5}) {
    for (int turned = 0; turned < 3; ++turned) {
      const double width = 0.9, thick = 0.04, length = std::hypot(width, 0.5 * thick);
      const Transform3d X_W = turned > 0 ? randomPose(random, 3) : Transform3d::Identity();
      RobotCase robot;
      Joint hinge = joint(JointType::kRevolute);
      hinge.X_PJ = X_W;
      robot.addLink(-1, hinge);
      robot.addBody(0, modelOf(scenes::subdividedBox({width, thick, 2}, 12)),
                    shifted(0.5 * width, 0, 0));
      robot.addBody(-1, boxOf(0.1, 0.2, 2.1), X_W * shifted(width + gap + 0.05, 0, 0));
      robot.addBody(-1, boxOf(0.1, 0.2, 2.1), X_W * shifted(-0.08, -0.9, 0));  // the other one
      expectLeastOfTurn(robot, -0.1, 1.6, width + gap - length, 0.01 * gap);
    }
  }
}

// A head that turns and slides over a table stays as high, however wide the ranges are. The bracket
// closes at once; with a joint that tilts the head, it holds what samples find.
TEST(JointRange, AGantryOverItsTable) {
  Random random(3);
  for (int turned = 0; turned < 6; ++turned) {
    SCOPED_TRACE(turned);
    const bool tilts = turned >= 3;
    const Transform3d X_W = turned > 0 ? randomPose(random, 3) : Transform3d::Identity();
    RobotCase robot;
    Joint slide = joint(JointType::kPrismatic);
    slide.X_PJ = X_W;
    slide.axis = {1, 0, 0};
    robot.addLink(-1, slide);
    slide.X_PJ = Transform3d::Identity();
    slide.axis = {0, 0.5, 0};
    robot.addLink(0, slide);
    Joint turn = joint(JointType::kRevolute);
    robot.addLink(1, turn);
    turn.X_PJ = shifted(0.3, 0, 0);
    robot.addLink(2, turn);
    turn.X_PJ = shifted(0, 0, 0.2);
    turn.axis = {1, 0, 0};
    if (tilts) robot.addLink(3, turn);
    robot.addBody(-1, boxOf(3, 3, 0.1), X_W * shifted(0, 0, -0.05));
    robot.addBody(tilts ? 4 : 3, boxOf(0.2, 0.1, 0.3), shifted(0, 0, tilts ? 0 : 0.17));
    JointBox box{{-1, -2, -3, -kInf}, {1, 2, 3, kInf}};
    if (!tilts) {
      const RangeResult result = leastClearance(robot.linkage, box, fine(1e-3));
      expectLeast(robot, result, 0.02, 1e-3, 1e-9);
      EXPECT_LE(result.queries, 200);
      continue;
    }
    box.lower.push_back(-0.2);
    box.upper.push_back(0.9);
    RangeRequest request = fine(1e-3);
    request.max_queries = 3000;
    const RangeResult result = leastClearance(robot.linkage, box, request);
    const double least = 0.2 - std::hypot(0.05, 0.15);
    EXPECT_NEAR(result.upper, least, 1e-3);
    EXPECT_LE(result.lower, least + 1e-9);
    EXPECT_GE(result.lower, 0.5 * least) << "few boxes along what tilts are enough";
  }
}

RobotCase randomArm(Random& random, bool shapes) {
  RobotCase robot;
  const auto geometry = [&]() -> BodyGeometry {
    const double size = random.uniform(0.05, 0.2);
    const double kind = random.unit();
    if (shapes && kind < 0.3) return std::make_shared<fcl::Sphered>(size);
    if (shapes && kind < 0.6) return std::make_shared<fcl::Capsuled>(0.4 * size, 2 * size);
    if (kind < 0.5) return modelOf(scenes::subdividedBox({3 * size, 0.05, 0.1}, 2));
    return modelOf(scenes::flangedCylinder(0.5 * size, 2 * size, 8));
  };
  for (int i = 0; i < 3; ++i) {
    robot.addLink(i - 1,
                  randomJoint(random, 0.6, 0.3, i == 2 ? robot.linkage.coordinates() : 0, 0.5));
    robot.addBody(i, geometry(), randomPose(random, 0.2));
  }
  for (int i = 0; i < 4; ++i) robot.addBody(-1, geometry(), randomPose(random, 1.6));
  return robot;
}

// No sample is below `lower`, and what is said to be seen is seen.
TEST(JointRange, NoSampleIsBelow) {
  Random random(5);
  int clear = 0, contacts = 0;
  for (int trial = 0; trial < 60; ++trial) {
    RobotCase robot = randomArm(random, trial % 2 == 0);
    const int n = robot.linkage.coordinates();
    Joints q0(n), q1(n);
    for (int k = 0; k < n; ++k) {
      q0[k] = random.uniform(-0.7, 0.3);
      q1[k] = q0[k] + random.uniform(0, 0.5);
    }
    robot.ignorePair(0, 1);
    robot.ignorePair(1, 2);
    const JointBox box{{q0.data(), q0.data() + n}, {q1.data(), q1.data() + n}};
    RangeRequest request;
    request.rel_err = 0.05;
    for (const bool in_box : {false, true}) {
      const RangeResult result = in_box ? leastClearance(robot.linkage, box, request)
                                        : leastClearance(robot.linkage, q0, q1, request);
      SCOPED_TRACE("trial " + std::to_string(trial) + (in_box ? " box" : " path"));
      EXPECT_LE(result.lower, result.upper);
      EXPECT_TRUE(result.complete);
      if (result.complete) {
        EXPECT_LE(result.upper - result.lower, std::max(1e-4, 0.05 * result.upper) * (1 + 1e-9));
      }
      double least = kInf;
      for (int i = 0; i <= 200; ++i) {
        Joints q = between(q0, q1, 0.005 * i);
        for (int k = 0; in_box && k < n; ++k) q[k] = random.uniform(q0[k], q1[k]);
        least = std::min(least, leastAt(robot, q));
      }
      EXPECT_GE(least, result.lower - 1e-9);
      EXPECT_LE(result.upper, least + std::max(1e-4, 0.06 * least));
      double nearest = kInf;  // of single pairs
      for (const RangeResult& pair : in_box ? std::vector<RangeResult>{result}
                                            : leastClearances(robot.linkage, q0, q1, request)) {
        EXPECT_TRUE(pair.complete);
        nearest = std::min(nearest, pair.upper);
        for (int i = 0; i <= 40; ++i) {
          const auto X = robot.poses(between(q0, q1, 0.025 * i));
          const int a = pair.body_a, b = pair.body_b;
          const bool meet = robot.meet(a, X[a], b, X[b], 0);
          EXPECT_GE(meet ? 0 : distanceOf(robot, a, b, X), pair.lower - 1e-9);
        }
      }
      EXPECT_GE(nearest, result.lower);
      EXPECT_LE(nearest, result.upper + std::max(1e-4, 0.05 * result.upper));
      ASSERT_EQ(static_cast<int>(result.at.size()), n);
      const Joints at = placeOf(result);
      for (int k = 0; k < n; ++k) {
        EXPECT_GE(at[k], q0[k]);
        EXPECT_LE(at[k], q1[k]);
      }
      EXPECT_LE(leastAt(robot, at), result.upper + 1e-7);
      EXPECT_GE(leastAt(robot, at), result.lower - 1e-9);
      const RangeResult again = in_box ? leastClearance(robot.linkage, box, request)
                                       : leastClearance(robot.linkage, q0, q1, request);
      EXPECT_EQ(again.lower, result.lower);
      EXPECT_EQ(again.upper, result.upper);
      EXPECT_EQ(again.at, result.at);
      (result.upper > 0 ? clear : contacts) += 1;
    }
  }
  EXPECT_GT(clear, 30);
  EXPECT_GT(contacts, 2);
}

TEST(JointRange, BudgetsEndWithABracket) {
  Random random(8);
  RobotCase robot;
  for (int i = 0; i < 6; ++i) {
    robot.addLink(i - 1, joint(JointType::kRevolute, {0.2, 0, 0}, inBall(random)));
    robot.addBody(i, boxOf(0.1, 0.03, 0.03), shifted(0.1, 0, 0));
  }
  for (int a = 0; a < 6; ++a) {
    for (int b = a + 1; b < 6; ++b) robot.ignorePair(a, b);
  }
  robot.addBody(-1, boxOf(0.3, 0.3, 0.3), shifted(1.6, 0.3, 0.2));
  const JointBox box{std::vector<double>(6, -0.2), std::vector<double>(6, 0.2)};
  double lower = -kInf, upper = kInf;
  for (const long long most : {0, 30, 1000, 30000}) {
    RangeRequest request = fine(1e-9);
    request.max_queries = most;
    const RangeResult result = leastClearance(robot.linkage, box, request);
    EXPECT_FALSE(result.complete);
    EXPECT_LE(result.queries, most + 20);
    EXPECT_LE(result.lower, result.upper);
    EXPECT_GE(result.lower, lower);
    EXPECT_LE(result.upper, upper);
    lower = result.lower;
    upper = result.upper;
  }
  EXPECT_GT(lower, 0);
  EXPECT_LT(upper, 2);
  for (int i = 0; i < 2000; ++i) {
    Joints q(6);
    for (double& x : q) x = random.uniform(-0.2, 0.2);
    EXPECT_GE(leastAt(robot, q), lower);
  }
  for (const long long most : {0, 5, 20, 100}) {
    RangeRequest request = fine(1e-12);
    request.max_queries = most;
    const RangeResult result =
        leastClearance(robot.linkage, Joints::Constant(6, -1), Joints::Constant(6, 1), request);
    EXPECT_LE(result.lower, result.upper);
    if (most <= 20) {
      EXPECT_FALSE(result.complete);
    }
  }
}

}  // namespace
}  // namespace kios::testing
