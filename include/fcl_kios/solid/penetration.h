// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "fcl_kios/model/model.h"
#include "fcl_kios/search/counts.h"

namespace kios {

/// Options of penetration().
struct PenetrationOptions {
  /// Ends the search, for a shorter way out and a higher lower bound, once upper <= (1 + rel_gap)
  /// lower. >= 0.
  double rel_gap = 0.04;
  /// Ends the search after so many tests of a translation. It finds one in any case. >= 0.
  int max_tests = 48;
  /// If given, the work is added to it.
  SearchCounts* counts = nullptr;
};

/// Brackets the length of the shortest translation that parts two solids.
struct Penetration {
  double lower = 0;  ///< no shorter translation than this parts the interiors: proven
  double upper = 0;  ///< |translation|
  /// Moves solid 2, in the world: after it the surfaces are apart, neither solid is in the other,
  /// and so the interiors are disjoint. Proven, and zero only if they are disjoint already.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// A point of solid 1's surface in the world that solid 2's surface all but touches after the
  /// translation. Zero if the interiors are disjoint already.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// Finds how deep two solids at poses in the world overlap: {0, 0, 0} where their interiors are
/// disjoint. Interiors that touch count as disjoint where a plane of a face at the contact parts
/// the solids, in exact arithmetic; else the bracket of touching ones is that of rounding.
///
/// Both bounds hold for the models' vertices in the common frame of docs/guarantees.md. For two
/// convex solids the bracket closes to rel_gap. For others `upper` is the least translation found
/// among those that take meeting triangles past planes of their faces and edges, or inner balls
/// past each other; which of the solids gives the frame is told by their content, so that the order
/// of the pair changes last bits alone. `lower` stems from a pair of balls of one centre, one in
/// each solid: the bracket may stay open. docs/solids.md has the proofs. Safe from many threads.
/// Throws std::invalid_argument if a model is not marked as a solid or has been opened since, a
/// pose is not rigid, or an option is out of range.
template <typename S>
Penetration penetration(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                        const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                        const PenetrationOptions& options = {});

}  // namespace kios
