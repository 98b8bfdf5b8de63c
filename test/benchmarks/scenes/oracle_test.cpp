// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "scenes/motions.h"
#include "scenes/shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

ExactTriangle triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {a.cast<long double>(), b.cast<long double>(), c.cast<long double>()};
}

// Runs the pair through both orders and all 36 orders of corners; the answer must not depend on it.
void expectDistance(const ExactTriangle& a, const ExactTriangle& b, double expected) {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const auto& p : kOrders) {
    for (const auto& q : kOrders) {
      const ExactTriangle turned_a{a[p[0]], a[p[1]], a[p[2]]};
      const ExactTriangle turned_b{b[q[0]], b[q[1]], b[q[2]]};
      EXPECT_NEAR(triangleDistance(turned_a, turned_b), expected, 1e-18L);
      EXPECT_NEAR(triangleDistance(turned_b, turned_a), expected, 1e-18L);
      EXPECT_EQ(trianglesMeet(turned_a, turned_b), expected == 0);
      EXPECT_EQ(trianglesMeet(turned_b, turned_a), expected == 0);
    }
  }
}

const ExactTriangle kFloor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

TEST(TriangleOracle, FeaturePairs) {
  expectDistance(kFloor, triangle({1, 1, 2}, {1, 2, 5}, {2, 1, 5}), 2);      // vertex over face
  expectDistance(kFloor, triangle({-3, 0, 0}, {-5, 1, 1}, {-5, -1, 1}), 3);  // vertex to vertex
  expectDistance(kFloor, triangle({1, -2, 0}, {1, -5, 1}, {2, -5, -1}), 2);  // vertex to edge
  expectDistance(kFloor, triangle({2, -1, -1}, {2, -1, 1}, {2, -4, 0}), 1);  // edge to edge
  expectDistance(kFloor, triangle({1, 1, 3}, {2, 1, 3}, {1, 2, 3}), 3);      // parallel faces
  expectDistance(kFloor, triangle({0, -1, 0}, {4, -1, 0}, {2, -3, 0}), 1);   // parallel edges
}

TEST(TriangleOracle, Contacts) {
  expectDistance(kFloor, triangle({1, 1, -1}, {1, 1, 1}, {9, 9, 1}), 0);    // edge through face
  expectDistance(kFloor, triangle({1, 1, 0}, {1, 2, 5}, {2, 1, 5}), 0);     // vertex on face
  expectDistance(kFloor, triangle({0, 0, 0}, {-1, 0, 5}, {-1, -1, 5}), 0);  // shared vertex
  expectDistance(kFloor, triangle({4, 0, 0}, {0, 4, 0}, {4, 4, 0}), 0);     // shared edge, coplanar
  expectDistance(kFloor, triangle({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), 0);     // inside, coplanar
  expectDistance(kFloor, triangle({2, -1, 0}, {2, 9, 0}, {3, 9, 0}), 0);    // crossing, coplanar
  expectDistance(kFloor, triangle({1, 0, 0}, {2, 0, 0}, {1, 0, 5}), 0);     // edges overlap
  expectDistance(kFloor, triangle({1, -1, 0}, {1, 3, 0}, {1, 1, 5}), 0);    // edge within the plane
  expectDistance(kFloor, kFloor, 0);
}

TEST(TriangleOracle, DegenerateTriangles) {
  const ExactTriangle segment = triangle({1, 1, 2}, {1, 1, 5}, {1, 1, 3});
  const ExactTriangle point = triangle({1, 1, 2}, {1, 1, 2}, {1, 1, 2});
  expectDistance(kFloor, segment, 2);
  expectDistance(kFloor, point, 2);
  expectDistance(segment, point, 0);
  expectDistance(kFloor, triangle({1, 1, -2}, {1, 1, 5}, {1, 1, 3}), 0);
  expectDistance(kFloor, triangle({-1, 1, 0}, {7, 1, 0}, {5, 1, 0}), 0);     // across, coplanar
  expectDistance(kFloor, triangle({-1, -1, 0}, {7, -1, 0}, {5, -1, 0}), 1);  // beside, coplanar
  expectDistance(point, triangle({4, 5, 2}, {4, 5, 2}, {4, 5, 2}), 5);
}

TEST(TriangleOracle, SliverKeepsItsFace) {
  // The vertex projects into a face 2^-30 wide; the nearest edge is 2^-31 farther sideways.
  const double width = 0x1p-30;
  const ExactTriangle sliver = triangle({-8, 0, 0}, {8, 0, 0}, {0, width, 0});
  expectDistance(sliver, triangle({0, width / 4, 1}, {0, 1, 3}, {1, 1, 3}), 1);
}

TEST(TriangleOracle, CommonOffsetCostsNothing) {
  const Vector3d offset = Vector3d::Constant(0x1p40);
  const auto moved = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return triangle(a + offset, b + offset, c + offset);
  };
  expectDistance(moved({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), moved({1, 1, 2}, {1, 2, 5}, {2, 1, 5}), 2);
}

// Sampling can only find larger distances; a dense enough grid comes near the true one.
TEST(TriangleOracle, AgreesWithSampling) {
  constexpr int kSteps = 24;
  const Mesh soup = randomSoup(40, 1.0, 0.3, 3.0, 7);
  const auto corner = [&](int t, int i) { return soup.vertices[soup.triangles[t][i]]; };
  const auto sample = [&](int t, int i, int j) {
    const double s = static_cast<double>(i) / kSteps;
    const double r = static_cast<double>(j) / kSteps;
    return Vector3d((1 - s - r) * corner(t, 0) + s * corner(t, 1) + r * corner(t, 2));
  };
  for (int t = 0; t + 1 < 40; t += 2) {
    double sampled = 1e300;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        for (int k = 0; k <= kSteps; ++k) {
          for (int l = 0; k + l <= kSteps; ++l) {
            sampled = std::min(sampled, (sample(t, i, j) - sample(t + 1, k, l)).norm());
          }
        }
      }
    }
    const auto exact =
        triangleDistance(triangle(corner(t, 0), corner(t, 1), corner(t, 2)),
                         triangle(corner(t + 1, 0), corner(t + 1, 1), corner(t + 1, 2)));
    EXPECT_LE(exact, sampled + 1e-15);
    EXPECT_GE(exact, sampled - 2 * 6.0 / kSteps);
  }
}

void expectEqualsBruteForce(const Mesh& a, const Mesh& b, const std::vector<Frame>& frames) {
  const MeshOracle oracle(a, b);
  for (const auto& [X_WA, X_WB] : frames) {
    const double distance = oracle.distance(X_WA, X_WB);
    EXPECT_EQ(distance, oracle.distanceBruteForce(X_WA, X_WB));
    EXPECT_EQ(oracle.collide(X_WA, X_WB), oracle.collideBruteForce(X_WA, X_WB));
    EXPECT_EQ(oracle.collidingPairs(X_WA, X_WB), oracle.collidingPairsBruteForce(X_WA, X_WB));
    EXPECT_EQ(oracle.collide(X_WA, X_WB), distance == 0);
  }
}

std::vector<Frame> randomFrames(int count, double half_width, std::uint64_t seed) {
  const auto poses = randomPoses(2 * count, half_width, seed);
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) frames.push_back({poses[2 * i], poses[2 * i + 1]});
  return frames;
}

TEST(MeshOracle, EqualsBruteForceOnTori) {
  expectEqualsBruteForce(bumpyTorus(200), bumpyTorus(140), randomFrames(12, 1.2, 1));
}

TEST(MeshOracle, EqualsBruteForceOnSoups) {
  expectEqualsBruteForce(randomSoup(120, 1, 1e-2, 1, 3), randomSoup(90, 1, 1e-2, 2, 4),
                         randomFrames(12, 3, 2));
}

TEST(MeshOracle, EqualsBruteForceOnTouchingBoxes) {
  const Mesh box = subdividedBox({2, 2, 2}, 3);
  std::vector<Frame> frames;
  for (const double x : {1.0, 1.5, 2.0, 2.5}) {
    Frame frame{Transform3d::Identity(), Transform3d::Identity()};
    frame.X_WB.translation() = Vector3d(x, 0.25, 0);
    frames.push_back(frame);
  }
  expectEqualsBruteForce(box, box, frames);
  const MeshOracle oracle(box, box);
  EXPECT_TRUE(oracle.collide(frames[2].X_WA, frames[2].X_WB));
  EXPECT_EQ(oracle.distance(frames[3].X_WA, frames[3].X_WB), 0.5);
}

TEST(MeshOracle, CommonFrameIsTheFirstArguments) {
  // The matrices are taken as given, also where they are no rotation: R1 = 2 I doubles B in A's
  // frame.
  const Mesh point = singleTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  Frame frame{Transform3d::Identity(), Transform3d::Identity()};
  frame.X_WA.linear() *= 2;
  frame.X_WA.translation() = Vector3d(0x1p60, 0, 0);
  frame.X_WB.translation() = Vector3d(0x1p60, 3, 0);
  EXPECT_EQ(MeshOracle(point, point).distance(frame.X_WA, frame.X_WB), 6);
}

TEST(MeshOracle, RefusesAMeshWithoutTriangles) {
  EXPECT_THROW(MeshOracle(Mesh{}, icosphere(1, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace kios::scenes
