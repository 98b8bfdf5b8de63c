// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "triangle/contract.h"

// Pairs whose answers are known by hand: distance, witness points, features, common points.

namespace kios::testing {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;
using Feature = TriangleFeature;

const Corners kFloor = {Eigen::Vector3d(0, 0, 0), {4, 0, 0}, {0, 4, 0}};

/// Returns the vertices of t that the feature is made of, as a bit mask.
int verticesOf(Feature feature, const std::array<int, 3>& order) {
  const int f = static_cast<int>(feature);
  if (f < 3) return 1 << order[f];
  if (f < 6) return (1 << order[f - 3]) | (1 << order[(f - 2) % 3]);
  return 7;
}

constexpr int kV0 = 1, kV1 = 2, kV2 = 4, kFace = 7;

struct Expected {
  double distance;
  Eigen::Vector3d point_a, point_b;
  int vertices_a, vertices_b;  // of the features
};

// All 36 orders of the vertices and both orders of the triangles.
template <typename S>
void expectAnswer(const Corners& a, const Corners& b, const Expected& expected) {
  const double near = 4 * std::numeric_limits<S>::epsilon() *
                      static_cast<double>(scenes::extent(TrianglePair{a, b}));
  const auto ordered = [](const Corners& t, const std::array<int, 3>& order) {
    return TriangleVertices<S>{t[order[0]].cast<S>(), t[order[1]].cast<S>(), t[order[2]].cast<S>()};
  };
  for (const auto& p : kVertexOrders) {
    for (const auto& q : kVertexOrders) {
      for (const bool swap : {false, true}) {
        TriangleDistance<S> d = swap ? triangleDistance<S>(ordered(b, q), ordered(a, p))
                                     : triangleDistance<S>(ordered(a, p), ordered(b, q));
        if (swap) {
          std::swap(d.point_a, d.point_b);
          std::swap(d.feature_a, d.feature_b);
        }
        EXPECT_NEAR(d.distance, expected.distance, near);
        EXPECT_LE((d.point_a.template cast<double>() - expected.point_a).norm(), near);
        EXPECT_LE((d.point_b.template cast<double>() - expected.point_b).norm(), near);
        EXPECT_EQ(verticesOf(d.feature_a, p), expected.vertices_a);
        EXPECT_EQ(verticesOf(d.feature_b, q), expected.vertices_b);
      }
    }
  }
}

void expectBoth(const Corners& a, const Corners& b, const Expected& expected) {
  expectAnswer<double>(a, b, expected);
  expectAnswer<float>(a, b, expected);
}

TEST(TriangleDistance, FeaturePairs) {
  expectBoth(kFloor, {{{1, 1, 2}, {1, 2, 5}, {2, 1, 5}}}, {2, {1, 1, 0}, {1, 1, 2}, kFace, kV0});
  expectBoth(kFloor, {{{-3, -4, 0}, {-5, -9, 1}, {-5, -9, -1}}},
             {5, {0, 0, 0}, {-3, -4, 0}, kV0, kV0});
  expectBoth(kFloor, {{{1, -2, 0}, {1, -5, 1}, {2, -5, -1}}},
             {2, {1, 0, 0}, {1, -2, 0}, kV0 | kV1, kV0});
  expectBoth(kFloor, {{{2, -1, -1}, {2, -1, 1}, {2, -4, 0}}},
             {1, {2, 0, 0}, {2, -1, 0}, kV0 | kV1, kV0 | kV1});
  expectBoth(kFloor, {{{4, 4, -1}, {4, 4, 3}, {9, 9, 1}}},
             {std::sqrt(8.0), {2, 2, 0}, {4, 4, 0}, kV1 | kV2, kV0 | kV1});
}

TEST(TriangleDistance, SegmentsAndPoints) {
  const Corners segment = {Eigen::Vector3d(1, 1, 2), {1, 1, 5}, {1, 1, 2}};
  const TriangleDistance<double> d = triangleDistance(kFloor, segment);
  EXPECT_EQ(d.distance, 2);
  EXPECT_EQ(d.point_a, Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(d.point_b, Eigen::Vector3d(1, 1, 2));
  const Corners p = {Eigen::Vector3d(1, 2, 3), {1, 2, 3}, {1, 2, 3}};
  const Corners q = {Eigen::Vector3d(4, 6, 15), {4, 6, 15}, {4, 6, 15}};
  EXPECT_EQ(triangleDistance(p, q).distance, 13);
  EXPECT_EQ(triangleDistance(p, p).distance, 0);
  EXPECT_TRUE(trianglesIntersect(p, p));
  EXPECT_EQ(intersectionPoint(p, p), p[0]);
}

TEST(TriangleDistance, SharedVertexIsNamed) {
  const Corners b = {Eigen::Vector3d(9, 9, 9), {4, 0, 0}, {9, -9, 1}};
  const TriangleDistance<double> d = triangleDistance(kFloor, b);
  EXPECT_EQ(d.distance, 0);
  EXPECT_EQ(d.point_a, kFloor[1]);
  EXPECT_EQ(d.point_b, kFloor[1]);
  EXPECT_EQ(d.feature_a, Feature::kVertex1);
  EXPECT_EQ(d.feature_b, Feature::kVertex1);
}

TEST(TriangleDistance, OfCrossingTrianglesIsZeroAtACommonPoint) {
  const Corners b = {Eigen::Vector3d(1, 1, -1), {1, 1, 1}, {9, 9, 1}};
  const TriangleDistance<double> d = triangleDistance(kFloor, b);
  EXPECT_EQ(d.distance, 0);
  EXPECT_EQ(d.point_a, d.point_b);
  EXPECT_EQ(d.feature_a, Feature::kFace);
  EXPECT_EQ(d.feature_b, Feature::kFace);
}

TEST(IntersectionPoint, IsTheMiddle) {
  const auto expectPoint = [](const Corners& b, const Eigen::Vector3d& expected) {
    ASSERT_TRUE(trianglesIntersect(kFloor, b));
    EXPECT_LE((intersectionPoint(kFloor, b) - expected).norm(), 1e-14);
    EXPECT_LE((intersectionPoint(b, kFloor) - expected).norm(), 1e-14);
  };
  expectPoint({{{1, 1, -1}, {1, 1, 1}, {2, 1, 0}}}, {1.5, 1, 0});  // a segment of the face
  expectPoint({{{1, 1, 0}, {1, 2, 5}, {2, 1, 5}}}, {1, 1, 0});     // a vertex on it
  expectPoint({{{4, 0, 0}, {5, 0, 1}, {5, 1, 0}}}, {4, 0, 0});     // a shared vertex
  expectPoint({{{2, -3, -3}, {2, 3, 3}, {2, -3, 0}}}, {2, 0, 0});  // edge through edge
}

// The least positive number: a distance that rounds to 0 is not 0.
TEST(TriangleDistance, IsNeverRoundedToZero) {
  const double least = std::numeric_limits<double>::denorm_min();
  const Corners above = {Eigen::Vector3d(1, 1, least), {1, 2, 1}, {2, 1, 1}};
  EXPECT_EQ(triangleDistance(kFloor, above).distance, least);
  // A vertex at a fraction of the least double from an edge.
  const Corners lattice = {Eigen::Vector3d(0, 0, 0), {3 * least, least, 0}, {0, 0, -least}};
  const Corners point = {
      Eigen::Vector3d(2 * least, least, 0), {2 * least, least, 0}, {2 * least, least, 0}};
  EXPECT_GT(triangleDistance(lattice, point).distance, 0);
  EXPECT_FALSE(trianglesIntersect(lattice, point));
}

}  // namespace
}  // namespace kios::testing
