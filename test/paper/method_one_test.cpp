// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Method I as published (paper, III-B.1), the choice of k (III-C) and the shared radius (III-B,
// end).
#include <gtest/gtest.h>

#include <algorithm>

#include "fcl_kios/paper.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

FitOptions optionsOf(FitMethod method, SphereCount count, bool shared = false) {
  FitOptions options = method;
  options.count = count;
  options.shared_radius = shared;
  return options;
}

/// Returns points whose smallest enclosing ellipsoid has the semi-axes `half` along the columns of
/// R: the six poles and random points of its surface.
Points<double> ellipsoidPoints(Random& random, const fcl::Vector3d& half, const fcl::Matrix3d& R,
                               const fcl::Vector3d& center) {
  Points<double> points;
  for (int i = 0; i < 60; ++i) {
    const fcl::Vector3d unit = i < 6 ? fcl::Vector3d((i % 2 ? 1 : -1) * fcl::Vector3d::Unit(i / 2))
                                     : randomDirection(random);
    points.push_back(center + R * half.cwiseProduct(unit));
  }
  return points;
}

TEST(MethodOne, PutsSpheresWhereThePaperDoes) {
  Random random(1);
  for (int set = 0; set < 1'000; ++set) {
    const fcl::Vector3d half(1, random.uniform(0.35, 0.62), random.uniform(0.05, 0.33));
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d center = 10 * randomDirection(random);
    const double scale = std::pow(10, random.uniform(-6, 6));
    auto points = ellipsoidPoints(random, half, R, center);
    for (fcl::Vector3d& p : points) p *= scale;
    const kIOSd v = fitted(points, FitMethod::kMethodI);
    ASSERT_EQ(v.k(), 5);
    // The volume of the ellipsoid is within 0.15 %, an axis within a few per mille.
    const double tolerance = 0.02 * scale;
    ASSERT_LT((v.center0 - scale * center).norm(), tolerance);
    ASSERT_NEAR(v.radius0, scale, tolerance);  // r0 = a here: not < a, as equation 1 has it
    const double r1 = scale / half[2];         // a^2 / c
    for (int i = 0; i < 4; ++i) {
      const int axis = i < 2 ? 2 : 1;
      const fcl::Vector3d along = R.col(axis) * (r1 - scale * half[axis]);
      const fcl::Vector3d o = capOffset(v, i);
      ASSERT_LT(std::min((o - along).norm(), (o + along).norm()), 0.05 * r1) << "set " << set;
      // Measured: at most the radius that encloses the ellipsoid, and no less than the pole's.
      ASSERT_LE(capRadius(v, i), r1 * 1.02) << "set " << set;
      ASSERT_GE(capRadius(v, i), (o.norm() + scale * half[axis]) * 0.999) << "set " << set;
    }
    ASSERT_LT(capOffset(v, 0).normalized().dot(capOffset(v, 1).normalized()), -0.999);
    ASSERT_LT(capOffset(v, 2).normalized().dot(capOffset(v, 3).normalized()), -0.999);
  }
}

// c = 0 would make the spheres infinite.
TEST(MethodOne, FlatContentHasFiniteSpheresThatCutItOff) {
  Random random(2);
  for (int set = 0; set < 300; ++set) {
    const auto points = place<double>(
        random, shapePoints(random, set % 2 ? PointShape::kCoplanar : PointShape::kTriangle, 12),
        set % 3, 1e3);
    const kIOSd v = fitted(points, FitMethod::kMethodI);
    if (v.k() == 1) continue;
    for (int i = 0; i < v.k() - 1; ++i) {
      EXPECT_LE(capRadius(v, i), 300 * v.radius0);
      EXPECT_GE(capRadius(v, i), v.radius0);
    }
    // Between the first two caps the content's plane and next to nothing else.
    const double thickness =
        capRadius(v, 0) + capRadius(v, 1) - (capOffset(v, 0) - capOffset(v, 1)).norm();
    EXPECT_GE(thickness, 0);
    EXPECT_LT(thickness, 0.01 * v.radius0);
  }
}

// The limit moves no sphere of an ellipsoid that isn't flatter.
TEST(MethodOne, AtAnAngleIsMethodOneUnlessFlat) {
  Random random(6);
  for (int set = 0; set < 200; ++set) {
    const fcl::Vector3d half(1, 0.6, random.uniform(0.52, 0.6));
    const auto points = ellipsoidPoints(random, half, randomRotation(random), {0, 0, 0});
    ASSERT_TRUE(bitwiseEqual(fitted(points, FitMethod::kMethodI),
                             fitted(points, FitMethod::kMethodIAtAngle)));
    const auto flat = ellipsoidPoints(random, {1, 0.6, 0.1}, randomRotation(random), {0, 0, 0});
    const kIOSd v = fitted(flat, FitMethod::kMethodIAtAngle);
    ASSERT_NEAR(capOffset(v, 0).norm(), 2 - 0.5, 0.05);  // r1 = 2 a, c = a/2
  }
}

TEST(FitOptions, KIsChosenAsAsked) {
  Random random(3);
  // Half extents, and k of the published methods by ratio.
  const struct {
    fcl::Vector3d half;
    int k;
  } cases[] = {{{1, 0.9, 0.8}, 1}, {{1, 0.8, 0.5}, 3}, {{1, 0.5, 0.4}, 5}, {{1, 0.3, 0.01}, 5}};
  for (const auto& box : cases) {
    const auto points = ellipsoidPoints(random, box.half, randomRotation(random), {0, 0, 0});
    for (const auto method : {FitMethod::kTuned, FitMethod::kMethodI, FitMethod::kMethodIAtAngle,
                              FitMethod::kMethodII}) {
      EXPECT_EQ(fitted(points, optionsOf(method, SphereCount::kAll)).k(), 5);
      // A pair that takes a tenth off S0 is kept; the published radii are large enough for that.
      const int k = fitted(points, optionsOf(method, SphereCount::kByGain)).k();
      EXPECT_TRUE(k == 1 || k == 3 || k == 5) << k;
      if (box.half[2] < 0.1) {
        EXPECT_EQ(k, 5) << static_cast<int>(method);
      }
    }
    EXPECT_EQ(fitted(points, FitMethod::kMethodI).k(), box.k) << box.half.transpose();
  }
  // A ball's caps gain nothing.
  const auto ball = ellipsoidPoints(random, {1, 1, 1}, fcl::Matrix3d::Identity(), {0, 0, 0});
  for (const auto method : {FitMethod::kTuned, FitMethod::kMethodI, FitMethod::kMethodII}) {
    EXPECT_EQ(fitted(ball, optionsOf(method, SphereCount::kByGain)).k(), 1);
  }
  const Points<double> point(3, fcl::Vector3d(1, 2, 3));
  for (const auto count : {SphereCount::kByRatio, SphereCount::kAll, SphereCount::kByGain}) {
    EXPECT_EQ(fitted(point, optionsOf(FitMethod::kMethodI, count)).k(), 1);
  }
}

/// Returns the distance of S0's centre to the far side of cap i.
double farSide(const kIOSd& v, int i) { return capRadius(v, i) - capOffset(v, i).norm(); }

TEST(FitOptions, SharedRadiusIsTheLargestAndStillTouches) {
  Random random(4);
  int larger = 0;
  for (int set = 0; set < 500; ++set) {
    const auto points = place<double>(random, shapePoints(random, PointShape::kRandom, 30), 1, 1);
    for (const auto method : {FitMethod::kTuned, FitMethod::kMethodI, FitMethod::kMethodII}) {
      const kIOSd own = fitted(points, optionsOf(method, SphereCount::kAll));
      const kIOSd shared = fitted(points, optionsOf(method, SphereCount::kAll, true));
      double largest = 0;
      for (int i = 0; i < 4; ++i) largest = std::max(largest, capRadius(own, i));
      for (int i = 0; i < 4; ++i) {
        ASSERT_EQ(shared.cap_r[i], shared.cap_r[0]);
        ASSERT_NEAR(capRadius(shared, i), largest, 1e-4 * largest);
        larger += capRadius(shared, i) > 1.01 * capRadius(own, i);
        // Moved along the axis by what it gained, and so ends where it did.
        const double gained = capRadius(shared, i) - capRadius(own, i);
        const fcl::Vector3d way = capOffset(shared, i) - capOffset(own, i);
        ASSERT_NEAR(way.norm(), gained, 1e-4 * largest) << "set " << set;
        // Near a cube a published centre may lie on the wrong side of S0's.
        const fcl::Vector3d axis = capOffset(own, i) - capOffset(own, i ^ 1);
        if (fitted(points, method).k() == 5) {
          ASSERT_GE(way.dot(axis.normalized()), 0.9 * gained - 1e-4 * largest) << "set " << set;
        }
      }
    }
  }
  EXPECT_GT(larger, 500);
}

TEST(FitOptions, ASmallerAngleGivesLargerAndFlatterCaps) {
  Random random(5);
  for (int set = 0; set < 200; ++set) {
    const auto points = ellipsoidPoints(random, {1, 0.6, 0.03}, randomRotation(random), {0, 0, 0});
    for (const auto method :
         {FitMethod::kTuned, FitMethod::kMethodIAtAngle, FitMethod::kMethodII}) {
      double radius = 0, side = 1e9;
      for (const double angle : {1.0, FitOptions::kPublishedAngle, 0.2, 0.05}) {
        FitOptions options = optionsOf(method, SphereCount::kAll);
        options.angle = angle;
        const kIOSd v = fitted(points, options);
        ASSERT_GT(capRadius(v, 0), radius);
        ASSERT_LT(farSide(v, 0), side);
        radius = capRadius(v, 0);
        side = farSide(v, 0);
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
