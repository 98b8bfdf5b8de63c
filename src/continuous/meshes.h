// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "continuous/chords.h"
#include "continuous/step_search.h"

namespace kios::continuous {

/// Holds two moving meshes.
class MovingMeshes final : public StepSearch {
 public:
  MovingMeshes(const Modeld& a, const Motion& motion_a, const Modeld& b, const Motion& motion_b,
               ContinuousCounts& counts)
      : StepSearch(motion_a, reachOf(a), motion_b, reachOf(b), counts), a_(a), b_(b) {}

 private:
  void beginStep(double t) override;
  bool nodesApart(NodePair pair, const RelativeVelocities& v, double duration) override;
  double leavesApart(NodePair pair, const RelativeVelocities& v, double required) override;
  int split(NodePair pair, const RelativeVelocities& v, NodePair* parts) override;
  bool changeOrder(double way, long long cost) override;
  void noteStep(double way, long long cost) override;
  /// Sets chords_ if they bound the motion better than velocities do, and returns whether.
  bool useChords(const RelativeVelocities& v, double duration);
  bool nodesStayApart(NodePair pair, const RelativeVelocities& v) const;
  /// Returns true if the plane of a triangle, one of the pair, parts it from the other node.
  bool planeParts(NodePair pair, const RelativeVelocities& v, double duration);
  double centersGap(NodePair pair, const RelativeVelocities& v) const;

  /// Says which node of a pair is split: the larger one, b's down to its leaves, or a's. What lies
  /// within a hole is best left whole, as each face of the hole lies on one side of it.
  enum class Order : std::uint8_t { kLarger, kB, kA };

  const Modeld &a_, &b_;
  static constexpr int kOrders = 3;
  Order order_ = Order::kLarger;
  /// Length of a step by its cost, or the cost of what came to nothing, negative; 0 if not known.
  double worth_[kOrders] = {};
  double time_ = 0;  ///< of the step
  Chords chords_;    ///< of the step, until duration() after it
};

}  // namespace kios::continuous
