// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry that changes in place after it was added to a linkage.

#include <fcl/config.h>

#include "fcl/expect_refused.h"
#include "linkage/robot_cases.h"

namespace kios::testing {
namespace {

/// Returns a slider of a box and a body, which is carried or stands.
RobotCase slideOf(const BodyGeometry& body, bool carried) {
  const BodyGeometry box = boxOf(0.2, 0.2, 0.2);
  return carried ? slider(body, box) : slider(box, body);
}

MotionResult ask(const RobotCase& robot, double from, double to, bool first = false) {
  MotionRequest request;
  request.first_contact = first;
  return checkMotion(robot.linkage, Joints::Constant(1, from), Joints::Constant(1, to), request);
}

template <typename Shape, typename Change>
void expectRefusedAfter(const std::shared_ptr<Shape>& shape, const Change& change) {
  for (const bool carried : {false, true}) {
    const auto own = std::make_shared<Shape>(*shape);
    const RobotCase robot = slideOf(own, carried);
    EXPECT_EQ(ask(robot, 2, 3).verdict, MotionVerdict::kClear);
    const Linkage copy = robot.linkage;
    change(*own);
    expectRefused([&] { ask(robot, 2, 3); }, "shape of body " + std::to_string(carried ? 0 : 1));
    expectRefused([&] { checkMotion(copy, Joints::Zero(1), Joints::Zero(1)); }, "shape of body");
  }
}

TEST(ChangedGeometry, ShapesOfOtherSizesAreRefused) {
  expectRefusedAfter(std::make_shared<fcl::Sphered>(0.1), [](auto& s) { s.radius = 5; });
  expectRefusedAfter(std::make_shared<fcl::Boxd>(0.1, 0.1, 0.1), [](auto& s) { s.side[1] = 9; });
  expectRefusedAfter(std::make_shared<fcl::Capsuled>(0.1, 0.1), [](auto& s) { s.lz = 9; });
  expectRefusedAfter(std::make_shared<fcl::Cylinderd>(0.1, 0.1), [](auto& s) { s.radius = 9; });
  expectRefusedAfter(std::make_shared<fcl::Coned>(0.1, 0.1), [](auto& s) { s.lz = 9; });
  expectRefusedAfter(std::make_shared<fcl::Ellipsoidd>(0.1, 0.1, 0.1),
                     [](auto& s) { s.radii[2] = 9; });
}

TEST(ChangedGeometry, PlanesAndConvexShapesThatMoveAreRefused) {
  const auto floor = std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -1);
  const RobotCase over = slideOf(floor, false);
  EXPECT_EQ(ask(over, 2, 3).verdict, MotionVerdict::kClear);
  floor->d = 0.5;
  expectRefused([&] { ask(over, 2, 3); }, "shape of body 1");

  const auto points = std::make_shared<std::vector<Vector3d>>(
      std::vector<Vector3d>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}});
  const auto faces = std::make_shared<std::vector<int>>(
      std::vector<int>{3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3});
  const RobotCase beside = slideOf(std::make_shared<fcl::Convexd>(points, 4, faces), false);
  EXPECT_EQ(ask(beside, 2, 3).verdict, MotionVerdict::kClear);
  (*points)[1].x() = 4;
  expectRefused([&] { ask(beside, 2, 3); }, "shape of body 1");
}

TEST(ChangedGeometry, BodiesThatBecomeOccupiedAreRefused) {
  const auto ball = std::make_shared<fcl::Sphered>(0.1);
  ball->threshold_occupied = 2;
  const RobotCase robot = slideOf(ball, false);
  EXPECT_EQ(ask(robot, -1, 1).verdict, MotionVerdict::kClear);
  ball->threshold_occupied = 1;
  expectRefused([&] { ask(robot, -1, 1); }, "occupancy of body 1");
}

#if FCL_HAVE_OCTOMAP
octomap::point3d point(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// As maps do: cells are added, cells that were free become occupied without a new node, others
// become free, branches are pruned, and the threshold changes.
TEST(ChangedGeometry, OctreesMayTakeUpMeasurements) {
  for (const bool carried : {false, true}) {
    const auto cells = std::make_shared<octomap::OcTree>(0.1);
    cells->updateNode(point(0.05, 0.05, 0.05), true);
    cells->updateNode(point(3.05, 0.05, 0.05), false);
    const auto octree =
        std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells));
    const RobotCase robot = slideOf(octree, carried);
    const double side = carried ? -1 : 1;
    const auto verdict = [&](double from, double to) {
      const MotionResult any = ask(robot, side * from, side * to);
      const MotionResult first = ask(robot, side * from, side * to, true);
      EXPECT_EQ(any.verdict, first.verdict);
      const MotionResult copied = checkMotion(
          Linkage(robot.linkage), Joints::Constant(1, side * from), Joints::Constant(1, side * to));
      EXPECT_EQ(any.verdict, copied.verdict);
      return any.verdict;
    };
    EXPECT_EQ(verdict(-1, 1), MotionVerdict::kContact);
    EXPECT_EQ(verdict(2, 4), MotionVerdict::kClear);
    const std::size_t nodes = cells->size();
    for (int i = 0; i < 4; ++i) cells->updateNode(point(3.05, 0.05, 0.05), true);
    EXPECT_EQ(cells->size(), nodes) << "no node is new, so that sizes tell nothing";
    EXPECT_EQ(verdict(2, 4), MotionVerdict::kContact);
    EXPECT_EQ(verdict(5, 7), MotionVerdict::kClear);
    cells->updateNode(point(6.05, 0.05, 0.05), true);
    EXPECT_EQ(verdict(5, 7), MotionVerdict::kContact);
    EXPECT_EQ(verdict(2, 4), MotionVerdict::kContact);
    for (int i = 0; i < 9; ++i) cells->updateNode(point(3.05, 0.05, 0.05), false);
    EXPECT_EQ(verdict(2, 4), MotionVerdict::kClear);
    cells->clear();
    EXPECT_EQ(verdict(-1, 7), MotionVerdict::kClear);
    cells->updateNode(point(-8.05, 0.05, 0.05), true);
    EXPECT_EQ(verdict(-9, -7), MotionVerdict::kContact);
    EXPECT_EQ(verdict(-7, 9), MotionVerdict::kClear);
  }
}

TEST(ChangedGeometry, AnEmptyOctreeMayGetCells) {
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  const auto octree = std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells));
  RobotCase robot = slideOf(octree, false);
  const int second = robot.addBody(0, boxOf(0.1, 0.1, 0.1), shifted(0, 2, 0));
  robot.ignorePair(second, 1);
  EXPECT_EQ(ask(robot, -5, 5).verdict, MotionVerdict::kClear);
  cells->updateNode(point(0.05, 2.05, 0.05), true);
  EXPECT_EQ(ask(robot, -5, 5).verdict, MotionVerdict::kClear) << "the pair is allowed";
  cells->updateNode(point(0.05, 0.05, 0.05), true);
  const MotionResult answer = ask(robot, -5, 5);
  EXPECT_EQ(answer.verdict, MotionVerdict::kContact);
  EXPECT_EQ(answer.body_a, 0);
  EXPECT_EQ(answer.body_b, 1);
}

// Random maps that grow: always as a linkage that is built anew says.
TEST(ChangedGeometry, GrowingMapsAreSeenAsTheyAre) {
  Random random(6);
  int contacts = 0, clear = 0;
  for (int i = 0; i < 30; ++i) {
    const auto cells = std::make_shared<octomap::OcTree>(0.05);
    const auto octree =
        std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells));
    const RobotCase robot = slideOf(octree, i % 2 == 1);
    for (int step = 0; step < 25; ++step) {
      const Vector3d p = 3 * inBall(random);
      cells->updateNode(point(p.x(), 0.2 * p.y(), 0.2 * p.z()), random.unit() < 0.8);
      if (step % 7 == 6) cells->prune();
      const double from = random.uniform(-3, 3), to = from + random.uniform(-1, 1);
      const MotionResult answer = ask(robot, from, to);
      const MotionResult anew = ask(slideOf(octree, i % 2 == 1), from, to);
      ASSERT_EQ(answer.verdict, anew.verdict) << i << " " << step;
      contacts += answer.verdict == MotionVerdict::kContact ? 1 : 0;
      clear += answer.verdict == MotionVerdict::kClear ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 50);
  EXPECT_GT(clear, 100);
}

// Links that come after the octree was measured again count, too.
TEST(ChangedGeometry, LinksComeAfterAnOctreeGrew) {
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(point(0.05, 0.05, 0.05), true);
  RobotCase robot =
      slideOf(std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells)), false);
  cells->updateNode(point(6.05, 0.05, 0.05), true);
  EXPECT_EQ(ask(robot, 5, 7).verdict, MotionVerdict::kContact);
  robot.linkage.addLink(0, joint(JointType::kRevolute));
  EXPECT_EQ(checkMotion(robot.linkage, Eigen::Vector2d(5, 0), Eigen::Vector2d(7, 1)).verdict,
            MotionVerdict::kContact);
  EXPECT_EQ(checkMotion(robot.linkage, Eigen::Vector2d(2, 0), Eigen::Vector2d(4, 1)).verdict,
            MotionVerdict::kClear);
}
#endif

TEST(ChangedBodies, AreMeasuredOnceForManyLinkages) {
  const auto box = std::make_shared<fcl::Boxd>(0.1, 0.2, 0.3);
  Linkage measured;
  measured.addBody(-1, box);
  Linkage wanted, linkage;
  for (Linkage* const arm : {&wanted, &linkage}) {
    arm->addLink(-1, joint(JointType::kRevolute));
    arm->addBody(-1, std::make_shared<fcl::Sphered>(0.5), shifted(0.9, 0, 0));
  }
  wanted.addBody(0, box, shifted(0.4, 0, 0));
  EXPECT_EQ(linkage.addBody(0, measured, 0, shifted(0.4, 0, 0)), 1);
  const Joints q0 = Joints::Constant(1, -2), q1 = Joints::Constant(1, 1);
  for (const Joints& q : {q0, Joints(0.5 * (q0 + q1)), q1}) {
    EXPECT_EQ(linkage.pose(1, q).matrix(), wanted.pose(1, q).matrix());
  }
  const MotionResult answer = checkMotion(linkage, q0, q1), same = checkMotion(wanted, q0, q1);
  EXPECT_EQ(answer.verdict, MotionVerdict::kContact);
  EXPECT_EQ(answer.to, same.to);
  EXPECT_EQ(answer.counts.queries, same.counts.queries);
  expectRefused([&] { linkage.addBody(0, measured, 1); }, "no body 1");
  expectRefused([&] { linkage.addBody(5, measured, 0); }, "link");
  box->side[0] = 3;
  expectRefused([&] { checkMotion(linkage, q0, q1); }, "shape of body 1");
}

TEST(ChangedBodies, RefusesWhatIsNotThere) {
  Linkage linkage;
  linkage.addLink(-1, joint(JointType::kRevolute));
  const int ball = linkage.addBody(0, std::make_shared<fcl::Sphered>(0.1));
  const int floor = linkage.addBody(-1, std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -1));
  Transform3d skew = Transform3d::Identity();
  skew.linear()(0, 1) = 0.5;
  expectRefused([&] { linkage.moveBody(2, Transform3d::Identity()); }, "no body 2");
  expectRefused([&] { linkage.moveBody(ball, 1, Transform3d::Identity()); }, "link");
  expectRefused([&] { linkage.moveBody(ball, skew); }, "pose of a body");
  expectRefused([&] { linkage.moveBody(floor, 0, Transform3d::Identity()); }, "can't turn");
  expectRefused([&] { linkage.addBody(0, nullptr); }, "null");
  EXPECT_EQ(linkage.bodies(), 2);
  linkage.removeBody(ball);
  expectRefused([&] { linkage.removeBody(ball); }, "no body 0");
  expectRefused([&] { linkage.ignorePair(ball, floor); }, "not added");
  expectRefused([&] { linkage.pose(ball, Joints::Zero(1)); }, "no body 0");
  EXPECT_EQ(checkMotion(linkage, Joints::Zero(1), Joints::Ones(1)).counts.pairs, 0);
  EXPECT_EQ(linkage.addBody(-1, std::make_shared<fcl::Sphered>(0.1)), ball);
}

}  // namespace
}  // namespace kios::testing
