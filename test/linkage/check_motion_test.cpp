// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Paths whose answers are known: what is thin, what touches, what slides by; and of shapes.

#include <fcl/config.h>

#include "fcl/expect_refused.h"
#include "linkage/robot_cases.h"

namespace kios::testing {
namespace {

MotionResult ask(const RobotCase& robot, const Joints& q0, const Joints& q1, bool first = false,
                 double separation = 0) {
  MotionRequest request;
  request.first_contact = first;
  request.min_separation = separation;
  return checkMotion(robot.linkage, q0, q1, request);
}

Joints one(double x) { return Joints::Constant(1, x); }

TEST(CheckMotion, FirstContactsOfASliderAreAtTheirTimes) {
  RobotCase robot = slider(boxOf(1, 1, 1));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(5, 0.3, 0.2));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(8, 0.3, 0.2));
  for (const double separation : {0.0, 0.25}) {
    const MotionResult first = ask(robot, one(0), one(10), true, separation);
    ASSERT_EQ(first.verdict, MotionVerdict::kContact);
    EXPECT_EQ(first.body_a, 0);
    EXPECT_EQ(first.body_b, 1);
    const double time = (4 - separation) / 10;
    EXPECT_LE(first.from, time + 1e-12);
    EXPECT_GE(first.to, time - 1e-12);
    EXPECT_LE(first.to - first.from, 0x1p-20);
    EXPECT_EQ(ask(robot, one(0), one(3.9), true, separation).verdict,
              separation > 0 ? MotionVerdict::kContact : MotionVerdict::kClear);
    // From the start in contact; backwards; away from it.
    const MotionResult started = ask(robot, one(5), one(20), true, separation);
    EXPECT_EQ(started.verdict, MotionVerdict::kContact);
    EXPECT_EQ(started.from, 0);
    EXPECT_EQ(started.to, 0);
    const MotionResult back = ask(robot, one(12), one(2), true, separation);
    EXPECT_EQ(back.body_b, 2);
    EXPECT_NEAR(back.to, (3 - separation) / 10, 2e-6);
  }
  EXPECT_EQ(ask(robot, one(6.25), one(6.75)).verdict, MotionVerdict::kClear);
}

// Plates of a millionth, and triangles of no thickness at all, which a path crosses in an instant.
TEST(CheckMotion, NothingIsTooThin) {
  for (const double thick : {1e-2, 1e-4, 1e-5}) {
    RobotCase robot = slider(boxOf(thick, 1, 1));
    robot.addBody(-1, boxOf(thick, 0.9, 0.9), shifted(0.71828182845, 0.01, 0.02));
    for (const bool first : {false, true}) {
      const MotionResult answer = ask(robot, one(0), one(1), first);
      ASSERT_EQ(answer.verdict, MotionVerdict::kContact) << thick;
      EXPECT_NEAR(answer.to, 0.71828182845, 2 * thick);
    }
    EXPECT_EQ(ask(robot, one(0), one(0.7)).verdict, MotionVerdict::kClear);
  }
  for (const double turn : {0.0, 1e-3}) {
    const Mesh triangle = scenes::singleTriangle({0, -1, -1}, {0, 1, -1}, {0, 0, 1});
    RobotCase robot = slider(modelOf(triangle));
    Transform3d X = shifted(0.71828182845, 0.01, 0.02);
    X.linear() = Eigen::AngleAxisd(turn, Vector3d(0, 1, 1).normalized()).matrix();
    robot.addBody(-1, modelOf(triangle), X);
    const MotionResult answer = ask(robot, one(0), one(1), true);
    EXPECT_NE(answer.verdict, MotionVerdict::kClear);
    EXPECT_NEAR(answer.from, 0.71828182845, 1e-5 + 2 * turn);
  }
  // A rod's tip passes a needle at 1/300 of the turn.
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kRevolute, {0, 0, 0}, {0, 0, 1}));
  robot.addBody(0, boxOf(2, 1e-3, 1e-3), shifted(1, 0, 0));
  robot.addBody(-1, boxOf(1e-3, 1e-3, 1), shifted(1.9 * std::cos(1.234), 1.9 * std::sin(1.234), 0));
  EXPECT_EQ(robot.firstSample(one(0), one(3), 400), 2) << "samples find it, so this shows nothing";
  const MotionResult answer = ask(robot, one(0), one(3));
  ASSERT_EQ(answer.verdict, MotionVerdict::kContact);
  EXPECT_NEAR(3 * answer.to, 1.234, 2e-3);
  EXPECT_TRUE(robot.meetAt(one(3 * answer.to)));
}

// A box that slides along a face needs few queries however near it is, as its slab doesn't shrink.
TEST(CheckMotion, SlidingAlongAFace) {
  for (const double gap : {1e-1, 1e-3, 1e-6, 1e-9}) {
    RobotCase robot = slider(boxOf(0.1, 0.1, 0.1));
    robot.addBody(-1, boxOf(4, 1, 0.1), shifted(0, 0, -0.1 - gap));
    const MotionResult answer = ask(robot, one(-1.5), one(1.5));
    EXPECT_EQ(answer.verdict, MotionVerdict::kClear) << gap;
    EXPECT_LE(answer.counts.narrow_queries, 10) << gap;
    EXPECT_EQ(ask(robot, one(-1.5), one(1.5), false, 1.01 * gap).verdict, MotionVerdict::kContact);
    EXPECT_EQ(ask(robot, one(-1.5), one(1.5), true, 1.01 * gap).verdict, MotionVerdict::kContact);
  }
  RobotCase robot = slider(boxOf(0.125, 0.125, 0.125));
  robot.addBody(-1, boxOf(4, 1, 0.125), shifted(0, 0, -0.125));  // touching all along
  EXPECT_EQ(ask(robot, one(-1.5), one(1.5)).verdict, MotionVerdict::kContact);
  EXPECT_EQ(ask(robot, one(-1.5), one(1.5), true).from, 0);
}

// The end touches in a face, exactly; and an ulp before it.
TEST(CheckMotion, PosesThatTouch) {
  RobotCase robot = slider(boxOf(1, 1, 1));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(5, 0, 0));
  EXPECT_EQ(ask(robot, one(0), one(4)).verdict, MotionVerdict::kContact);
  EXPECT_EQ(ask(robot, one(4), one(0)).verdict, MotionVerdict::kContact);
  const MotionResult first = ask(robot, one(0), one(4), true);
  EXPECT_NE(first.verdict, MotionVerdict::kClear);
  EXPECT_GE(first.from, 1 - 0x1p-19);
  EXPECT_EQ(ask(robot, one(0), one(4 - 1e-9)).verdict, MotionVerdict::kClear);
  // Nearer than rounding, but apart: nothing may be called clear that isn't proven.
  EXPECT_NE(ask(robot, one(0), one(4 - 1e-15)).verdict, MotionVerdict::kClear);
  // Paths of no length.
  EXPECT_EQ(ask(robot, one(4), one(4)).verdict, MotionVerdict::kContact);
  EXPECT_EQ(ask(robot, one(4 - 1e-9), one(4 - 1e-9)).verdict, MotionVerdict::kClear);
}

// Two arms on one turntable: what carries both moves neither towards the other.
TEST(CheckMotion, SharedJointsCancel) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kRevolute, {0, 0, 0}, {0, 0, 1}));
  robot.addLink(0, joint(JointType::kPrismatic, {10, 0, 0}, {0, 1, 0}));
  robot.addLink(0, joint(JointType::kPrismatic, {10, 0, 0}, {0, 1, 0}));
  robot.addBody(1, boxOf(1, 1, 1));
  robot.addBody(2, boxOf(1, 1, 1), shifted(0, 1.01, 0));
  Joints q0 = Joints::Zero(3), q1 = Joints::Zero(3);
  q1[0] = 100;  // sixteen turns
  const MotionResult turned = ask(robot, q0, q1);
  EXPECT_EQ(turned.verdict, MotionVerdict::kClear);
  EXPECT_LE(turned.counts.narrow_queries, 2);
  q1[1] = 0.02;
  EXPECT_EQ(ask(robot, q0, q1).verdict, MotionVerdict::kContact);
  EXPECT_NEAR(ask(robot, q0, q1, true).to, 0.5, 1e-4);
}

// A hand of twenty fingers in a rack, on a slide of its own; none is far from the next one.
TEST(CheckMotion, PairsThatNothingMovesAreAskedOnce) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {0, 0, 1}));
  robot.addLink(-1, joint(JointType::kRevolute, {0, 5, 0}, {0, 0, 1}));
  robot.addBody(1, boxOf(0.5, 0.1, 0.1));
  for (int i = 0; i < 20; ++i) {
    const int finger = robot.addLink(0, joint(JointType::kRevolute, {0.145 * i, 0, 0}, {0, 1, 0}));
    robot.addBody(finger, modelOf(scenes::flangedCylinder(0.05, 0.5, 12)));
  }
  Joints q0 = Joints::Zero(22), q1 = q0;
  long long still = 0;
  for (int i = 0; i < 3; ++i) {
    q1[0] = 0.1 * i;
    q1[1] = i == 2 ? 0.3 : 0;
    for (const double separation : {0.0, 0.005, 0.02}) {
      for (const bool first : {false, true}) {
        const MotionResult answer = ask(robot, q0, q1, first, separation);
        const bool clear = separation < 0.01;
        EXPECT_EQ(answer.verdict, clear ? MotionVerdict::kClear : MotionVerdict::kContact);
        if (first && !clear) {
          EXPECT_EQ(answer.from, 0);
          EXPECT_EQ(answer.to, 0);
        }
        if (!clear) continue;
        EXPECT_LE(answer.counts.queries, 37 + 2 * i);  // one for each pair near by
        EXPECT_LE(answer.counts.narrow_queries, 19);
        still = std::max(still, answer.counts.queries);
      }
    }
  }
  EXPECT_GT(still, 30) << "hulls part all of them, so this shows nothing";
  // What moves is found beside what doesn't, which is in contact: at the start, if that is asked.
  q1 = q0;
  q1[2] = 1.2;
  EXPECT_EQ(ask(robot, q0, q1).verdict, MotionVerdict::kContact);
  EXPECT_GT(ask(robot, q0, q1, true).from, 0);
  q0[12] = q1[12] = 0.5;
  EXPECT_EQ(ask(robot, q0, q1).verdict, MotionVerdict::kContact);
  EXPECT_EQ(ask(robot, q0, q1, true).to, 0);
}

TEST(CheckMotion, PlanesThatAreCarriedMustNotTurn) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {0, 0, 1}));
  robot.addBody(0, std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), 0));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(0, 0, 1));
  EXPECT_EQ(ask(robot, one(-1), one(0.4)).verdict, MotionVerdict::kClear);
  const MotionResult first = ask(robot, one(-1), one(1), true);
  EXPECT_EQ(first.verdict, MotionVerdict::kContact);
  EXPECT_NEAR(first.to, 0.75, 1e-6);
  // FCL takes a cylinder whose axis is askew to the plane for one in contact; it is 0.005 apart.
  Transform3d X = Transform3d::Identity();
  X.linear() = Eigen::AngleAxisd(0.7, Vector3d::UnitY()).matrix();
  const double reach = 0.1 * std::abs(std::sin(0.7)) + 0.15 * std::cos(0.7);
  RobotCase askew;
  askew.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
  askew.addBody(0, std::make_shared<fcl::Cylinderd>(0.1, 0.3), X);
  askew.addBody(-1, std::make_shared<fcl::Planed>(Vector3d::UnitZ(), reach + 0.005));
  EXPECT_EQ(ask(askew, one(-1), one(1)).verdict, MotionVerdict::kClear);
  EXPECT_EQ(ask(askew, one(-1), one(1), false, 0.006).verdict, MotionVerdict::kContact);
  robot.addBody(-1, std::make_shared<fcl::Planed>(Vector3d::UnitZ(), 5));
  expectRefused([&] { ask(robot, one(-1), one(0)); }, "half-spaces and planes");
}

#if FCL_HAVE_OCTOMAP
TEST(CheckMotion, OctreesAgainstShapesAreRefused) {
  RobotCase robot = slider(std::make_shared<fcl::Sphered>(2));
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(octomap::point3d(0, 0, 0), true);
  robot.addBody(-1, std::make_shared<fcl::OcTreed>(cells));
  expectRefused([&] { ask(robot, one(0), one(1)); }, "OcTree");
}
#endif

// Where nothing can be proven at the resolution asked for, that is said, with the interval.
TEST(CheckMotion, UnresolvedNamesTheInterval) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kRevolute, {0, 0, 0}, {0, 0, 1}));
  robot.addBody(0, boxOf(5, 0.1, 0.1), shifted(-0.5, 0, 0));
  // The tip's corner passes the plate a ten-millionth away, as it points along x; the other end
  // would meet it.
  const double reach = std::hypot(2, 0.05);
  robot.addBody(-1, boxOf(0.1, 2, 0.1), shifted(reach + 0.05 + 1e-7, 0, 0));
  MotionRequest request;
  request.resolution = 1.0 / 16;
  const MotionResult answer = checkMotion(robot.linkage, one(-0.5), one(0.5), request);
  EXPECT_EQ(answer.verdict, MotionVerdict::kUnresolved);
  EXPECT_EQ(answer.body_a, 0);
  EXPECT_EQ(answer.body_b, 1);
  EXPECT_LE(answer.to - answer.from, request.resolution);
  EXPECT_NEAR(answer.from, 0.5, 0.2);
  EXPECT_EQ(ask(robot, one(-0.5), one(0.5)).verdict, MotionVerdict::kClear);
}

}  // namespace
}  // namespace kios::testing
