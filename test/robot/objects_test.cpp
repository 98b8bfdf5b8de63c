// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a robot is told of obstacles and of what it carries, in any order, and what it refuses.
#include <fcl/config.h>
#include <fcl/geometry/shape/triangle_p.h>

#include "fcl/expect_refused.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

TEST(RobotObjects, AttachesObstaclesWhereTheyAre) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  VectorXd q = VectorXd::Zero(8), other = q;
  q[3] = 0.4;
  other[2] = 0.7;
  const auto ball = std::make_shared<fcl::Sphered>(0.03);
  const Transform3d X_WB = robot.pose("tool", q) * shifted(0, 0, 0.02);
  robot.addObstacle("ball", ball, X_WB);
  robot.addObstacle("floor", std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -1));
  robot.setPadding("ball", 0.001);
  for (const bool asked : {false, true}) {
    if (asked) {
      EXPECT_FALSE(robot.contact(q).has_value());
    }
    robot.attachObstacle("ball", "tool", q, {"slide"});
    EXPECT_TRUE(robot.pose("ball", q).isApprox(X_WB, 1e-12));
    EXPECT_FALSE(robot.pose("ball", other).isApprox(X_WB, 1e-2));
    EXPECT_TRUE(robot.allowed("ball", "slide"));
    expectRefused([&] { robot.attachObstacle("ball", "tool", q); }, "no obstacle");
    expectRefused([&] { robot.moveObstacle("ball", X_WB); }, "no obstacle");
    robot.detach("ball", other);
    EXPECT_FALSE(robot.allowed("ball", "slide"));
    EXPECT_FALSE(robot.pose("ball", q).isApprox(X_WB, 1e-2));
    robot.moveObstacle("ball", X_WB);
  }
  expectRefused([&] { robot.detach("ball", q); }, "not attached");
  expectRefused([&] { robot.detach("upper", q); }, "not attached");
  expectRefused([&] { robot.detach("nobody", q); }, "nobody");
  expectRefused([&] { robot.attachObstacle("upper", "tool", q); }, "no obstacle");
  expectRefused([&] { robot.attachObstacle("ball", "ball", q); }, "no link");
  expectRefused([&] { robot.attachObstacle("ball", "tool", VectorXd::Zero(2)); }, "2 coordinates");
  expectRefused([&] { robot.attachObstacle("floor", "tool", q); }, "half-space");
  robot.attachObstacle("ball", "tool", shifted(0, 0, 0.02));
  EXPECT_TRUE(robot.pose("ball", other).isApprox(robot.pose("tool", other) * shifted(0, 0, 0.02)));
  robot.detach("ball", q);
  EXPECT_TRUE(robot.pose("ball", q).isApprox(X_WB, 1e-12));
  expectRefused([&] { robot.attachObstacle("ball", "none", X_WB); }, "no link");
  expectRefused([&] { robot.attach("ball", "tool", ball, X_WB); },
                "attach the obstacle that has it");
  expectRefused([&] { robot.attach("upper", "tool", ball, X_WB); }, "it is a link's");
  // What was ignored before stays so.
  robot.ignorePair("ball", "slide");
  robot.attachObstacle("ball", "tool", q, {"slide"});
  robot.detach("ball", q);
  EXPECT_TRUE(robot.allowed("ball", "slide"));
  EXPECT_FALSE(robot.contact(q).has_value());
}

TEST(RobotObjects, RefusesGeometryBeforeAndAfterAQuery) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q = VectorXd::Zero(8);
  const auto begun = std::make_shared<Modeld>();
  begun->beginModel();
  begun->addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const auto triangle =
      std::make_shared<fcl::TrianglePd>(Vector3d(0, 0, 9), Vector3d(1, 0, 9), Vector3d(0, 1, 9));
  const std::size_t count = robot.elements().size();
  for (int i = 0; i < 2; ++i) {
    expectRefused([&] { robot.addObstacle("t", triangle); }, "can't be");
    expectRefused([&] { robot.attach("t", "tool", triangle, shifted(0, 0, 9)); }, "can't be");
    expectRefused([&] { robot.addObstacle("t", begun); }, "can't be");
    EXPECT_EQ(robot.elements().size(), count);
    EXPECT_FALSE(robot.contact(q).has_value());
  }
}

TEST(RobotObjects, TouchListsAreOfTheirObjects) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q = VectorXd::Zero(8);
  const auto ball = std::make_shared<fcl::Sphered>(0.03);
  const Transform3d X = shifted(0.8, 0, 0);
  for (const bool asked : {false, true}) {
    if (asked) {
      EXPECT_FALSE(robot.contact(q).has_value());
    }
    // Nothing is checked against itself, whatever is said of it.
    robot.addObstacle("a", ball, X);
    robot.ignorePair("a", "a");
    robot.remove("a");
    robot.attach("a", "tool", ball, X, {"a", "slide", "slide"});
    robot.remove("a");
    // Two of each other: the pair is ignored as long as either is attached.
    robot.attach("a", "tool", ball, X, {"b"});
    robot.attach("b", "slide", ball, X, {"a"});
    EXPECT_TRUE(robot.allowed("a", "b"));
    robot.detach("a", q);
    EXPECT_TRUE(robot.allowed("a", "b"));
    EXPECT_TRUE(robot.allowed("b", "a"));
    robot.detach("b", q);
    EXPECT_FALSE(robot.allowed("a", "b"));
    EXPECT_FALSE(robot.allowed("b", "a"));
    // What is removed leaves the lists of others.
    robot.attachObstacle("a", "tool", q, {"b", "left"});
    robot.remove("b");
    robot.addObstacle("b", ball, robot.pose("a", q));
    EXPECT_FALSE(robot.allowed("a", "b"));
    EXPECT_TRUE(robot.allowed("a", "left"));
    robot.ignorePair("a", "b");
    robot.detach("a", q);
    EXPECT_TRUE(robot.allowed("a", "b"));
    EXPECT_FALSE(robot.allowed("a", "left"));
    // The last word counts.
    robot.attachObstacle("a", "tool", q, {"b", "left"});
    EXPECT_FALSE(robot.contact(q).has_value());
    robot.ignorePair("left", "a", false);
    robot.ignorePair("b", "a", false);
    EXPECT_FALSE(robot.allowed("a", "left"));
    EXPECT_FALSE(robot.allowed("a", "b"));
    EXPECT_TRUE(robot.contact(q).has_value());  // of a and b, which are in one place
    robot.remove("a");
    robot.remove("b");
    EXPECT_FALSE(robot.contact(q).has_value());
  }
}

TEST(RobotObjects, StaysAsItWasWhereAMoveIsRefused) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q = VectorXd::Zero(8);
  robot.addScene(folder.write("far.yaml", R"(
world:
  collision_objects:
    - id: far
      pose: {position: [0, 0, 0], orientation: [0, 0, 0, 1]}
      primitives: [{type: sphere, dimensions: [0.1]}, {type: sphere, dimensions: [0.1]}]
      primitive_poses:
        - {position: [0, 0, 0], orientation: [0, 0, 0, 1]}
        - {position: [1.5e90, 0, 0], orientation: [0, 0, 0, 1]}
)"));
  for (const bool asked : {false, true}) {
    if (asked) {
      EXPECT_TRUE(robot.contact(q).has_value());
    }
    expectRefused([&] { robot.moveObstacle("far", shifted(1.5e90, 0, 0)); }, "too large");
    EXPECT_EQ(robot.pose("far", q).translation(), Vector3d(0, 0, 0));
    EXPECT_TRUE(robot.contact(q).has_value());
  }
}

}  // namespace
}  // namespace kios::testing
