// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tightness.h"

#include <gtest/gtest.h>

#include <random>

#include "fcl_kios/clearance.h"
#include "fcl_kios/paper.h"

namespace kios::inspect {
namespace {

using Points = std::vector<fcl::Vector3d>;

fcl::Vector3d directionOf(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return fcl::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

/// Returns points in a box of these half extents, turned at random.
Points pointsIn(const fcl::Vector3d& half, int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto turn = fcl::Quaterniond::FromTwoVectors(directionOf(random), directionOf(random));
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        turn * fcl::Vector3d(uniform(random), uniform(random), uniform(random)).cwiseProduct(half));
  }
  return points;
}

kIOSd fitted(const Points& points) {
  kIOSd volume;
  fit(points.data(), static_cast<int>(points.size()), volume);
  return volume;
}

const fcl::Vector3d kHalves[] = {{1, 1, 1},     {1, 0.5, 0.2},   {1, 1, 0.01},    {1, 1, 0},
                                 {1, 0.1, 0.1}, {1, 1e-3, 1e-4}, {1, 1e-9, 1e-9}, {1, 0.3, 0.001}};

/// Returns how far x sticks out of the sphere of the volume that it violates most.
double excess(const kIOSd& volume, const fcl::Vector3d& x) {
  double worst = -HUGE_VAL;
  for (int i = 0; i < volume.k(); ++i) {
    worst = std::max(worst, (x - volume.sphereCenter(i)).norm() - volume.sphereRadius(i));
  }
  return worst;
}

// Between the height of a point of the volume, and that of a plane in which none is.
TEST(Support, IsTheHeightOfTheVolume) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const fcl::Vector3d& half : kHalves) {
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(testing::Message() << half.transpose() << ", number " << i);
      Points points = pointsIn(half, 3 + i % 9, random);
      kIOSd volume = fitted(points);
      if (i % 3 == 0) {  // merged volumes are less regular
        volume = volume + fitted(pointsIn(half.reverse(), 5, random));
      }
      const double r = volume.radius0;
      const fcl::Vector3d n = directionOf(random), center = volume.center0;
      const double h = support(volume, n);
      const fcl::Vector3d p = nearestPoint(volume, fcl::Vector3d(center + 1e3 * r * n)).p;
      EXPECT_LT(excess(volume, p), 1e-7 * r);
      EXPECT_LT(n.dot(p - center), h + 2e-5 * r);
      EXPECT_GT(n.dot(p - center), h - 1e-3 * r);
      for (const fcl::Vector3d& q : points) EXPECT_LT(n.dot(q - center), h + 2e-5 * r);
      for (int throws = 0; throws < 2000; ++throws) {
        fcl::Vector3d q(uniform(random), uniform(random), uniform(random));
        q = p + std::pow(10, 4 * uniform(random) - 4) * r * q;
        q += (h + 2e-5 * r - n.dot(q - center)) * n;
        ASSERT_GT(excess(volume, q), 0) << "a point above the support";
      }
    }
  }
}

TEST(Support, OfASphereIsItsRadius) {
  std::mt19937 random(2);
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    FitOptions one_sphere = FitMethod::kMethodII;  // of a ball's points: k = 1 by ratio
    Points points;
    for (int i = 0; i < 400; ++i) points.push_back(scale * directionOf(random));
    kIOSd volume;
    fit(points.data(), 400, volume, one_sphere);
    ASSERT_EQ(volume.k(), 1);
    EXPECT_NEAR(support(volume, directionOf(random)), volume.radius0, 1e-5 * volume.radius0);
  }
}

// Relative to S0, so that an offset costs no digits.
TEST(Support, NoOffsetMatters) {
  std::mt19937 random(3);
  kIOSd volume = fitted(pointsIn({1, 0.4, 0.1}, 20, random));
  const fcl::Vector3d n = directionOf(random);
  const double h = support(volume, n);
  volume.center0 += fcl::Vector3d(1e9, -1e9, 1e9);
  EXPECT_EQ(support(volume, n), h);
}

}  // namespace
}  // namespace kios::inspect
