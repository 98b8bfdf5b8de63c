// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Random trees of joints among random obstacles: the answers of checkMotion() against dense
// samples.

#include "linkage/robot_cases.h"

namespace kios::testing {
namespace {

Mesh linkMesh(Random& random) {
  const double size = random.uniform(0.05, 0.3);
  switch (static_cast<int>(random.uniform(0, 5))) {
    case 0:  // a rod
      return scenes::subdividedBox({2 * size, 0.02, 0.03}, 3);
    case 1:  // a plate
      return scenes::subdividedBox({size, 1.5 * size, 0.004}, 4);
    case 2:
      return scenes::flangedCylinder(0.3 * size, size, 12);
    case 3: {
      Mesh torus = scenes::bumpyTorus(300);
      for (Vector3d& p : torus.vertices) p *= 0.5 * size;
      return torus;
    }
    default:
      return scenes::randomSoup(12, size, 0.1 * size, size, 1 + static_cast<int>(1e6 * size));
  }
}

struct Kind {
  int least_links, most_links;
  double offset;    // of joints
  double straight;  // chance that a link hangs on the one before
  int obstacles;
  double spread;      // of obstacles
  double mimics = 0;  // chance that a joint shares the coordinate of one before
  bool shapes = false;
};

BodyGeometry bodyOf(const Kind& kind, Random& random) {
  if (!kind.shapes) return modelOf(linkMesh(random));
  const BodyGeometry shapes[] = {std::make_shared<fcl::Sphered>(0.12),
                                 std::make_shared<fcl::Capsuled>(0.05, 0.4),
                                 std::make_shared<fcl::Boxd>(0.1, 0.3, 0.2),
                                 std::make_shared<fcl::Cylinderd>(0.1, 0.3),
                                 std::make_shared<fcl::Coned>(0.12, 0.3),
                                 std::make_shared<fcl::Ellipsoidd>(0.1, 0.2, 0.15)};
  return shapes[static_cast<std::size_t>(random.uniform(0, 6))];
}

RobotCase randomRobot(const Kind& kind, Random& random) {
  RobotCase robot;
  const int links = static_cast<int>(random.uniform(kind.least_links, kind.most_links + 1));
  for (int i = 0; i < links; ++i) {
    const bool straight = i == 0 || random.unit() < kind.straight;
    const int parent = straight ? i - 1 : static_cast<int>(random.uniform(-1, i));
    robot.addLink(parent,
                  randomJoint(random, kind.offset, 0.2, robot.linkage.coordinates(), kind.mimics));
    if (random.unit() < 0.85) {
      robot.addBody(i, bodyOf(kind, random), randomPose(random, 0.3 * kind.offset));
    }
  }
  for (int i = 0; i < kind.obstacles; ++i) {
    robot.addBody(-1, bodyOf(kind, random), randomPose(random, kind.spread));
  }
  if (kind.shapes) {
    robot.addBody(-1, std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -0.9));
  }
  return robot;
}

/// Bodies that are in contact at q are allowed to be; a planner's start is free.
void allowContacts(RobotCase& robot, const Joints& q, double separation) {
  const auto X = robot.poses(q);
  for (std::size_t a = 0; a < X.size(); ++a) {
    for (std::size_t b = a + 1; b < X.size(); ++b) {
      const int i = static_cast<int>(a), j = static_cast<int>(b);
      if (robot.meet(i, X[a], j, X[b], separation)) robot.ignorePair(i, j);
    }
  }
}

void runRandom(const Kind& kind, int robots, double separation, std::uint64_t seed) {
  Random random(seed);
  MotionTally tally;
  for (int i = 0; i < robots; ++i) {
    RobotCase robot = randomRobot(kind, random);
    const int n = robot.linkage.coordinates();
    Joints q0 = randomJoints(n, 2, random);
    allowContacts(robot, q0, separation);
    for (const double length : {0.03, 0.3, 0.3, 1.0, 3.0}) {
      const Joints q1 = q0 + randomJoints(n, length, random);
      SCOPED_TRACE("robot " + std::to_string(i) + " of seed " + std::to_string(seed) + ", length " +
                   std::to_string(length));
      expectRight(robot, q0, q1, 200, tally, separation);
      if (::testing::Test::HasFailure()) return;
    }
  }
  tally.expectBothKinds();
  EXPECT_EQ(tally.unresolved, 0);
  // Contacts of two shapes are FCL's, and may begin deeper than where their distance ends.
  EXPECT_LE(tally.first_unresolved, kind.shapes ? tally.contact : tally.contact / 100);
}

TEST(RandomLinkages, ShortChains) { runRandom({1, 3, 0.4, 1, 10, 0.7}, 150, 0, 1); }
TEST(RandomLinkages, LongChains) { runRandom({5, 12, 0.25, 1, 5, 0.7}, 60, 0, 2); }
TEST(RandomLinkages, Trees) { runRandom({3, 12, 0.3, 0.4, 5, 0.7}, 60, 0, 3); }
TEST(RandomLinkages, JointsThatMimicOthers) {
  runRandom({3, 10, 0.3, 0.5, 5, 0.7, 0.5}, 60, 0, 9);
  runRandom({3, 8, 0.3, 0.5, 12, 0.6, 0.7}, 30, 0.02, 10);
}
TEST(RandomLinkages, Shapes) { runRandom({2, 5, 0.4, 1, 6, 0.9, 0, true}, 60, 0, 7); }
TEST(RandomLinkages, LongLinks) { runRandom({2, 6, 2, 0.8, 100, 2}, 60, 0, 4); }
TEST(RandomLinkages, WithASeparation) {
  runRandom({1, 6, 0.3, 0.8, 5, 0.7}, 30, 0.01, 5);
  runRandom({1, 6, 0.3, 0.8, 5, 0.7}, 30, 0.1, 6);
}

}  // namespace
}  // namespace kios::testing
