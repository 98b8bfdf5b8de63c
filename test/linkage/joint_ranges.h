// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <vector>

#include "linkage/robot_cases.h"

// What tests of least clearances over ranges of joints share.

namespace kios::testing {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline Joints joints(std::initializer_list<double> values) {
  Joints q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

inline RangeRequest fine(double abs_err = 1e-4, double rel_err = 0) {
  RangeRequest request;
  request.abs_err = abs_err;
  request.rel_err = rel_err;
  return request;
}

inline Joints placeOf(const RangeResult& result) {
  return Eigen::Map<const Joints>(result.at.data(), static_cast<Eigen::Index>(result.at.size()));
}

/// The distance that FCL's static query finds, of the pair that is named.
inline double distanceOf(const RobotCase& robot, int a, int b, const std::vector<Transform3d>& X) {
  fcl::DistanceResultd result;
  return std::max(
      0.0, fcl::distance(robot.bodies[a].geometry.get(), X[a], robot.bodies[b].geometry.get(), X[b],
                         fcl::DistanceRequestd(), result));
}

/// A bracket that is as narrow as asked, holds `least`, and names where it was seen.
inline void expectLeast(const RobotCase& robot, const RangeResult& result, double least,
                        double width, double rounding = 1e-12) {
  EXPECT_TRUE(result.complete);
  EXPECT_LE(result.lower, least + rounding);
  EXPECT_GE(result.upper, least - rounding);
  EXPECT_LE(result.upper - result.lower, width * (1 + 1e-9));
  ASSERT_EQ(static_cast<int>(result.at.size()), robot.linkage.coordinates());
  ASSERT_LT(result.body_a, result.body_b);
  const double there =
      distanceOf(robot, result.body_a, result.body_b, robot.poses(placeOf(result)));
  EXPECT_LE(there, result.upper + 1e-8);
  EXPECT_GE(there, result.upper - width - 1e-8);
  EXPECT_NEAR((result.point_a - result.point_b).norm(), result.upper, 1e-7);
}

}  // namespace kios::testing
