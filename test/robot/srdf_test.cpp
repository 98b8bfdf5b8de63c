// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What an SRDF says of a robot: pairs that may touch, states, groups.
#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

TEST(RobotSrdf, AnSrdfAllowsPairsAndNamesStates) {
  const Folder folder;
  const std::string urdf = manyJoints(folder);
  const Robot robot = loadRobot(
      urdf, folder.write("arm.srdf",
                         "<robot name='arm'><virtual_joint name='v' type='fixed'/>"
                         "<disable_collisions link1='cart' link2='upper' reason='Never'/>"
                         "<disable_default_collisions link='left'/>"
                         "<enable_collisions link1='base' link2='left'/>"
                         "<disable_collisions link1='gone' link2='upper'/>"
                         "<group_state name='home' group='g'><joint name='elbow' value='1.5'/>"
                         "<joint name='drive' value='1 2 3'/><joint name='wrist' value='9'/>"
                         "<joint name='v' value='9'/></group_state>"
                         "<group_state name='odd' group='g'><joint name='none' value='1'/>"
                         "</group_state></robot>"));
  EXPECT_TRUE(robot.allowed("upper", "cart"));
  EXPECT_FALSE(robot.allowed("cart", "turret"));
  EXPECT_TRUE(robot.allowed("left", "right"));
  EXPECT_FALSE(robot.allowed("left", "base"));
  VectorXd home(8);
  home << 1, 2, 3, 0, 0, 1.5, 0, 0;
  EXPECT_EQ(robot.state("home"), home);
  expectRefused([&] { robot.state("odd"); }, "none");
  expectRefused([&] { robot.state("hom"); }, "home");
}

// The limit next to 0 where 0 is beyond.
TEST(RobotSrdf, StatesBeginWithinTheLimits) {
  const Folder folder;
  const Robot robot = loadRobot(
      folder.write("r.urdf",
                   "<robot name='r'>" + link("a") + link("b") + link("c") +
                       joint("j", "revolute", "a", "b", "<limit lower='1' upper='2'/>") +
                       joint("k", "revolute", "b", "c", "<limit lower='-2' upper='-1'/>") +
                       "</robot>"),
      folder.write("r.srdf", "<robot name='r'><group_state name='s' group='g'/></robot>"));
  EXPECT_EQ(robot.state("s"), Eigen::Vector2d(1, -1));
}

TEST(RobotSrdf, GroupsAreJointsLinksChainsAndGroups) {
  const Folder folder;
  const std::string urdf = manyJoints(folder);
  const auto load = [&](const std::string& inside) {
    return loadRobot(urdf, folder.write("arm.srdf", "<robot name='arm'>" + inside + "</robot>"));
  };
  const std::string groups =
      "<virtual_joint name='world' type='fixed' parent_frame='w' child_link='base'/>"
      "<group name='all'><group name='reach'/><group name='hand'/><joint name='drive'/></group>"
      "<group name='reach'><chain base_link='turret' tip_link='tool'/><joint name='world'/></group>"
      "<group name='hand'><link name='left'/><joint name='right_finger'/><link "
      "name='gone'/></group>"
      "<end_effector name='gripper' parent_link='tool' group='hand' parent_group='reach'/>";
  const Robot robot = load(groups);
  EXPECT_EQ(robot.groups(), (std::vector<std::string>{"all", "hand", "reach"}));
  const RobotGroup reach = robot.group("reach");
  EXPECT_EQ(reach.joints, (std::vector<std::string>{"shoulder", "elbow", "extend"}));
  EXPECT_EQ(reach.links, (std::vector<std::string>{"upper", "lower", "slide", "tool"}));
  EXPECT_EQ(reach.end_effectors, (std::vector<std::string>{"hand"}));
  ASSERT_EQ(reach.coordinates.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(robot.joints()[static_cast<std::size_t>(reach.coordinates[i])], reach.joints[i]);
  }
  EXPECT_EQ(robot.group("hand").joints, (std::vector<std::string>{"left_finger"}));
  EXPECT_EQ(robot.group("all").coordinates.size(), 7U);
  ASSERT_EQ(robot.warnings().size(), 1U);
  EXPECT_NE(robot.warnings()[0].find("'gone'"), std::string::npos);
  expectRefused([&] { robot.group("arm"); }, "it has all, hand, reach");
  // What MoveIt leaves out, and reads all the same.
  const auto warns = [&](const std::string& inside, const std::string& part) {
    const Robot loaded = load(inside);
    ASSERT_EQ(loaded.warnings().size(), 1U) << inside;
    EXPECT_NE(loaded.warnings()[0].find(part), std::string::npos) << loaded.warnings()[0];
  };
  warns("<group name='a'><group name='b'/></group>", "no group 'b'");
  warns("<group name='a'><group name='a'/><joint name='elbow'/></group>", "contain themselves");
  warns("<group name='a'><chain base_link='no' tip_link='base'/></group>", "'no'");
  warns("<group name='a'><chain tip_link='base'/></group>", "base_link");
  warns("<group name='a'><joint/></group>", "no name");
  warns("<group><joint name='elbow'/></group>", "no name");
  warns("<group name='a'/><end_effector name='e' parent_link='tool' parent_group='a'/>",
        "no group");
}

// A chain may go up and down again: MoveIt takes the joints of both ways.
TEST(RobotSrdf, ChainsOfAnyTwoLinks) {
  const Folder folder;
  const std::string urdf = manyJoints(folder);
  const auto chain = [&](const std::string& base, const std::string& tip) {
    return loadRobot(urdf, folder.write("arm.srdf",
                                        "<robot name='arm'><group name='a'><chain base_link='" +
                                            base + "' tip_link='" + tip + "'/></group></robot>"))
        .group("a");
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(chain("left", "tool").links, (Names{"left", "tool"}));
  EXPECT_EQ(chain("left", "tool").joints, Names{"left_finger"});
  EXPECT_EQ(chain("tool", "turret").joints, (Names{"shoulder", "elbow", "extend"}));
  EXPECT_EQ(chain("tool", "turret").links, chain("turret", "tool").links);
  EXPECT_TRUE(chain("upper", "upper").links.empty());
}

// Each of many groups holds the next one twice, the last one a joint; some are a ring.
TEST(RobotSrdf, GroupsInManyGroups) {
  const Folder folder;
  const int count = 20000;
  std::string text = "<robot name='arm'>";
  for (int i = 0; i < count; ++i) {
    const std::string next = "<group name='g" + std::to_string(i + 1) + "'/>";
    text += "<group name='g" + std::to_string(i) + "'>" + next + next + "</group>";
  }
  text += "<group name='g" + std::to_string(count) + "'><joint name='elbow'/></group>";
  text += "<group name='r'><group name='s'/><joint name='elbow'/></group>";
  text += "<group name='s'><group name='r'/><group name='g0'/></group>";
  text += "<group name='t'><group name='s'/><joint name='turn'/></group></robot>";
  const Robot robot = loadRobot(manyJoints(folder), folder.write("many.srdf", text));
  const std::vector<std::string> elbow = {"elbow"};
  EXPECT_EQ(robot.group("g0").joints, elbow);
  EXPECT_EQ(robot.group("r").joints, elbow);
  EXPECT_EQ(robot.group("s").joints, elbow);
  EXPECT_EQ(robot.group("t").joints, std::vector<std::string>{"turn"});
  EXPECT_EQ(robot.warnings().size(), 3U);
}

}  // namespace
}  // namespace kios::testing
