// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/ray_oracle.h"

#include <gtest/gtest.h>

#include <limits>

namespace kios::scenes {
namespace {

constexpr double kMax = std::numeric_limits<double>::max();
const std::array<Eigen::Vector3d, 3> kTriangle = {
    Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(4, 0, 1), Eigen::Vector3d(0, 4, 1)};

TEST(RayOracle, CrossesAFace) {
  const auto up = rationalRayHit({{1, 2, -1}, {0, 0, 4}, 0, kMax}, kTriangle);
  ASSERT_TRUE(up);
  EXPECT_EQ(up->t, 0.5L);
  EXPECT_TRUE(up->crosses);
  EXPECT_TRUE(up->along_normal);
  EXPECT_EQ(up->weights[0], 0.25L);
  EXPECT_EQ(up->weights[1], 0.25L);
  EXPECT_EQ(up->weights[2], 0.5L);
  const auto third = rationalRayHit({{1, 1, 0}, {0, 0, 3}, 0, kMax}, kTriangle);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->t, 1.0L / 3);
  EXPECT_FALSE(rationalRayHit({{1, 2, -1}, {0, 0, -4}, 0, kMax}, kTriangle));
  EXPECT_FALSE(rationalRayHit({{1, 2, 3}, {0, 0, 4}, 0, kMax}, kTriangle));
  EXPECT_FALSE(rationalRayHit({{1, 2, 3}, {0, 0, -4}, 0, kMax}, kTriangle)->along_normal);
}

TEST(RayOracle, IsClosed) {
  const Eigen::Vector3d up(0, 0, 1);
  const double beyond = std::nextafter(2.0, 3.0);
  EXPECT_TRUE(rationalRayHit({{2, 2, 0}, up, 0, kMax}, kTriangle));
  EXPECT_FALSE(rationalRayHit({{2, beyond, 0}, up, 0, kMax}, kTriangle));
  EXPECT_TRUE(rationalRayHit({{4, 0, 0}, up, 0, kMax}, kTriangle));
  EXPECT_TRUE(rationalRayHit({{1, 1, 0}, up, 1, 1}, kTriangle));
  EXPECT_FALSE(rationalRayHit({{1, 1, 0}, up, std::nextafter(1.0, 2.0), kMax}, kTriangle));
  EXPECT_FALSE(rationalRayHit({{1, 1, 0}, up, 0, std::nextafter(1.0, 0.0)}, kTriangle));
}

TEST(RayOracle, InThePlane) {
  const auto in = rationalRayHit({{-1, 1, 1}, {1, 0, 0}, 0, kMax}, kTriangle);
  ASSERT_TRUE(in);
  EXPECT_FALSE(in->crosses);
  EXPECT_EQ(in->t, 1);
  EXPECT_EQ(rationalRayHit({{-1, 1, 1}, {1, 0, 0}, 2, kMax}, kTriangle)->t, 2);
  EXPECT_EQ(rationalRayHit({{-1, 1, 1}, {1, 0, 0}, 4, kMax}, kTriangle)->t, 4);
  EXPECT_FALSE(rationalRayHit({{-1, 1, 1}, {1, 0, 0}, 4.5, kMax}, kTriangle));
  EXPECT_EQ(rationalRayHit({{6, 0, 1}, {-1, 0, 0}, 0, kMax}, kTriangle)->t, 2);  // along an edge
  EXPECT_EQ(rationalRayHit({{-2, 6, 1}, {1, -1, 0}, 0, kMax}, kTriangle)->t, 2);
  EXPECT_FALSE(rationalRayHit({{-1, 1, 2}, {1, 0, 0}, 0, kMax}, kTriangle));
}

TEST(RayOracle, SegmentsAndPoints) {
  const Eigen::Vector3d p(1, 0, 0), q(3, 0, 0), m(2, 0, 0);
  EXPECT_EQ(rationalRayHit({{2, -1, 0}, {0, 0.5, 0}, 0, kMax}, {p, m, q})->t, 2);
  EXPECT_EQ(rationalRayHit({{2, -1, 0}, {0, 0.5, 0}, 0, kMax}, {p, q, m})->t, 2);
  EXPECT_FALSE(rationalRayHit({{4, -1, 0}, {0, 0.5, 0}, 0, kMax}, {p, q, m}));
  EXPECT_FALSE(rationalRayHit({{2, -1, 1e-300}, {0, 0.5, 0}, 0, kMax}, {p, q, m}));
  EXPECT_EQ(rationalRayHit({{5, 0, 0}, {-1, 0, 0}, 0, kMax}, {p, m, q})->t, 2);
  EXPECT_EQ(rationalRayHit({{2.5, 0, 0}, {-1, 0, 0}, 0, kMax}, {p, m, q})->t, 0);
  EXPECT_EQ(rationalRayHit({{5, 0, 0}, {-1, 0, 0}, 0, kMax}, {m, m, m})->t, 3);
  EXPECT_FALSE(rationalRayHit({{5, 1e-300, 0}, {-1, 0, 0}, 0, kMax}, {m, m, m}));
}

}  // namespace
}  // namespace kios::scenes
