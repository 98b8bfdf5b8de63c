// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Volumes that no fit would make: nested, identical, nearly coincident and tangent spheres, lenses
// without thickness, points; and the distance of points.
#include <gtest/gtest.h>

#include <initializer_list>

#include "clearance/interior_point.h"
#include "fcl_kios/clearance.h"
#include "volume/assemble.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

struct Cap {
  float x, y, z, r;
};

kIOSd volume(const fcl::Vector3d& center, double radius, std::initializer_list<Cap> caps) {
  kIOSd v;
  v.center0 = center;
  v.radius0 = radius;
  int i = 0;
  for (const Cap& cap : caps) {
    v.cap_x[i] = cap.x;
    v.cap_y[i] = cap.y;
    v.cap_z[i] = cap.z;
    v.cap_r[i++] = cap.r;
  }
  completeCaps(v, 1 + static_cast<int>(caps.size()));
  return v;
}

RelativePose<double> shifted(const fcl::Vector3d& T) { return {fcl::Matrix3d::Identity(), T}; }

TEST(ExactDegenerate, PointsAndBalls) {
  const kIOSd point = volume({0, 0, 0}, 0, {}), ball = volume({0, 0, 0}, 1, {});
  EXPECT_NEAR(exactDistance(point, point, shifted({3, 4, 0})).distance, 5, 1e-13);
  EXPECT_EQ(exactDistance(point, point).distance, 0);
  EXPECT_NEAR(exactDistance(point, ball, shifted({3, 4, 0})).distance, 4, 1e-13);
  EXPECT_NEAR(exactDistance(ball, ball, shifted({3, 4, 0})).distance, 3, 1e-13);
  EXPECT_EQ(exactDistance(ball, point, shifted({0.5, 0, 0})).distance, 0);
  const ExactDistance touching = exactDistance(ball, ball, shifted({2, 0, 0}));
  EXPECT_EQ(touching.distance, 0);
  EXPECT_LE(touching.error, 1e-13);
  EXPECT_LE((touching.p - fcl::Vector3d::UnitX()).norm(), 1e-7);
}

// Caps that cut nothing off, and copies of S0, change nothing.
TEST(ExactDegenerate, NestedAndIdenticalSpheres) {
  Random random(21);
  const kIOSd ball = volume({1, 2, 3}, 1, {});
  const kIOSd others[] = {
      volume({1, 2, 3}, 1, {{0, 0, 0, 1}, {0, 0, 0, 1}}),
      volume({1, 2, 3}, 1, {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}),
      volume({1, 2, 3}, 1, {{0, 0, 0.5F, 1.5F}, {0, 0, -0.5F, 1.5F}}),  // tangent inside
      volume({1, 2, 3}, 1, {{0, 0, 3, 4}, {0, 0, -3, 4}, {0, 2, 0, 3}, {0, -2, 0, 3}}),
      volume({1, 2, 3}, 1, {{0, 0, 0.5F, 2}, {1, 0, 0, 9}, {0, 0, 0, 1e6F}, {0, 0, 0, 1e18F}}),
      // S0 is the outer one
      volume({1, 2, 3}, 1e6, {{0, 0, 0, 1}, {0, 0, 0, 1}}),
  };
  for (int i = 0; i < 300; ++i) {
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d T = random.uniform(0, 12) * randomDirection(random);
    const RelativePose<double> X(R, T);
    const ExactDistance expected = exactDistance(ball, ball, X);
    for (const kIOSd& a : others) {
      for (const kIOSd& b : others) {
        // 2^-53 of the largest radius that matters; a cap of 1e18 is as good as none.
        const bool giant = a.cap_r[3] > 1e9F || b.cap_r[3] > 1e9F || a.radius0 > 2 || b.radius0 > 2;
        const ExactDistance exact = exactDistance(a, b, X);
        ASSERT_LE(exact.distance, expected.distance + 1e-13);
        if (!giant) {
          ASSERT_NEAR(exact.distance, expected.distance, 1e-12) << i;
        }
        ASSERT_GE(exact.distance + exact.error, expected.distance * (1 - 1e-15)) << i;
      }
    }
  }
}

// Caps whose centres differ from S0's by 1e-1 to 1e-15 and whose radii differ as little: circles
// of which nobody can say where they are, between spheres of which everybody can.
TEST(ExactDegenerate, NearlyCoincidentSpheres) {
  Random random(22);
  int apart = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto draw = [&random] {
      const double by = std::pow(10.0, -random.uniform(1, 15));
      const auto u = [&] { return static_cast<float>(by * random.uniform(-1, 1)); };
      // Every sphere holds the ball of 1 - 4 by around the origin.
      const auto r = [&] { return 1 - (random.unit() < 0.3 ? 0 : u()); };
      return volume(
          {0, 0, 0}, 1,
          {{u(), u(), u(), r()}, {u(), u(), u(), r()}, {u(), u(), u(), r()}, {u(), u(), u(), r()}});
    };
    const kIOSd a = draw(), b = draw();
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d T = random.uniform(1.8, 4) * randomDirection(random);
    const ExactDistance exact = exactDistance(a, b, RelativePose<double>(R, T));
    const StoredBalls stored_a(a), stored_b(b);
    const Bracket truth = interiorPointDistance(stored_a, stored_b, R.cast<Real>(), T.cast<Real>(),
                                                Real3::Zero(), Real3::Zero());
    ASSERT_LE(exact.distance, truth.upper) << i;
    ASSERT_GE(exact.distance, truth.lower - 1e-12L) << i;
    ASSERT_LE(exact.error, 1e-12) << i;
    apart += exact.apart();
  }
  EXPECT_GT(apart, 1'000);
}

// Two caps that touch leave one point: nothing about it is known better than to the square root
// of a rounding, and that much is promised.
TEST(ExactDegenerate, LensWithoutThickness) {
  Random random(23);
  const kIOSd lens = volume({0, 0, 0}, 1, {{0, 0, 2, 2}, {0, 0, -2, 2}});
  const kIOSd crossed =
      volume({0, 0, 0}, 1, {{0, 0, 2, 2}, {0, 0, -2, 2}, {0, 3, 0, 3}, {0, -3, 0, 3}});
  for (int i = 0; i < 2'000; ++i) {
    const fcl::Matrix3d R = randomRotation(random);
    const double gap = std::pow(10.0, random.uniform(-7, 1));
    const RelativePose<double> X(R, gap * randomDirection(random));
    for (const kIOSd* a : {&lens, &crossed}) {
      for (const kIOSd* b : {&lens, &crossed}) {
        const ExactDistance exact = exactDistance(*a, *b, X);
        ASSERT_LE(exact.distance, gap) << i;
        ASSERT_GE(exact.distance, gap - (a == &crossed || b == &crossed ? 1e-3 : 1e-6)) << i;
        ASSERT_LE((exact.q - exact.p).norm(), gap + 1e-6) << i;
        if (a == &lens && b == &lens) {
          ASSERT_LE(exact.error, 1e-6) << i;
        }
      }
    }
  }
  // At its thinnest in floats, against a flat neighbour, with the barrier as the judge.
  for (int i = 0; i < 500; ++i) {
    const float r = 2 + static_cast<float>(std::pow(2.0, -random.uniform(2, 21)));
    const kIOSd thin = volume({0, 0, 0}, 1, {{0, 0, 2, r}, {0, 0, -2, r}});
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d T = random.uniform(0.5, 3) * randomDirection(random);
    const ExactDistance exact = exactDistance(thin, thin, RelativePose<double>(R, T));
    const StoredBalls stored(thin);
    const Bracket truth = interiorPointDistance(stored, stored, R.cast<Real>(), T.cast<Real>(),
                                                Real3::Zero(), Real3::Zero());
    ASSERT_LE(exact.distance, truth.upper) << i;
    ASSERT_GE(exact.distance, truth.lower - 1e-10L) << i;
    ASSERT_LE(exact.error, 1e-10) << i;
  }
}

TEST(ExactDegenerate, NearestPoint) {
  Random random(24);
  int outside = 0, inside = 0;
  for (int i = 0; i < 5'000; ++i) {
    const HardPair<double> pair(random);
    const double size = pair.a.radius0;
    if (size > 0 && size < 1e-290) continue;
    const fcl::Vector3d point =
        pair.a.center0 + size * std::pow(10.0, random.uniform(-3, 1)) * randomDirection(random);
    const ExactDistance nearest = nearestPoint(pair.a, point);
    const StoredBalls a(pair.a);
    const double pad = static_cast<double>(1e-14L * pair.magnitude()) + 1e-290;
    const auto at = [&a](const fcl::Vector3d& p) { return a.outside(p.cast<Real>() - a.center0); };
    ASSERT_EQ(nearest.q, point);
    ASSERT_EQ(nearest.moment.norm(), 0);
    ASSERT_LE(at(nearest.p), pad) << i;
    ASSERT_NEAR((point - nearest.p).norm(), nearest.distance, nearest.error + pad) << i;
    if (!(at(point) > 0)) {
      ASSERT_EQ(nearest.distance, 0) << i;
      ++inside;
    }
    if (!nearest.apart()) {
      ASSERT_EQ(nearest.p, point) << i;
      ASSERT_LE(at(point), 100 * pad) << i;
      continue;
    }
    ++outside;
    // No point of the content lies beyond the plane through p.
    for (const auto& c : pair.points_a) {
      ASSERT_LE(nearest.normal.dot(c - nearest.p), nearest.error + pad) << i;
    }
  }
  EXPECT_GT(outside, 1'000);
  EXPECT_GT(inside, 1'000);
}

TEST(ExactDegenerate, RefusesPointsThatAreNone) {
  const kIOSd ball = volume({0, 0, 0}, 1, {});
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 0x1p1001}) {
    EXPECT_THROW(nearestPoint(ball, fcl::Vector3d(0, bad, 0)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace kios::testing
