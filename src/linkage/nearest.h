// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "continuous/threshold_search.h"
#include "linkage/near_pairs.h"

namespace kios::articulated {

/// The nearest of a linkage's pairs at configurations: of all, or of one. Distances may exceed the
/// exact ones by rel_err of them.
class Nearest {
 public:
  explicit Nearest(const Pair* only) : only_(only) {}

  /// Returns the nearest pair of those nearer than `far`; the upper bound holds for exact
  /// kinematics.
  continuous::Sight at(const Configuration& c, double far, double rel_err);
  /// Lists the pairs whose volumes at c don't prove them farther apart than `far`, the nearest
  /// first, with their bounds.
  std::vector<std::pair<double, Pair>> pairs(const Configuration& c, double far);

  /// A bracket of the distance of a pair, for exact kinematics, and nearest points in the world.
  /// What is farther than `far` may be known less well. Throws std::invalid_argument if that takes
  /// a query that isn't served.
  struct Distance {
    double lower = 0;
    continuous::Sight upper;
  };
  Distance of(Pair& pair, const Configuration& c, double far, double rel_err);

  long long queries() const { return counts_.queries; }
  const Pair* only() const { return only_; }

 private:
  const Pair* const only_;
  MotionCounts counts_;
  NearPairs near_pairs_;
};

}  // namespace kios::articulated
