// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is put around a robot and taken away, and calls that are refused.

#include <cmath>
#include <limits>

#include "fcl/expect_refused.h"
#include "not_finite.h"
#include "robot/robot_files.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

TEST(RobotSurroundings, WhatIsAddedMovedAttachedAndRemoved) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q = VectorXd::Zero(8);
  ASSERT_FALSE(robot.contact(q).has_value());
  const auto ball = std::make_shared<fcl::Sphered>(0.03);
  robot.addObstacle("ball", ball, robot.pose("tool", q));
  EXPECT_FALSE(robot.contact(q).has_value());  // the tool has no geometry
  const Robot copy = robot;
  robot.moveObstacle("ball", robot.pose("slide", q));
  const auto contact = robot.contact(q);
  ASSERT_TRUE(contact.has_value());
  EXPECT_EQ(contact->a, "slide");
  EXPECT_EQ(contact->b, "ball");
  EXPECT_FALSE(copy.contact(q).has_value());
  robot.ignorePair("ball", "slide");
  EXPECT_FALSE(robot.contact(q).has_value());
  EXPECT_EQ(robot.checkMotion(q, q).verdict, MotionVerdict::kClear);
  robot.ignorePair("slide", "ball", false);
  EXPECT_TRUE(robot.contact(q).has_value());
  robot.remove("ball");
  EXPECT_FALSE(robot.contact(q).has_value());

  robot.addObstacle("table", std::make_shared<fcl::Boxd>(0.3, 0.3, 0.02),
                    robot.pose("tool", q) * shifted(0, 0, 0.1));
  robot.attach("rod", "tool", ball, shifted(0, 0, 0.08));
  EXPECT_TRUE(robot.contact(q).has_value());
  EXPECT_EQ(robot.contact(q)->a, "rod");
  EXPECT_EQ(robot.pose("rod", q).translation(), robot.pose("tool", q) * Vector3d(0, 0, 0.08));
  robot.remove("rod");
  robot.attach("rod", "tool", ball, shifted(0, 0, 0.08), {"table"});
  EXPECT_FALSE(robot.contact(q).has_value());
  // A floor that everything stands on, but for the base.
  robot.addObstacle("floor", std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -0.01));
  EXPECT_EQ(robot.contact(q)->a, "base");
  robot.ignorePair("floor", "base");
  EXPECT_FALSE(robot.contact(q).has_value());
  EXPECT_GT(robot.clearance(q).clearance, 0);

  expectRefused([&] { robot.addObstacle("floor", ball); }, "in use");
  expectRefused([&] { robot.addObstacle("upper", ball); }, "in use");
  expectRefused([&] { robot.addObstacle("new", nullptr); }, "null");
  expectRefused([&] { robot.addObstacle("", ball); }, "name");
  expectRefused([&] { robot.attach("new", "none", ball, shifted(0, 0, 0)); }, "none");
  expectRefused([&] { robot.ignorePair("new", "upper"); }, "new");
  expectRefused([&] { robot.moveObstacle("rod", shifted(0, 0, 0)); }, "rod");
  expectRefused([&] { robot.setPadding("upper", -1); }, "padding");
  expectRefused([&] { robot.setPadding("nobody", 1); }, "nobody");
  Transform3d skew = Transform3d::Identity();
  skew.linear()(0, 1) = 0.1;
  expectRefused([&] { robot.moveObstacle("table", skew); }, "rigid");
  expectRefused([&] { robot.contact(VectorXd::Zero(3)); }, "3 coordinates");
  VectorXd bad = q;
  bad[3] = std::numeric_limits<double>::quiet_NaN();
  expectRefused([&] { robot.clearance(bad); }, "turn");
  expectRefused([&] { robot.clearances(q, std::nan("")); }, "within");
  bad[3] = 1e305;
  expectRefused([&] { robot.contact(bad); }, "too large");
  expectRefused([&] { robot.contacts(bad); }, "too large");
  expectRefused([&] { robot.checkMotions(q, bad); }, "too large");
  expectRefused(
      [&] { robot.addObstacle("plain", std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>()); },
      "toKIOS");
}

// A rod that the slide carries passes a post, which nothing but the rod can reach.
TEST(RobotSurroundings, ProofsKnowWhatIsAttached) {
  const Folder folder;
  Robot robot = loadRobot(manyJoints(folder));
  const VectorXd q0 = VectorXd::Zero(8);
  VectorXd q1 = q0;
  q1[3] = 1.2;  // the turret turns
  const auto rod = std::make_shared<fcl::Capsuled>(0.02, 0.6);
  const Transform3d across = shifted(0.35, 0, 0) * Eigen::AngleAxisd(1.5707963, Vector3d::UnitY());
  const Vector3d tip = robot.pose("slide", q0) * Vector3d(0.55, 0, 0);
  const double angle = 0.6;
  const Vector3d met =
      Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Vector3d(tip - Vector3d(0, 0, tip.z()));
  robot.addObstacle("post", std::make_shared<fcl::Cylinderd>(0.03, 0.1),
                    shifted(met.x(), met.y(), tip.z()));
  EXPECT_EQ(robot.checkMotion(q0, q1).verdict, MotionVerdict::kClear);

  Robot carrying = robot;
  carrying.attach("rod", "slide", rod, across, {"left", "right", "lower"});
  MotionRequest request;
  request.first_contact = true;
  const RobotMotion first = carrying.checkMotion(q0, q1, request);
  ASSERT_EQ(first.verdict, MotionVerdict::kContact);
  EXPECT_EQ(first.a + " " + first.b, "rod post");
  // The rod of radius 0.02 meets the post of radius 0.03 before both are in line.
  const auto angleAt = [&](double apart) {
    double rest = 0;  // the rod lies beside the axis that it turns about
    for (int i = 0; i < 50; ++i) {
      rest = std::asin((apart + tip.y() * (1 - std::cos(rest))) / tip.x());
    }
    return angle - rest;
  };
  EXPECT_NEAR(first.to * q1[3], angleAt(0.05), 2e-6);
  carrying.setPadding("rod", 0.04);
  EXPECT_NEAR(carrying.checkMotion(q0, q1, request).to * q1[3], angleAt(0.09), 2e-6);
  carrying.setPadding("post", 0.01);
  EXPECT_NEAR(carrying.checkMotion(q0, q1, request).to * q1[3], angleAt(0.10), 2e-6);
  carrying.setPadding("rod", 0);
  carrying.setPadding("post", 0);
  carrying.ignorePair("rod", "post");
  EXPECT_EQ(carrying.checkMotion(q0, q1).verdict, MotionVerdict::kClear);

  // Touch links say it as well; and a second object meets the first.
  carrying = robot;
  carrying.attach("rod", "slide", rod, across, {"left", "right", "post"});
  EXPECT_EQ(carrying.checkMotion(q0, q1).verdict, MotionVerdict::kClear);
  carrying.attach("flag", "cart", rod,
                  carrying.pose("cart", q0).inverse() * shifted(met.x(), met.y(), tip.z()),
                  {"post"});
  const RobotMotion both = carrying.checkMotion(q0, q1, request);
  ASSERT_EQ(both.verdict, MotionVerdict::kContact);
  EXPECT_EQ(both.a + " " + both.b, "rod flag");
  EXPECT_NEAR(both.to * q1[3], angleAt(0.04), 2e-6);
}

// At overlap the gradient points the shortest way out of marked solids.
TEST(RobotSurroundings, GradientsOfOverlapLeadOut) {
  const Folder folder;
  const std::string box = folder.write("box.obj", boxObj(0.5, 0.5, 0.5));
  Robot robot = loadRobot(
      folder.write("r.urdf", "<robot name='r'>" + link("a") + link("b", "<box size='1 1 1'/>") +
                                 joint("fly", "floating", "a", "b") + "</robot>"));
  VectorXd q = VectorXd::Zero(6);
  q << 0.9, 0.1, 0.2, 0, 0, 0;
  const auto solid = loadMesh(box);
  markSolid(*solid);
  robot.addObstacle("mesh", solid);
  const RobotClearance near = robot.clearance(q);
  EXPECT_EQ(near.clearance, 0);
  ASSERT_EQ(near.gradient.size(), 6);
  EXPECT_GT(near.gradient[0], 0.5);
}

// One marked solid within another is in contact whatever the paddings, and all calls say so.
TEST(RobotSurroundings, SolidsWithinSolidsAreInContact) {
  const Folder folder;
  const auto large = loadMesh(folder.write("large.obj", boxObj(0.5, 0.5, 0.5)));
  const auto small = loadMesh(folder.write("small.obj", boxObj(0.1, 0.1, 0.1)));
  markSolid(*large);
  markSolid(*small);
  Robot robot =
      loadRobot(folder.write("r.urdf", "<robot name='r'>" + link("a") + link("b") +
                                           joint("fly", "floating", "a", "b") + "</robot>"));
  robot.attach("small", "b", small, shifted(0, 0, 0));
  robot.addObstacle("large", large);
  VectorXd q = VectorXd::Zero(6);
  q << 0.1, 0.05, -0.1, 0.3, 0.2, 0.1;
  for (const double padding : {0.0, 0.01, 0.2}) {
    SCOPED_TRACE(padding);
    robot.setPadding("small", padding);
    const auto contact = robot.contact(q);
    ASSERT_TRUE(contact.has_value());
    EXPECT_LT(contact->point.cwiseAbs().maxCoeff(), 0.5);
    EXPECT_EQ(robot.contacts(q)[0], 1);
    const RobotClearance nearest = robot.clearance(q);
    EXPECT_EQ(nearest.clearance, -padding);
    EXPECT_EQ(nearest.lower_bound, -padding);
    ASSERT_EQ(nearest.gradient.size(), 6);
    EXPECT_GT(nearest.gradient.head(3).norm(), 0.5);
    ClearanceRequest near;
    near.far_enough = 0.01;
    EXPECT_EQ(robot.clearance(q, near).clearance, -padding);
    ASSERT_EQ(robot.clearances(q, 0.0).size(), 1u);
    EXPECT_EQ(robot.checkMotion(q, q).verdict, MotionVerdict::kContact);
  }
}

// FCL's search for a contact of two shapes has no end where one is 1e10 times as large.
TEST(RobotSurroundings, ShapesOfAnySizesHaveAnAnswer) {
  const Folder folder;
  Random random(12);
  for (const double size : {1e7, 1e10, 1e12, 1e16, 1e20}) {
    Robot robot =
        loadRobot(folder.write("r.urdf", "<robot name='r'>" + link("a") +
                                             link("b", "<cylinder radius='0.06' length='0.1'/>") +
                                             joint("fly", "floating", "a", "b") + "</robot>"));
    robot.addObstacle("beam", std::make_shared<fcl::Boxd>(size, 0.2, 0.1));
    for (int i = 0; i < 300; ++i) {
      VectorXd q(6);
      for (double& x : q) x = random.uniform(-0.3, 0.3);
      const bool contact = robot.contact(q).has_value();
      EXPECT_TRUE(contact || std::abs(q[1]) > 0.1 || std::abs(q[2]) > 0.05);
      EXPECT_FALSE(contact && size < 1e11 && (std::abs(q[1]) > 0.25 || std::abs(q[2]) > 0.2));
      if (i < 20) robot.checkMotion(q, 0.9 * q);
    }
  }
}

TEST(RobotSurroundings, WithoutPairsAllIsClear) {
  const Folder folder;
  const Robot robot = loadRobot(
      folder.write("r.urdf", "<robot name='r'>" + link("a", "<sphere radius='1'/>") + "</robot>"));
  const VectorXd q(0);
  EXPECT_EQ(robot.coordinates(), 0);
  EXPECT_FALSE(robot.contact(q).has_value());
  EXPECT_EQ(robot.clearance(q).clearance, kInfinity);
  EXPECT_TRUE(robot.clearance(q).a.empty());
  EXPECT_EQ(robot.checkMotion(q, q).verdict, MotionVerdict::kClear);
}

TEST(RobotSurroundings, ScenesMayNameLinksThatNoJointMoves) {
  const Folder folder;
  Robot robot = loadRobot(folder.write(
      "o.urdf", "<robot name='o'>" + link("base") + link("table") + link("camera") + link("arm") +
                    joint("i", "fixed", "base", "table", "<origin xyz='1 0 0'/>") +
                    joint("j", "fixed", "table", "camera", "<origin xyz='0 2 0' rpy='0 0 1.5'/>") +
                    joint("k", "continuous", "camera", "arm") + "</robot>"));
  robot.addScene(folder.write("scene.yaml",
                              "world:\n  collision_objects:\n    - id: cup\n"
                              "      header: {frame_id: camera}\n"
                              "      primitives: [{type: sphere, dimensions: [0.1]}]\n"
                              "      primitive_poses: [{position: [0, 0, 0.5]}]\n"));
  const VectorXd q = VectorXd::Zero(1);
  EXPECT_TRUE(robot.pose("cup", q).isApprox(robot.pose("camera", q) * shifted(0, 0, 0.5), 1e-12));
}

}  // namespace
}  // namespace kios::testing
