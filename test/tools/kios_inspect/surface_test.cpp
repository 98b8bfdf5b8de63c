// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fcl_kios/fit/fit.h"
#include "surface_check.h"

namespace kios::inspect {
namespace {

using Points = std::vector<fcl::Vector3d>;

/// Points in a box of these half extents, turned at random.
Points pointsIn(const fcl::Vector3d& half, int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal;
  const fcl::Quaterniond turn =
      fcl::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        turn * fcl::Vector3d(uniform(random), uniform(random), uniform(random)).cwiseProduct(half));
  }
  return points;
}

double sizeOf(const Points& points) {
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& p : points) box.extend(p);
  return box.diagonal().norm();
}

kIOSd fitted(const Points& points) {
  kIOSd volume;
  fit(points.data(), static_cast<int>(points.size()), volume);
  return volume;
}

/// In the frame of the points.
Polyhedron polyhedronOf(const kIOSd& volume, int subdivisions) {
  const Surface surface = triangulate(volume, subdivisions);
  Polyhedron result;
  for (const fcl::Vector3d& v : surface.vertices) result.vertices.push_back(v + volume.center0);
  for (const Surface::Face& face : surface.faces) result.triangles.push_back(face.corners);
  return result;
}

const fcl::Vector3d kHalves[] = {{1, 1, 1},     {1, 0.5, 0.2},   {1, 1, 0.01},    {1, 1, 0},
                                 {1, 0.1, 0.1}, {1, 1e-3, 1e-4}, {1, 1e-9, 1e-9}, {1, 0.3, 0.001}};

TEST(Surface, LiesOnAllSpheresAndContainsTheContent) {
  std::mt19937 random(1);
  double worst_uncovered = 0;
  for (const fcl::Vector3d& half : kHalves) {
    for (int i = 0; i < 40; ++i) {
      SCOPED_TRACE(testing::Message() << half.transpose() << ", number " << i);
      const Points points = pointsIn(half, 3 + i % 9, random);
      const kIOSd volume = fitted(points);
      const double size = sizeOf(points);
      const Polyhedron coarse = polyhedronOf(volume, 2), fine = polyhedronOf(volume, 4);
      expectClosed(fine);
      EXPECT_LT(worstExcess(fine, volume), 1e-12 * size);
      const double uncovered = worstUncovered(fine, points) / size;
      EXPECT_LT(uncovered, 0.01);
      EXPECT_LT(worstUncovered(coarse, points) / size, 0.03);
      worst_uncovered = std::max(worst_uncovered, uncovered);
    }
  }
  RecordProperty("worst_uncovered_at_4", std::to_string(worst_uncovered));
}

TEST(Surface, IsTheWholeBoundary) {
  // By volume, against points thrown at the box around: no part of the intersection is missed.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const fcl::Vector3d& half : {fcl::Vector3d(1, 1, 1), fcl::Vector3d(1, 0.5, 0.1),
                                    fcl::Vector3d(1, 1, 0), fcl::Vector3d(1, 0.05, 0.02)}) {
    const kIOSd volume = fitted(pointsIn(half, 12, random));
    const Polyhedron surface = polyhedronOf(volume, 5);
    double enclosed = 0;
    for (const auto& t : surface.triangles) {
      enclosed +=
          surface.vertices[t[0]].dot(surface.vertices[t[1]].cross(surface.vertices[t[2]])) / 6;
    }
    fcl::Vector3d lower, upper;
    volume.bounds(lower, upper);
    const fcl::Vector3d sizes = upper - lower;
    constexpr int kThrows = 400000;
    int inside = 0;
    for (int i = 0; i < kThrows; ++i) {
      const fcl::Vector3d p = lower + sizes.cwiseProduct(fcl::Vector3d(
                                          uniform(random), uniform(random), uniform(random)));
      if (volume.contain(p)) ++inside;
    }
    const double expected = sizes.prod() * inside / kThrows;
    EXPECT_NEAR(enclosed, expected, 0.015 * expected) << half.transpose();
  }
}

TEST(Surface, NoScaleOrOffsetMatters) {
  std::mt19937 random(3);
  const Points points = pointsIn({1, 0.4, 0.1}, 20, random);
  for (const double scale : {1e-100, 1e-30, 1e30, 1e100}) {
    Points scaled = points;
    for (fcl::Vector3d& p : scaled) p *= scale;
    const kIOSd volume = fitted(scaled);
    const Polyhedron surface = polyhedronOf(volume, 3);
    EXPECT_LT(worstExcess(surface, volume), 1e-12 * sizeOf(scaled)) << scale;
  }
  // Relative to S0, what is computed keeps its digits.
  Points far = points;
  for (fcl::Vector3d& p : far) p += fcl::Vector3d(1e9, -1e9, 1e9);
  const kIOSd volume = fitted(far);
  for (const fcl::Vector3d& v : triangulate(volume, 3).vertices) {
    for (const Ball& ball : ballsOf(volume)) {
      EXPECT_LT((v - ball.center).norm() - ball.radius, 1e-12);
    }
  }
  EXPECT_LT(worstUncovered(polyhedronOf(volume, 4), far), 0.01);
}

TEST(Surface, PointsAndEmptyVolumesHaveNone) {
  EXPECT_TRUE(triangulate(kIOSd(), 2).faces.empty());
  EXPECT_TRUE(triangulate(fitted({{1, 2, 3}}), 2).faces.empty());
}

TEST(Surface, OfMergedVolumes) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    Points points = pointsIn({1, 0.3, 0.1}, 8, random), more = pointsIn({0.2, 1, 0.3}, 8, random);
    for (fcl::Vector3d& p : more) p += fcl::Vector3d(1.5, 0, 0.3);
    const kIOSd volume = fitted(points) + fitted(more);
    points.insert(points.end(), more.begin(), more.end());
    const Polyhedron surface = polyhedronOf(volume, 4);
    expectClosed(surface);
    EXPECT_LT(worstExcess(surface, volume), 1e-12 * sizeOf(points));
    EXPECT_LT(worstUncovered(surface, points), 0.002 * sizeOf(points));
  }
}

}  // namespace
}  // namespace kios::inspect
