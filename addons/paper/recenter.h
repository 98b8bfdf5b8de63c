// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace kios {

/// Points that hold a ball in place; a good first guess for a ball nearby.
struct Support {
  int index[3];
  int size = 0;
};

/// Moves the two coordinates of `center` other than `height_axis` to where the farthest point is
/// nearest, to 1 %: a minimal ball with additive weights, solved on a core set of at most four
/// points, first those of `support` (in and out). Any centre is safe: radii are measured later.
void recenterInPlane(const Eigen::Matrix3Xd& points, int height_axis, Eigen::Vector3d& center,
                     Support& support);

/// The largest squared distance of a point from a centre, and the first point that has it.
double farthestSquare(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& center,
                      int* index = nullptr);

}  // namespace kios
