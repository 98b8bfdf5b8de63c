// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What moves in each other with little clearance: pegs in holes, shafts in bearings, balls in
// sockets; and the budget of a query.

#include "linkage/tight_fits.h"
#include "fcl/expect_refused.h"

namespace kios::testing {
namespace {

// Without slabs between triangles the queries grow as 1 / clearance, to millions.
TEST(TightFits, ARodSlidesThroughARing) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    SCOPED_TRACE(clearance);
    const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 32));
    const BodyGeometry peg = modelOf(rod(0.01, 2, 32, 0.37));
    for (const bool turned : {false, true}) {
      const RobotCase robot = fitted(peg, hole, JointType::kPrismatic, {{0, 0, 1}}, turned);
      expectClear(robot, Joints::Constant(1, 0.5), 8000);
      if (clearance > 1e-7) expectClear(robot, Joints::Constant(1, 0.5), 8000, 0.5 * clearance);
      // It holds the other way about, too, and for a shape.
      expectClear(fitted(hole, peg, JointType::kPrismatic, {{0, 0, 1}}, turned),
                  Joints::Constant(1, 0.5), 8000);
      expectClear(fitted(std::make_shared<fcl::Cylinderd>(0.01, 2), hole, JointType::kPrismatic,
                         {{0, 0, 1}}, turned),
                  Joints::Constant(1, 0.5), 8000);
    }
  }
}

TEST(TightFits, AShaftTurnsInItsBearing) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-8}) {
    SCOPED_TRACE(clearance);
    const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 32));
    const Joints q1 = Joints::Constant(1, 3);
    for (const BodyGeometry& shaft : {modelOf(rod(0.01, 0.2, 32, 0.37)),
                                      BodyGeometry(std::make_shared<fcl::Cylinderd>(0.01, 0.2))}) {
      const RobotCase robot = fitted(shaft, hole, JointType::kRevolute, {{0, 0, 1}}, true);
      expectClear(robot, q1, 200);
      if (clearance > 1e-7) expectClear(robot, q1, 200, 0.5 * clearance);
      expectClear(fitted(hole, shaft, JointType::kRevolute, {{0, 0, 1}}, true), q1, 200);
    }
  }
}

TEST(TightFits, ABallTurnsInItsSocket) {
  const std::vector<Vector3d> axes = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  for (const double clearance : {1e-3, 1e-4, 1e-5}) {
    SCOPED_TRACE(clearance);
    const BodyGeometry socket = modelOf(bowl((0.02 + clearance) / 0.98, 0.35 * kPi, 24, 9));
    for (const BodyGeometry& ball :
         {modelOf(bowl(0.02, 0, 24, 12)), BodyGeometry(std::make_shared<fcl::Sphered>(0.02))}) {
      expectClear(fitted(ball, socket, JointType::kRevolute, axes, true), Joints::Constant(3, 0.3),
                  120);
    }
  }
}

// A square peg leaves its hole, in which it would stick if it turned.
TEST(TightFits, APegThatSticksIsFound) {
  for (const double clearance : {1e-3, 1e-5}) {
    const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 4));
    const BodyGeometry peg = modelOf(rod(0.01 * std::sqrt(2.0), 0.3, 4, 0));
    RobotCase robot;
    robot.addLink(-1, joint(JointType::kPrismatic));
    robot.addLink(0, joint(JointType::kRevolute));
    robot.addBody(1, peg);
    robot.addBody(-1, hole);
    MotionTally tally;
    const Joints q0 = Joints::Zero(2);
    for (const double out : {0.05, 0.19, 0.21, 0.5}) {
      for (const double turn : {0.0, 0.5 * clearance, 3 * clearance, 200 * clearance}) {
        expectRight(robot, q0, Eigen::Vector2d(out, turn), 200, tally);
      }
    }
    tally.expectBothKinds();
    EXPECT_EQ(tally.unresolved, 0);
  }
}

TEST(Budgets, ASpentBudgetIsSaid) {
  const RobotCase robot = keyInSlot(1e-7);
  MotionRequest request;
  expectRefused(
      [&] {
        request.max_queries = -1;
        checkMotion(robot.linkage, Joints::Zero(1), Joints::Constant(1, 0.5), request);
      },
      "max_queries");
  for (const bool first : {false, true}) {
    request.first_contact = first;
    double last = 0;
    for (const long long most : {0, 1, 10, 100, 1000, 10000}) {
      request.max_queries = most;
      const MotionResult answer =
          checkMotion(robot.linkage, Joints::Zero(1), Joints::Constant(1, 0.5), request);
      EXPECT_EQ(answer.verdict, MotionVerdict::kBudgetSpent) << most;
      EXPECT_EQ(answer.body_a, 0);
      EXPECT_EQ(answer.body_b, 1);
      EXPECT_LT(answer.from, answer.to);
      EXPECT_LE(answer.counts.queries, most + most / 4 + 60) << most;
      if (!first) continue;
      EXPECT_GE(answer.from, last) << "a larger budget proves more";
      last = answer.from;
    }
    EXPECT_TRUE(!first || last > 0.01);
    request.max_queries = 1000000;
    EXPECT_EQ(
        checkMotion(robot.linkage, Joints::Zero(1), Joints::Constant(1, 0.5), request).verdict,
        MotionVerdict::kClear);
  }
}

// Paths of thousands of radians end, by a proof, a contact or the budget.
TEST(Budgets, LongPathsEnd) {
  Random random(9);
  for (const double far : {1e3, 1e5, 1e8}) {
    RobotCase robot;
    for (int link = 0; link < 4; ++link) {
      Joint turn = joint(JointType::kRevolute);
      turn.X_PJ = randomPose(random, 0.3);
      turn.axis = inBall(random).normalized();
      robot.addLink(link - 1, turn);
      robot.addBody(link, modelOf(rod(0.02, 0.3, 6, 0)));
      if (link > 0) robot.ignorePair(link - 1, link);
    }
    robot.addBody(-1, modelOf(ring(2, 2.2, 3, 12)));
    const Joints q1 = randomJoints(4, far, random);
    for (const bool first : {false, true}) {
      MotionRequest request;
      request.max_queries = 20000;
      request.first_contact = first;
      const MotionResult answer = checkMotion(robot.linkage, Joints::Zero(4), q1, request);
      EXPECT_LE(answer.counts.queries, 21000);
      if (answer.verdict == MotionVerdict::kClear) {
        EXPECT_EQ(robot.firstSample(Joints::Zero(4), q1, 500), 2);
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
