// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell.h"
#include "fcl_kios/robot/answers.h"

namespace kios::robot {

/// Finds whether two links can touch within the limits of the joints between them: samples find
/// contacts, and leastClearance() finds more of them or proves that there are none. Const calls are
/// safe from many threads, and repeatable.
class PairSearch {
 public:
  explicit PairSearch(const Arm& arm);

  /// Looks at random configurations. Settles pairs that touch in some or in all of them.
  void sample(int link_a, int link_b, LinkPair& result) const;
  /// Looks for contacts in boxes of configurations about random ones.
  void look(int link_a, int link_b, LinkPair& result) const;
  /// Looks for a proof with so many queries, which it counts, or for a contact on its way.
  void prove(int link_a, int link_b, long long max_queries, LinkPair& result) const;

 private:
  /// The bodies of two links, and the joints between them.
  struct Between {
    Linkage linkage;
    std::vector<int> coordinates;  ///< the robot's, by the linkage's
    JointBox box;                  ///< their limits
    bool bounded = true;           ///< the box is all that matters
  };
  Between between(int link_a, int link_b) const;
  bool touch(int link_a, int link_b, const std::vector<PlacedLink>& placed) const;
  /// Settles the pair if it touches where that was found of what lies between.
  void touchAt(const RangeResult& found, const Between& between, int link_a, int link_b,
               LinkPair& result) const;

  const Arm& arm_;
  Eigen::VectorXd low_, high_;                    ///< limits, or finite ones in their place
  std::vector<std::vector<const Body*>> bodies_;  ///< by link
  std::vector<Eigen::VectorXd> samples_;
  std::vector<std::vector<PlacedLink>> placed_;  ///< by sample
};

}  // namespace kios::robot
