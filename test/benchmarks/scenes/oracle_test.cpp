// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/rational_oracle.h"
#include "scenes/shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

// Two judges that share no formula. The kernels, a third, are compared with rationals, and queries
// of meshes with MeshOracle, in their own tests.
void expectExact(const TrianglePair& pair, long double rounding = 1e-18L) {
  ExactTriangle a, b;
  for (int i = 0; i < 3; ++i) {
    a[i] = pair.a[i].cast<long double>();
    b[i] = pair.b[i].cast<long double>();
  }
  const RationalDistance exact = rationalDistance(pair);
  EXPECT_LE(std::abs(triangleDistance(a, b) - exact.distance), rounding);
  EXPECT_LE(std::abs(triangleDistance(b, a) - exact.distance), rounding);
  EXPECT_EQ(trianglesMeet(a, b), exact.intersect);
  EXPECT_EQ(trianglesMeet(b, a), exact.intersect);
}

// In general position, and on tiny lattices, where every degenerate configuration occurs.
TEST(TriangleOracle, AgreesWithRationals) {
  Random random(5);
  for (int i = 0; i < 4000 && !HasFailure(); ++i) {
    TrianglePair pair;
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vector3d& p : *corners) {
        for (double& x : p) {
          x = i % 4 == 0 ? random.uniform(-1, 1) : std::floor(random.uniform(0, 2.5));
        }
      }
    }
    expectExact(pair, i % 4 == 0 ? 1e-16L : 1e-18L);
  }
}

// The vertex projects into a face 2^-30 wide; the nearest edge is 2^-31 farther sideways. And a
// common offset costs nothing.
TEST(TriangleOracle, SliversKeepTheirFaceAndOffsetsCostNothing) {
  const double width = 0x1p-30;
  expectExact({{Vector3d(-8, 0, 0), {8, 0, 0}, {0, width, 0}},
               {Vector3d(0, width / 4, 1), {0, 1, 3}, {1, 1, 3}}});
  const Vector3d o = Vector3d::Constant(0x1p40);
  expectExact({{o, o + Vector3d(4, 0, 0), o + Vector3d(0, 4, 0)},
               {o + Vector3d(1, 1, 2), o + Vector3d(1, 2, 5), o + Vector3d(2, 1, 5)}});
}

TEST(RationalOracle, AllScales) {
  const std::array<Vector3d, 3> floor = {Vector3d(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
  for (const double unit : {0x1p-1074, 0x1p-1000, 0x1p-500, 1.0, 0x1p500, 0x1p1000}) {
    TrianglePair pair = {floor, {Vector3d(1, 1, 2), {1, 2, 5}, {2, 1, 5}}};
    for (auto* corners : {&pair.a, &pair.b}) {
      for (Vector3d& p : *corners) p *= unit;
    }
    EXPECT_EQ(rationalDistance(pair).distance, 2 * static_cast<long double>(unit));
    EXPECT_EQ(rationalDistance(pair.b[0], pair.a), 2 * static_cast<long double>(unit));
  }
  // A gap of the least double over a face of size 1.
  const double least = 0x1p-1074;
  const TrianglePair above = {floor, {Vector3d(1, 1, least), {1, 2, 1}, {2, 1, 1}}};
  EXPECT_EQ(rationalDistance(above).distance, least);
  EXPECT_FALSE(rationalDistance(above).intersect);
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
