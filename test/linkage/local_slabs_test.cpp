// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The motion of a chain's body as continuous collision takes it, and intervals that slabs between
// triangles prove.

#include "linkage/local_slabs.h"
#include "linkage/chain.h"
#include "linkage/robot_cases.h"

namespace kios::testing {
namespace {

using articulated::Chain;
using articulated::LocalSlabs;
using articulated::Pair;
using articulated::Path;

RobotCase randomChain(Random& random, int links, double prismatic) {
  RobotCase robot;
  for (int i = 0; i < links; ++i) {
    robot.addLink(i - 1, randomJoint(random, 0.4, prismatic));
    robot.addBody(i, modelOf(scenes::subdividedBox({0.3, 0.05, 0.02}, 2)), randomPose(random, 0.2));
  }
  return robot;
}

// Points leave their tangents by at most half the acceleration times the square of the time, and
// come near that.
TEST(Chains, VelocitiesAndAccelerationsBoundTheMotion) {
  Random random(1);
  double nearest = 0, nearest_relative = 0;
  for (int i = 0; i < 1500; ++i) {
    const RobotCase robot = randomChain(random, 1 + i % 5, i % 3 == 0 ? 0.5 : 0.2);
    const int n = robot.linkage.coordinates(), last = static_cast<int>(robot.bodies.size()) - 1;
    Joints q0 = randomJoints(n, 2, random), q1 = q0 + randomJoints(n, 2, random);
    if (i % 4 == 0 && n > 1) q1[n / 2] = q0[n / 2];
    const Path path(robot.linkage.impl(), q0, q1);
    const auto& moving = robot.linkage.impl().links[last].moving;
    const int shared =
        static_cast<int>(random.uniform(0, static_cast<double>(moving.size()) + 0.99));
    const Chain chain(path, last, shared);
    const double s = random.unit() * 0.9, window = (1 - s) * random.unit();
    const auto X = chain.pose(s);
    const auto v = chain.velocities(s, X, window);
    EXPECT_TRUE(shared > 0 || X.isApprox(robot.linkage.pose(last, between(q0, q1, s)), 1e-13));
    for (int k = 0; k < 8; ++k) {
      const Vector3d y = 2 * inBall(random), x = X * y;
      for (const double part : {1e-3, 0.3, 1.0}) {
        const double h = part * window;
        const Vector3d moved = chain.pose(s + h) * y - x;
        const double off = (moved - h * v.at(x)).norm();
        const double bound = 0.5 * h * h * v.acceleration(x);
        EXPECT_LE(off, bound * (1 + 1e-9) + 1e-13) << i;
        if (h > 0.01 && bound > 0) nearest = std::max(nearest, off / bound);
        // About an axis, none of it is along the axis.
        const Vector3d m = inBall(random).normalized();
        EXPECT_LE(std::abs(m.dot(moved - h * v.at(x))),
                  0.5 * h * h * v.accelerationAlong(m, x, 0) * (1 + 1e-9) + 1e-13);
        const double speed_bound = v.turnSpeed(x, 0) * h;
        const Vector3d origin = X.inverse() * v.origin;
        const double turned = (moved - (chain.pose(s + h) * origin - v.origin)).norm();
        EXPECT_LE(turned, speed_bound * (1 + 1e-9) + 1e-13);
        if (speed_bound > 1e-3) nearest_relative = std::max(nearest_relative, turned / speed_bound);
      }
    }
  }
  EXPECT_GT(nearest, 0.9);
  EXPECT_GT(nearest_relative, 0.9);
}

// In intervals that are proven no sample is nearer than the separation.
TEST(LocalSlabsOf, RandomPairsAreApartAsFarAsTheyProve) {
  Random random(2);
  int proven = 0, whole = 0, near = 0;
  for (int i = 0; i < 1500; ++i) {
    RobotCase robot = randomChain(random, 1 + i % 4, 0.2);
    const bool shape = i % 5 == 0;
    const BodyGeometry obstacle = shape ? BodyGeometry(std::make_shared<fcl::Capsuled>(0.05, 0.3))
                                        : modelOf(scenes::subdividedBox({0.3, 0.2, 0.01}, 2));
    const int b = robot.addBody(-1, obstacle, randomPose(random, 0.5));
    const int n = robot.linkage.coordinates(), a = random.unit() < 0.5 || b < 3 ? b - 1 : b - 3;
    const int c = a == b - 3 ? b - 1 : b;  // two links, or a link and the obstacle
    const Joints q0 = randomJoints(n, 2, random), q1 = q0 + randomJoints(n, 1, random);
    const Path path(robot.linkage.impl(), q0, q1);
    const auto& bodies = robot.linkage.impl().bodies;
    const int shared = c == b ? 0 : robot.linkage.impl().shared(bodies[a].link, bodies[c].link);
    const double separation = i % 3 == 0 ? 0.01 : 0;
    LocalSlabs slabs(path, Pair{a, c, shared}, separation);
    double from = random.unit() * 0.8;
    const double to = from + random.unit() * (1 - from);
    for (int step = 0; step < 6 && from < to; ++step) {
      const double end = slabs.provenFrom(from, to, 20000);
      ASSERT_GE(end, from);
      ASSERT_LE(end, to);
      if (end == from) break;
      ++proven;
      whole += end == to ? 1 : 0;
      for (int k = 0; k <= 12; ++k) {
        const Joints q = between(q0, q1, from + (end - from) * k / 12);
        const auto X = robot.poses(q);
        fcl::DistanceResultd result;
        const double distance =
            fcl::distance(robot.bodies[a].geometry.get(), X[a], robot.bodies[c].geometry.get(),
                          X[c], fcl::DistanceRequestd(), result);
        ASSERT_GT(distance, separation) << i << ": " << k << " of 12";
        near += distance < separation + 1e-3 ? 1 : 0;
      }
      from = end;
    }
  }
  EXPECT_GT(proven, 1500);
  EXPECT_GT(whole, 300);
  EXPECT_GT(near, 100);
}

}  // namespace
}  // namespace kios::testing
