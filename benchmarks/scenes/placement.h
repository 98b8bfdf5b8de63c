// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/common/types.h>

// Short names for the poses of parts.

namespace kios::scenes {

inline constexpr double kPi = 3.14159265358979323846;

inline fcl::Transform3d shift(double x, double y, double z) {
  return fcl::Transform3d(Eigen::Translation3d(x, y, z));
}

/// Returns a turn about a unit axis, in radians.
inline fcl::Transform3d turn(double angle, const fcl::Vector3d& axis) {
  return fcl::Transform3d(fcl::AngleAxisd(angle, axis));
}

}  // namespace kios::scenes
