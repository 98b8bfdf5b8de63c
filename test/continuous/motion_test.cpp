// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Poses, velocities and their bounds, against FCL's own motions at random times.

#include "continuous/motion.h"

#include <cmath>

#include "continuous/moving_meshes.h"

namespace kios::testing {
namespace {

using continuous::VelocityField;

class Motions : public ::testing::TestWithParam<fcl::CCDMotionType> {
 protected:
  Motion randomMotion(RandomPoses& random) const {
    if (GetParam() == fcl::CCDM_SPLINE) {
      if (random(0, 1) < 0.3) {  // about one axis
        const Vector3d axis(0.25, -0.5, 1);
        const auto turn = [&] {
          return Vector3d(std::ldexp(std::round(random(-99, 99)), -3) * axis);
        };
        return std::make_shared<fcl::SplineMotion<double>>(random.point(3), random.point(3),
                                                           random.point(3), random.point(3), turn(),
                                                           turn(), turn(), turn());
      }
      return std::make_shared<fcl::SplineMotion<double>>(
          random.point(3), random.point(3), random.point(3), random.point(3), random.point(12),
          random.point(12), random.point(12), random.point(12));
    }
    if (GetParam() == fcl::CCDM_LINEAR) {
      const Transform3d X_0 = random.pose(3), X_1 = random.pose(3);
      return std::make_shared<fcl::InterpMotion<double>>(
          X_0.linear(), X_0.translation(), X_1.linear(), X_1.translation(), random.point(2));
    }
    return motionOf(GetParam(), random.pose(3), random.pose(3));
  }
};

TEST_P(Motions, PosesAreThoseOfFcl) {
  RandomPoses random(41);
  for (int i = 0; i < 200; ++i) {
    const Motion fcl_motion = randomMotion(random);
    const Transform3d before = poseAt(*fcl_motion, random(0, 1));
    const auto motion = continuous::motionOf(fcl_motion.get());
    Transform3d after;
    fcl_motion->getCurrentTransform(after);
    EXPECT_EQ(before.matrix(), after.matrix()) << "the caller's motion was moved";
    for (int k = 0; k <= 8; ++k) {
      const double t = k / 8.0;
      const double off = (motion.pose(t).matrix() - poseAt(*fcl_motion, t).matrix()).norm();
      EXPECT_LE(off, 1e-13 * (1 + motion.pose(t).translation().norm())) << t;
    }
  }
}

// Every point's displacement keeps to velocity and acceleration, in every direction, on every
// window; and its speed to the largest speed.
TEST_P(Motions, BoundsHold) {
  RandomPoses random(41);
  double tightest = 0;
  for (int i = 0; i < 4000; ++i) {
    const Motion fcl_motion = randomMotion(random);
    const auto motion = continuous::motionOf(fcl_motion.get());
    const double t = random(0, 1), window = (1 - t) * std::pow(random(0, 1), 3);
    const Transform3d X = motion.pose(t);
    const VelocityField v = motion.velocities(t, X, window);
    const Vector3d center = random.point(2), y = center + 0.57 * random.point(0.5);
    const Vector3d x0 = X * center, x = X * y, n = random.point(1).normalized();
    const double radius = (y - center).norm() * (1 + 1e-12) + 1e-14;
    for (int k = 1; k <= 4; ++k) {
      const double s = window * k / 4;
      const Vector3d moved = motion.pose(t + s) * y - x;
      const double rounding = motion.rounding(y.norm());
      const double along = n.dot(moved) - s * n.dot(v.at(x));
      const double bound = 0.5 * s * s * v.accelerationAlong(n, x0, radius);
      ASSERT_LE(std::abs(along), bound + rounding) << i;
      ASSERT_LE((moved - s * v.at(x)).norm(), 0.5 * s * s * v.acceleration(x0, radius) + rounding);
      const Vector3d origin = X.inverse() * v.origin;
      const Vector3d origin_moved = motion.pose(t + s) * origin - v.origin;
      ASSERT_LE((moved - origin_moved).norm(), s * v.turnSpeed(x0, radius) + 4 * rounding);
      ASSERT_LE((origin_moved - s * v.linear).norm(),
                0.5 * s * s * v.originAcceleration() + 4 * rounding + 1e-12);
      if (bound > 1e-6) tightest = std::max(tightest, std::abs(along) / bound);
    }
  }
  const double at_least = GetParam() == fcl::CCDM_TRANS ? 0 : 0.3;
  EXPECT_GE(tightest, at_least) << "these bounds say nothing";
}

TEST_P(Motions, FromPoseToPose) {
  RandomPoses random(41);
  for (int i = 0; i < 500; ++i) {
    Transform3d X_0 = random.pose(3), X_1 = random.pose(3);
    if (i % 5 == 1) X_1.linear() = X_0.linear();
    if (i % 5 == 2) X_1.linear() = X_0.linear() * at(0, 0, 0, std::pow(10, -2 - i % 14)).linear();
    if (i % 5 == 3) X_1.linear() = X_0.linear() * at(0, 0, 0, M_PI).linear();
    const auto motion = continuous::motionBetween(X_0, X_1, GetParam());
    EXPECT_TRUE(motion.pose(0).isApprox(X_0, 1e-14));
    EXPECT_LE((motion.pose(1).translation() - X_1.translation()).norm(), 1e-13);
    if (GetParam() != fcl::CCDM_TRANS) {
      EXPECT_LE((motion.pose(1).linear() - X_1.linear()).norm(), 1e-13);
    }
    // Screws of tiny angles are stable; FCL's are not.
    const VelocityField v = motion.velocities(0.5, motion.pose(0.5), 0.5);
    const double h = 1e-6;
    const Vector3d y(0.3, -0.2, 0.1);
    const Vector3d moved = motion.pose(0.5 + h) * y - motion.pose(0.5 - h) * y;
    EXPECT_LE((moved / (2 * h) - v.at(motion.pose(0.5) * y)).norm(), 1e-6) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Types, Motions, ::testing::ValuesIn(kMotionTypes));

}  // namespace
}  // namespace kios::testing
