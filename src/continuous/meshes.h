// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "continuous/advance.h"
#include "continuous/relative_motion.h"
#include "fcl_kios/fcl/model.h"

namespace kios::continuous {

/// Two moving meshes. Source of the search: Tang, Kim & Manocha, "C2A: controlled conservative
/// advancement for continuous collision detection of polygonal models" (2009).
class MovingMeshes final : public MovingPair {
 public:
  MovingMeshes(const Modeld& a, const Motion& motion_a, const Modeld& b, const Motion& motion_b,
               ContinuousCounts& counts);

  bool touching(double t) override;
  double apartFor(double t) override;

 private:
  struct NodePair {
    int a, b;
  };

  bool nodesApart(NodePair pair, const RelativeVelocities& v, double duration);
  /// Time for which two triangles are proven apart; any time of at least `enough` will do.
  double trianglesApart(NodePair pair, const RelativeVelocities& v, double enough);
  NodePair leafPairNear(const RelativeVelocities& v) const;
  double centersGap(NodePair pair, const RelativeVelocities& v) const;

  const Modeld &a_, &b_;
  const RelativeMotion motion_;
  ContinuousCounts& counts_;
  double window_ = 1, last_step_ = 1;
  NodePair last_ = {-1, -1};  ///< leaves that ended the last step
  std::vector<NodePair> stack_;
};

}  // namespace kios::continuous
