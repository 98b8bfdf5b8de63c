// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace kios::bench {

/// What a planner asks: is the straight path from q0, which is free, to q1 free?
using IsFreeEdge = std::function<bool(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1)>;

struct PlanRequest {
  Eigen::VectorXd start, goal, lower, upper;
  double range = 1;    ///< of an edge, in joint space
  double seconds = 2;  ///< of this thread's CPU time
  std::uint64_t seed = 1;
};

struct Plan {
  bool solved = false;
  double seconds = 0;  ///< of CPU time
  /// Edges that were called free.
  std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> free_edges;
};

/// RRT-Connect (Kuffner & LaValle 2000): two trees grow towards random configurations, and each
/// towards the other's newest one. The same seed draws the same configurations whatever isFree()
/// answers. Start and goal must be free.
Plan rrtConnect(const PlanRequest& request, const IsFreeEdge& is_free);

}  // namespace kios::bench
