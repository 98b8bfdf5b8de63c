// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkage/body_queries.h"

namespace kios::articulated {

/// A line, or a point, about which two bodies turn along a path, in the world at a configuration.
///
/// Fasten a copy of it to either body there. All along the path the distance of a body's point from
/// its own copy stays what it is, and so does its height along a line. From a configuration q to q'
/// a point c that is fastened to a body moves by at most sum_i |q_i' - q_i| rho_i(c), rho_i its
/// distance from axis i at q (the derivation in linkage/configuration.h), seen from what carries
/// both bodies. So the two copies come apart by at most the sum over the joints of both, which is
/// next to nothing where the axes meet in the point, or lie in the line. A slide along the line
/// leaves the line what it is, but not the heights.
struct Pivot {
  Eigen::Vector3d point;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< of length 1; zero if this is a point
  /// The distances from both copies, of a point that lies in one of the bodies, differ by at most
  /// so much; and the heights above them.
  double slack = 0, height_slack = 0;

  bool isLine() const { return !axis.isZero(0); }
};

/// Returns the pivots of least slack: of a line and of a point, one each at most. None if no joint
/// turns the bodies about each other, or the slack is as large as one of them.
std::vector<Pivot> pivotsOf(const Path& path, const Pair& pair, const Configuration& at);

}  // namespace kios::articulated
