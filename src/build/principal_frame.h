// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "build/point_lanes.h"

namespace kios {

/// Principal axes of a point set and the box along them.
struct PrincipalFrame {
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< columns: orthonormal axes
  float middle[3] = {};                                ///< box centre along each axis
  float half[3] = {};                                  ///< half extent along each axis
  std::array<int, 3> order = {0, 1, 2};                ///< axes by decreasing extent
};

/// The frame of `points` (relative to the first of them), by the covariance of the points (paper,
/// III-B.2), and the points in that frame relative to the box centre.
PrincipalFrame principalFrame(const PointLanes& points, PointLanes& in_frame);

/// Finds it by floats alone, in less time.
PrincipalFrame quickPrincipalFrame(const PointLanes& points, PointLanes& in_frame);

/// Orthonormal axes, the first along a, the second towards b, each rounded once: a box's slabs add
/// up only if its axes are so. Either may be 0 or not finite, or parallel to the other.
Eigen::Matrix3f axesAlong(const Eigen::Vector3f& a, const Eigen::Vector3f& b);

}  // namespace kios
