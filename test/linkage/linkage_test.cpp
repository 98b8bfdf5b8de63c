// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Linkages: poses, which pairs are checked, what is refused.

#include "fcl/expect_refused.h"
#include "linkage/robot_cases.h"
#include "not_finite.h"

namespace kios::testing {
namespace {

BodyGeometry cube(double size = 1) { return modelOf(scenes::subdividedBox({size, size, size}, 1)); }

TEST(Linkages, PosesAreThoseOfExactKinematics) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    RobotCase robot;
    const int links = 1 + i % 12;
    double length = 0;
    for (int k = 0; k < links; ++k) {
      Joint each = joint(static_cast<JointType>(static_cast<int>(random.uniform(0, 3))));
      each.X_PJ = randomPose(random, 1);
      each.axis = random.uniform(0.1, 3) * inBall(random);
      if (i % 2 != 0 && robot.linkage.coordinates() > 0 && random.unit() < 0.3) {
        each.coordinate = 0;
        each.multiplier = random.uniform(-1, 1);
        each.offset = random.uniform(-1, 1);
      }
      robot.addLink(k == 0 ? -1 : static_cast<int>(random.uniform(-1, k)), each);
      robot.addBody(k, cube(), randomPose(random, 1));
      length += 2;
    }
    robot.addBody(-1, cube(), randomPose(random, 5));
    Joints q(robot.linkage.coordinates());
    for (double& x : q) x = random.uniform(-4, 4);
    for (const double x : q) length += 3 * std::abs(x);
    const auto exact = robot.poses(q);
    for (std::size_t b = 0; b < exact.size(); ++b) {
      const Transform3d X = robot.linkage.pose(static_cast<int>(b), q);
      EXPECT_LE((X.linear() - exact[b].linear()).norm(), 1e-15 * (links + 2) * 10);
      EXPECT_LE((X.translation() - exact[b].translation()).norm(), 1e-15 * (links + 2) * length);
    }
  }
}

TEST(Linkages, CoordinatesBelongToJointsThatMove) {
  Linkage linkage;
  EXPECT_EQ(linkage.addLink(-1, joint(JointType::kFixed)), 0);
  EXPECT_EQ(linkage.addLink(0, joint(JointType::kRevolute)), 1);
  EXPECT_EQ(linkage.addLink(0, joint(JointType::kFixed)), 2);
  EXPECT_EQ(linkage.addLink(2, joint(JointType::kPrismatic, {0, 0, 1}, {0, 0, 2})), 3);
  EXPECT_EQ(linkage.coordinates(), 2);
  EXPECT_EQ(linkage.links(), 4);
  EXPECT_EQ(linkage.addBody(3, cube()), 0);
  EXPECT_EQ(linkage.addBody(-1, cube(), shifted(4, 0, 0)), 1);
  EXPECT_EQ(linkage.bodies(), 2);
  const Eigen::Vector2d q(0.5, 0.25);
  EXPECT_EQ(linkage.pose(0, q).translation(), Vector3d(0, 0, 1.5));
  EXPECT_EQ(linkage.pose(1, q).translation(), Vector3d(4, 0, 0));
  Linkage probe = linkage;
  for (int link = 0; link < linkage.links(); ++link) {
    const int body = probe.addBody(link, std::make_shared<fcl::Sphered>(1));
    EXPECT_EQ(linkage.linkPose(link, q).matrix(), probe.pose(body, q).matrix());
  }
  expectRefused([&] { linkage.linkPose(-1, q); }, "no link -1");
  // A joint that mimics the slider, and one that leaves a coordinate to nobody.
  Joint mimic = joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0});
  mimic.coordinate = 1;
  mimic.multiplier = -2;
  mimic.offset = 0.125;
  EXPECT_EQ(linkage.addLink(-1, mimic), 4);
  EXPECT_EQ(linkage.coordinates(), 2);
  EXPECT_EQ(linkage.addBody(4, cube()), 2);
  EXPECT_EQ(linkage.pose(2, q).translation(), Vector3d(-0.375, 0, 0));
  {
    Linkage wide = linkage;
    mimic.coordinate = 3;
    wide.addLink(-1, mimic);
    EXPECT_EQ(wide.coordinates(), 4);
    wide.addLink(-1, joint(JointType::kRevolute));
    EXPECT_EQ(wide.coordinates(), 5);
  }
  const Linkage copy = linkage;
  Linkage moved = std::move(linkage);
  moved.addLink(-1, joint(JointType::kRevolute));
  EXPECT_EQ(copy.coordinates(), 2);
  EXPECT_EQ(moved.coordinates(), 3);
}

// A slider of two cubes that pass an obstacle; which pairs count.
TEST(Linkages, WhichPairsAreChecked) {
  const auto verdict = [](const Linkage& linkage) {
    const Joints zero = Joints::Zero(linkage.coordinates());
    return checkMotion(linkage, zero, Joints::Ones(linkage.coordinates())).verdict;
  };
  Linkage linkage;
  linkage.addLink(-1, joint(JointType::kPrismatic));
  const int a = linkage.addBody(0, cube()), b = linkage.addBody(0, cube());
  const int wall = linkage.addBody(-1, cube(), shifted(0, 0, 2.5));
  linkage.addBody(-1, cube(), shifted(0.5, 0, 2.5));
  linkage.addLink(-1, joint(JointType::kFixed));
  EXPECT_EQ(verdict(linkage), MotionVerdict::kClear);  // bodies of one link, and two obstacles
  EXPECT_EQ(checkMotion(linkage, Joints::Zero(1), 2 * Joints::Ones(1)).verdict,
            MotionVerdict::kContact);
  const int fixed = linkage.addBody(1, cube(), shifted(0, 0, 3));
  EXPECT_EQ(verdict(linkage), MotionVerdict::kContact);  // of a fixed link and an obstacle
  const MotionResult still = checkMotion(linkage, Joints::Ones(1), Joints::Ones(1));
  EXPECT_EQ(still.verdict, MotionVerdict::kContact);  // of one configuration
  EXPECT_EQ(std::pair(still.body_a, still.body_b), std::pair(std::min(wall, fixed), fixed));
  expectRefused([&] { linkage.ignorePair(wall, wall); }, "itself");
  linkage.ignorePair(wall, fixed);
  linkage.ignorePair(fixed, wall);
  linkage.ignorePair(fixed, 3);
  EXPECT_EQ(verdict(linkage), MotionVerdict::kClear);
  const MotionResult far = checkMotion(linkage, Joints::Zero(1), 3 * Joints::Ones(1));
  EXPECT_EQ(far.verdict, MotionVerdict::kContact);
  EXPECT_LT(far.body_a, 2);
  for (const int body : {a, b}) {
    linkage.ignorePair(body, wall);
    linkage.ignorePair(3, body);
    linkage.ignorePair(fixed, body);
  }
  EXPECT_EQ(checkMotion(linkage, Joints::Zero(1), 3 * Joints::Ones(1)).verdict,
            MotionVerdict::kClear);
}

TEST(Linkages, WithoutBodiesOrJointsAllIsClear) {
  Linkage linkage;
  EXPECT_EQ(checkMotion(linkage, Joints(0), Joints(0)).verdict, MotionVerdict::kClear);
  linkage.addBody(-1, cube());
  linkage.addLink(-1, joint(JointType::kRevolute));
  EXPECT_EQ(checkMotion(linkage, Joints::Zero(1), Joints::Ones(1)).verdict, MotionVerdict::kClear);
}

TEST(Linkages, BadLinksAndBodiesAreRefused) {
  Linkage linkage;
  const auto unchanged = [&](int links, int bodies, int coordinates) {
    EXPECT_EQ(linkage.links(), links);
    EXPECT_EQ(linkage.bodies(), bodies);
    EXPECT_EQ(linkage.coordinates(), coordinates);
  };
  expectRefused([&] { linkage.addLink(0, Joint()); }, "parent");
  expectRefused([&] { linkage.addLink(-2, Joint()); }, "parent");
  for (const Vector3d& axis :
       {Vector3d(0, 0, 0), Vector3d(kNaN, 0, 1), Vector3d(0, kInfinity, 0)}) {
    expectRefused(
        [&] {
          linkage.addLink(-1, joint(JointType::kRevolute, {0, 0, 0}, axis));
        },
        "axis");
    expectRefused(
        [&] {
          linkage.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, axis));
        },
        "axis");
  }
  expectRefused([&] { linkage.addLink(-1, joint(static_cast<JointType>(7))); }, "type");
  for (const int coordinate : {-2, 1 << 20}) {
    Joint far = joint(JointType::kRevolute);
    far.coordinate = coordinate;
    expectRefused([&] { linkage.addLink(-1, far); }, "coordinate");
  }
  for (const double factor : {kNaN, kInfinity, -0x1p101}) {
    Joint wild = joint(JointType::kRevolute);
    wild.multiplier = factor;
    expectRefused([&] { linkage.addLink(-1, wild); }, "multiplier");
    std::swap(wild.multiplier, wild.offset);
    expectRefused([&] { linkage.addLink(-1, wild); }, "offset");
  }
  expectRefused(
      [&] {
        linkage.addLink(-1, joint(JointType::kFixed, {kNaN, 0, 0}));
      },
      "translation");
  Joint skew = joint(JointType::kRevolute);
  skew.X_PJ.linear()(0, 1) = 0.01;
  expectRefused([&] { linkage.addLink(-1, skew); }, "pose of a joint");
  skew.X_PJ.linear() = Vector3d(1, 1, -1).asDiagonal();
  expectRefused([&] { linkage.addLink(-1, skew); }, "pose of a joint");
  unchanged(0, 0, 0);
  linkage.addLink(-1, joint(JointType::kRevolute));

  expectRefused([&] { linkage.addBody(1, cube()); }, "link");
  expectRefused([&] { linkage.addBody(-2, cube()); }, "link");
  expectRefused([&] { linkage.addBody(0, nullptr); }, "null");
  expectRefused([&] { linkage.addBody(0, std::make_shared<fcl::BVHModel<kIOSd>>()); }, "");
  expectRefused([&] { linkage.addBody(0, std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>()); },
                "toKIOS");
  expectRefused([&] { linkage.addBody(0, std::make_shared<fcl::Sphered>(-1)); }, "radius");
  expectRefused([&] { linkage.addBody(0, std::make_shared<fcl::Boxd>(1, kNaN, 1)); }, "fcl::Box");
  expectRefused([&] { linkage.addBody(0, cube(), shifted(0, kInfinity, 0)); }, "translation");
  Transform3d mirrored = Transform3d::Identity();
  mirrored.linear()(2, 2) = -1;
  expectRefused([&] { linkage.addBody(-1, cube(), mirrored); }, "pose of a body");
  expectRefused(
      [&] { linkage.addBody(0, std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), 0)); }, "turn");
  unchanged(1, 0, 1);
  linkage.addBody(0, cube());
  linkage.addBody(-1, cube(), shifted(9, 0, 0));
  expectRefused([&] { linkage.ignorePair(0, 2); }, "allowed");
  expectRefused([&] { linkage.ignorePair(-1, 0); }, "allowed");
  expectRefused([&] { linkage.pose(2, Joints::Zero(1)); }, "no body 2");
  expectRefused([&] { linkage.pose(0, Joints::Zero(2)); }, "2 coordinates");
  unchanged(1, 2, 1);
}

TEST(Linkages, BadPathsAreRefused) {
  Linkage linkage;
  linkage.addLink(-1, joint(JointType::kRevolute));
  linkage.addLink(0, joint(JointType::kPrismatic));
  const auto changing = makeModel(scenes::subdividedBox({1, 1, 1}, 1).vertices,
                                  scenes::subdividedBox({1, 1, 1}, 1).triangles);
  linkage.addBody(1, changing);
  linkage.addBody(-1, cube(), shifted(9, 0, 0));
  const Joints q = Joints::Zero(2);
  const auto ask = [&](const Joints& q0, const Joints& q1, const MotionRequest& request = {}) {
    return checkMotion(linkage, q0, q1, request);
  };
  expectRefused([&] { ask(Joints::Zero(1), q); }, "q0 has 1 coordinates");
  expectRefused([&] { ask(q, Joints::Zero(3)); }, "q1 has 3 coordinates");
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    expectRefused([&] { ask(Eigen::Vector2d(bad, 0), q); }, "q0 is NaN or infinite");
    expectRefused([&] { ask(q, Eigen::Vector2d(0, bad)); }, "q1 is NaN or infinite");
    expectRefused([&] { linkage.pose(0, Eigen::Vector2d(bad, 0)); }, "NaN or infinite");
    MotionRequest request;
    request.min_separation = bad;
    expectRefused([&] { ask(q, q, request); }, "min_separation");
    request = MotionRequest();
    request.resolution = bad;
    expectRefused([&] { ask(q, q, request); }, "resolution");
  }
  MotionRequest request;
  request.min_separation = -1e-9;
  expectRefused([&] { ask(q, q, request); }, "min_separation");
  request = MotionRequest();
  request.resolution = 0;
  expectRefused([&] { ask(q, q, request); }, "resolution");
  EXPECT_EQ(ask(q, q).verdict, MotionVerdict::kClear);
  // Beyond what doubles resolve nothing is proven, and nothing hangs.
  EXPECT_NE(ask(q, Eigen::Vector2d(1e18, 0)).verdict, MotionVerdict::kClear);
  EXPECT_NE(ask(Eigen::Vector2d(-1e60, -1e60), Eigen::Vector2d(1e60, 1e60)).verdict,
            MotionVerdict::kClear);
  for (const double far : {1e30, 1e90}) {
    EXPECT_NE(ask(q, Eigen::Vector2d(far, far)).verdict, MotionVerdict::kClear);
    EXPECT_NE(ask(Eigen::Vector2d(far, 1), Eigen::Vector2d(far, 2)).verdict, MotionVerdict::kClear);
  }
  expectRefused([&] { ask(q, Eigen::Vector2d(-1e300, 0)); }, "q1 is too large");

  std::vector<Vector3d> points;
  for (Vector3d p : scenes::subdividedBox({1, 1, 1}, 1).vertices) points.push_back(2 * p);
  changing->beginReplaceModel();
  changing->replaceSubModel(points);
  changing->endReplaceModel();
  expectRefused([&] { ask(q, q); }, "body 0 was changed");
}

}  // namespace
}  // namespace kios::testing
