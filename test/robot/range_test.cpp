// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The least clearance of robots over paths and boxes: paddings, limits, mimics and continuous
// joints, against samples of clearance().

#include <algorithm>
#include <limits>

#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// A turntable with a finger, and another one that turns half as far the other way.
constexpr char kFingers[] = R"(<robot name="fingers">
  <link name="base"/>
  <link name="first"><collision><origin xyz="0.4 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="second"><collision><origin xyz="0.4 0 0"/><geometry><box size="0.2 0.1 0.1"/></geometry></collision></link>
  <link name="slide"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="first"/><axis xyz="0 0 1"/></joint>
  <joint name="half" type="revolute"><parent link="base"/><child link="second"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/><mimic joint="turn" multiplier="-0.5" offset="0.2"/></joint>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="slide"/><origin xyz="0 0 -1"/><axis xyz="1 0 0"/><limit lower="-0.3" upper="0.5"/></joint>
</robot>)";

Robot fingers() {
  const Folder folder;
  Robot robot = loadRobot(folder.write("fingers.urdf", kFingers));
  robot.addObstacle("post", std::make_shared<fcl::Sphered>(0.1), shifted(0, 0.9, 0));
  robot.addObstacle("wall", std::make_shared<fcl::Boxd>(0.1, 4, 4), shifted(-1.2, 0, 1));
  return robot;
}

TEST(RobotRange, KnownMinima) {
  Robot robot = fingers();
  RangeRequest request;
  request.abs_err = 1e-4;
  request.rel_err = 0;
  const JointBox box{{-kInf, -0.3}, {kInf, 0.5}};
  const auto expect = [&](const RobotRange& range, double least, const char* a, const char* b) {
    EXPECT_TRUE(range.complete);
    EXPECT_LE(range.lower, least + 1e-9);
    EXPECT_GE(range.upper, least - 1e-9);
    EXPECT_LE(range.upper - range.lower, 1.0001e-4);
    EXPECT_EQ(range.a, a);
    EXPECT_EQ(range.b, b);
    const VectorXd q = Eigen::Map<const VectorXd>(range.at.data(), 2);
    EXPECT_NEAR(robot.clearance(q).clearance, range.upper, 1.0001e-4);
  };
  expect(robot.leastClearance(box, request), 0.3, "first", "post");
  const VectorXd q0 = VectorXd::Zero(2), q1 = (VectorXd(2) << 3, 0.5).finished();
  expect(robot.leastClearance(q0, q1, request), 0.3, "first", "post");
  // Skins of 0.2 between wall and finger leave less there: each sum of paddings is a proof.
  robot.setPadding("wall", 0.25);
  robot.setPadding("first", 0.25);
  robot.setPadding("second", 0.05);
  expect(robot.leastClearance(box, request), 0.05, "first", "post");
  robot.setPadding("post", 0.0);
  robot.ignorePair("first", "post");
  expect(robot.leastClearance(box, request), 0.65 - 0.5, "first", "wall");
  const auto each = robot.leastClearances(box, request);
  ASSERT_EQ(each.size(), 8U);
  EXPECT_EQ(each[0].a, "first");
  EXPECT_EQ(each[0].b, "wall");
  for (std::size_t i = 1; i < each.size(); ++i) EXPECT_LE(each[i - 1].lower, each[i].lower);
  robot.setPadding("wall", 3);
  const RobotRange in = robot.leastClearance(box, request);
  EXPECT_TRUE(in.complete);
  EXPECT_NEAR(in.upper, 0.65 - 3.25, 1e-4);
}

/// A rail with two balls that pass posts; skins are `padding` of the first, and none of the second.
Robot railOfTwo(double padding, double gap_of_first, double gap_of_second) {
  const Folder folder;
  Robot robot = loadRobot(folder.write("rail.urdf", R"(<robot name="rail">
  <link name="base"/>
  <link name="first"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="second"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="first"/><axis xyz="1 0 0"/><limit lower="-5" upper="5"/></joint>
  <joint name="hold" type="fixed"><parent link="first"/><child link="second"/><origin xyz="0 0 5"/></joint>
</robot>)"));
  robot.addObstacle("low", std::make_shared<fcl::Sphered>(0.1), shifted(1, 0.2 + gap_of_first, 0));
  robot.addObstacle("high", std::make_shared<fcl::Sphered>(0.1),
                    shifted(2, 0.2 + gap_of_second, 5));
  robot.setPadding("first", padding);
  return robot;
}

// Skins of several widths: the least of both, whichever is wider, nearer or in contact, with any
// ceiling. Gaps of 0.3, a contact, skins that just overlap.
TEST(RobotRange, TheLeastOfAllPaddings) {
  const VectorXd q0 = VectorXd::Constant(1, -1), q1 = VectorXd::Constant(1, 4);
  for (const double padding : {0.0, 0.1, 0.4}) {
    for (const double first : {-0.1, 0.099, 0.3}) {
      for (const double second : {-0.1, 0.05, 0.3}) {
        const Robot robot = railOfTwo(padding, first, second);
        const double least = std::min(std::max(first, 0.0) - padding, std::max(second, 0.0));
        for (const double ceiling : {-1.0, 0.0, 0.07, kInf}) {
          SCOPED_TRACE(std::to_string(padding) + ", " + std::to_string(first) + ", " +
                       std::to_string(second) + ", " + std::to_string(ceiling));
          RangeRequest request;
          request.ceiling = ceiling;
          for (const RobotRange& range : {robot.leastClearance(q0, q1, request),
                                          robot.leastClearance(JointBox{{-1}, {4}}, request)}) {
            EXPECT_TRUE(range.complete);
            EXPECT_LE(range.lower, std::max(least, -padding) + 1e-9);
            EXPECT_GE(range.upper, least - 1e-9);
            const double width = std::max(1e-4, 0.01 * range.upper) + 1e-9;
            EXPECT_GE(range.lower, std::min(ceiling, range.upper - width));
            if (least < ceiling - 0.01) {
              EXPECT_LE(range.upper, least + 0.01);
            }
          }
        }
      }
    }
  }
}

TEST(RobotRange, RefusesWhatIsOutside) {
  const Robot robot = fingers();
  const auto ask = [&](const JointBox& box) {
    return [&robot, box] { robot.leastClearance(box); };
  };
  expectRefused(ask({{0}, {1}}), "1 lower and 1 upper ends, but fingers has 2");
  expectRefused(ask({{0, 0}, {1, 0.6}}), "of the joint 'rail' is outside of the joint's limits");
  expectRefused(ask({{0, 0.2}, {1, 0.1}}), "of the joint 'rail' is NaN or empty");
  expectRefused(ask({{std::nan(""), 0}, {1, 0.1}}), "of the joint 'turn' is NaN");
  EXPECT_NO_THROW(robot.leastClearance(JointBox{{0, 0}, {1, 0.6}}, {}, false));
  RangeRequest wrong;
  wrong.ceiling = std::nan("");
  expectRefused([&] { robot.leastClearance(VectorXd::Zero(2), VectorXd::Zero(2), wrong); },
                "ceiling");
  expectRefused([&] { robot.leastClearance(VectorXd::Zero(3), VectorXd::Zero(2)); }, "q0 has 3");
}

}  // namespace
}  // namespace kios::testing
