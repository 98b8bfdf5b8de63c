// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No point of a sphere moves farther than the bound says: long double over many poses and points.

#include "scene/motion_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/motions.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using scenes::Random;
using Exact = Eigen::Matrix<long double, 3, 1>;

fcl::Vector3d anyDirection(Random& random) {
  for (;;) {
    const fcl::Vector3d v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
  }
}

template <typename S>
struct Motion {
  fcl::Matrix3<S> R0, R1;
  fcl::Vector3<S> T0, T1;

  long double moved(const Exact& y) const {
    // By the differences, so that large offsets cost no digits.
    const Eigen::Matrix<long double, 3, 3> M =
        R1.template cast<long double>() - R0.template cast<long double>();
    const Exact T = T1.template cast<long double>() - T0.template cast<long double>();
    return (M * y + T).norm();
  }
};

template <typename S>
Motion<S> anyMotion(Random& random, double step, double offset) {
  const fcl::Matrix3d R0 =
      fcl::AngleAxisd(random.uniform(0, 3), anyDirection(random)).toRotationMatrix();
  const fcl::Matrix3d R1 =
      fcl::AngleAxisd(step * random.uniform(-1, 1), anyDirection(random)).toRotationMatrix() * R0;
  const fcl::Vector3d T0 = offset * anyDirection(random);
  const fcl::Vector3d T1 = T0 + step * random.unit() * anyDirection(random);
  return {R0.cast<S>(), R1.cast<S>(), T0.cast<S>(), T1.cast<S>()};
}

template <typename S>
void expectSound(const Motion<S>& motion, const scene::Sphere& sphere, Random& random) {
  const double bound = scene::displacement<S>(motion.R0, motion.T0, motion.R1, motion.T1, sphere);
  const Exact c(sphere.center[0], sphere.center[1], sphere.center[2]);
  long double most = 0;
  for (int i = 0; i < 30; ++i) {
    // Directions along which R1 - R0 stretches most, and any others.
    Exact v = anyDirection(random).cast<long double>();
    if (i < 3) {
      const fcl::Matrix3d M = motion.R1.template cast<double>() - motion.R0.template cast<double>();
      const Eigen::JacobiSVD<fcl::Matrix3d> svd(M, Eigen::ComputeFullV);
      v = svd.matrixV().col(i).cast<long double>();
      const Exact push =
          motion.R1.template cast<long double>() * c - motion.R0.template cast<long double>() * c;
      if ((M.cast<long double>() * v).dot(push) < 0) v = -v;
    }
    v = v / v.norm() * sphere.radius * (1 - 1e-17L);
    most = std::max(most, motion.moved(c + v));
  }
  ASSERT_GE(static_cast<long double>(bound) * (1 + 1e-17L), most);
}

TEST(MotionBound, NeverExceededAtAnyStepOffsetAndSize) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double step = std::pow(10, random.uniform(-18, 0.5));
    const double size = std::pow(10, random.uniform(-9, 9));
    const double offset = random.unit() < 0.3 ? 1e9 : std::pow(10, random.uniform(-9, 12));
    scene::Sphere sphere;
    const fcl::Vector3d c = (random.unit() < 0.3 ? 1e9 : size) * anyDirection(random);
    for (int k = 0; k < 3; ++k) sphere.center[k] = c[k];
    sphere.radius = size * random.unit();
    expectSound(anyMotion<double>(random, step, offset), sphere, random);
    expectSound(anyMotion<float>(random, step, offset), sphere, random);
    if (HasFatalFailure()) FAIL() << i;
  }
}

TEST(MotionBound, AnyMatrices) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    Motion<double> motion;
    for (int k = 0; k < 9; ++k) {
      motion.R0(k / 3, k % 3) = random.uniform(-1, 1);
      motion.R1(k / 3, k % 3) = random.unit() < 0.3 ? -motion.R0(k / 3, k % 3) : random.unit();
    }
    motion.T0 = anyDirection(random);
    motion.T1 = anyDirection(random);
    expectSound(motion, {{1, -2, 3}, 0.7}, random);
    if (HasFatalFailure()) FAIL() << i;
  }
}

TEST(MotionBound, TightForRotationsAndTranslations) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double angle = random.uniform(1e-6, 3);
    Motion<double> motion;
    motion.R0 = fcl::AngleAxisd(1, anyDirection(random)).toRotationMatrix();
    motion.R1 = fcl::AngleAxisd(angle, anyDirection(random)).toRotationMatrix() * motion.R0;
    motion.T0 = motion.T1 = fcl::Vector3d(1, 2, 3);
    const scene::Sphere centred = {{0, 0, 0}, 1};
    const double bound =
        scene::displacement<double>(motion.R0, motion.T0, motion.R1, motion.T1, centred);
    EXPECT_LE(bound, 1.19 * 2 * std::sin(angle / 2) * (1 + 1e-6));
    motion.R1 = motion.R0;
    motion.T1 = motion.T0 + 0.1 * anyDirection(random);
    EXPECT_LE(scene::displacement<double>(motion.R0, motion.T0, motion.R1, motion.T1, centred),
              0.1 * (1 + 1e-10));
  }
}

TEST(MotionBound, NothingMovedIsZeroAndNoNumberIsInfinite) {
  Motion<double> motion{fcl::Matrix3d::Identity(), fcl::Matrix3d::Identity(),
                        fcl::Vector3d(1e300, 0, -0.0), fcl::Vector3d(1e300, 0, 0.0)};
  const scene::Sphere sphere = {{1, 2, 3}, 4};
  const auto bound = [&] {
    return scene::displacement<double>(motion.R0, motion.T0, motion.R1, motion.T1, sphere);
  };
  EXPECT_EQ(bound(), 0);
  motion.T1[0] = -1e300;
  EXPECT_EQ(bound(), std::numeric_limits<double>::infinity());
  motion.T1[0] = std::nan("");
  EXPECT_EQ(bound(), std::numeric_limits<double>::infinity());
}

TEST(MotionBound, SumsRoundUp) {
  Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const double a = std::pow(10, random.uniform(-300, 300));
    const double b = (random.unit() < 0.5 ? -1 : 1) * std::pow(10, random.uniform(-300, 300));
    EXPECT_GE(static_cast<long double>(scene::addUp(a, b)),
              static_cast<long double>(a) + static_cast<long double>(b));
    EXPECT_GT(scene::addUp(a, 0), a);
  }
  EXPECT_GT(scene::addUp(0, 0), 0);
}

}  // namespace
}  // namespace kios::testing
