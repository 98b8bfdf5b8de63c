// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Proofs by what turns leave as it is: where axes nearly meet, where bodies aren't round, and where
// they slide along the axis as well.

#include "linkage/tight_fits.h"

namespace kios::testing {
namespace {

// The key passes over no wall within the slot, and meets its end beyond.
TEST(Orbits, AKeyTurnsInItsSlotAndMeetsItsEnds) {
  MotionTally tally;
  for (const double clearance : {1e-3, 1e-4}) {
    const RobotCase robot = keyInSlot(clearance);
    for (const double turn : {0.3, -0.6, 0.85, -0.95, 1.5}) {
      SCOPED_TRACE(turn);
      expectRight(robot, Joints::Zero(1), Joints::Constant(1, turn), 400, tally);
    }
  }
  tally.expectBothKinds();
}

// A screw slides along the axis that it turns about, out of its hole or until its head stops it.
TEST(Orbits, AScrewTurnsAndSlides) {
  for (const double clearance : {1e-3, 1e-5, 1e-7}) {
    SCOPED_TRACE(clearance);
    const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 32));
    RobotCase robot;
    robot.addLink(-1, joint(JointType::kPrismatic));
    robot.addLink(0, joint(JointType::kRevolute));
    robot.addBody(1, modelOf(rod(0.01, 0.4, 32, 0.37)));
    robot.addBody(-1, hole);
    expectClear(robot, Eigen::Vector2d(0.5, 7), 60);
    RobotCase headed;
    headed.addLink(-1, joint(JointType::kPrismatic));
    headed.addLink(0, joint(JointType::kRevolute));
    headed.addBody(1, modelOf(rod(0.01, 0.4, 32, 0.37)));
    headed.addBody(1, modelOf(rod(0.015, 0.02, 32, 0.37)), shifted(0, 0, 0.19));
    headed.addBody(-1, hole);
    MotionTally tally;
    expectRight(headed, Joints::Zero(2), Eigen::Vector2d(-0.1299, 7), 200, tally);
    EXPECT_EQ(tally.clear, 1);
    expectRight(headed, Joints::Zero(2), Eigen::Vector2d(-0.1301, 7), 2000, tally);
    EXPECT_EQ(tally.contact, 1);
  }
}

// Axes miss each other by a part or a multiple of the clearance, or the bodies' axis, or the ball
// has a bump.
TEST(Orbits, WhatIsOffItsAxisIsFound) {
  MotionTally tally;
  const double clearance = 1e-4;
  const BodyGeometry hole = modelOf(ring(0.01 + clearance, 0.03, 0.1, 32));
  const BodyGeometry shaft = modelOf(rod(0.01, 0.2, 32, 0.37));
  const BodyGeometry socket = modelOf(bowl((0.02 + clearance) / 0.98, 0.35 * kPi, 24, 9));
  const BodyGeometry ball = modelOf(bowl(0.02, 0, 24, 12));
  Mesh bump = bowl(0.02, 0, 24, 12);
  bump.vertices[200] *= 1.06;
  for (const double off : {0.0, 0.1, 0.4, 0.9, 1.1, 3.0}) {
    SCOPED_TRACE(off);
    const double way = off * clearance;
    for (const double turn : {0.2, 1.5, 6.0}) {
      // The second axis beside the first, then tilted against it.
      for (const bool tilts : {false, true}) {
        RobotCase robot;
        robot.addLink(-1, joint(JointType::kRevolute));
        robot.addLink(0, joint(JointType::kRevolute, {tilts ? 0 : way, 0, 0},
                               Vector3d(tilts ? 10 * way : 0, 0, 1).normalized()));
        robot.addBody(1, shaft);
        robot.addBody(-1, hole);
        expectRight(robot, Joints::Zero(2), Eigen::Vector2d(0.5 * turn, -turn), 300, tally);
      }
      RobotCase beside;
      beside.addLink(-1, joint(JointType::kRevolute));
      beside.addBody(0, shaft, shifted(way, 0, 0));
      beside.addBody(-1, hole, shifted(0.3 * way, 0, 0));
      expectRight(beside, Joints::Zero(1), Joints::Constant(1, turn), 300, tally);

      for (const BodyGeometry& body : {ball, modelOf(bump)}) {
        RobotCase robot;
        robot.addLink(-1, joint(JointType::kRevolute));
        robot.addLink(0, joint(JointType::kRevolute, {0, way, 0}, {1, 0, 0}));
        robot.addLink(1, joint(JointType::kRevolute, {0, 0, 0}, {0, 1, 0}));
        robot.addBody(2, body);
        robot.addBody(-1, socket);
        expectRight(robot, Joints::Zero(3), Eigen::Vector3d(turn, -0.7 * turn, 0.3), 300, tally);
      }
    }
  }
  tally.expectBothKinds();
}

}  // namespace
}  // namespace kios::testing
