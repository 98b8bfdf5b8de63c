// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "continuous/step_search.h"
#include "shape/solid.h"

namespace kios::continuous {

/// Node of a tree of shapes, such as cells of an octree: the first one is the root; `count`
/// children from `first` on, once it was opened.
struct ShapeNode {
  enum State : std::uint8_t { kLeaf, kClosed, kInner, kEmpty };

  shape::Solid solid;  ///< contains the children's
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int first = 0, count = 0;
  State state = kLeaf;
};

/// Holds a moving mesh and a moving rigid tree of solids, whose leaves count: a shape, or the cells
/// of an octree. All tests are in the solids' frame and turn with it, so that unbounded shapes have
/// no velocities but near the mesh. The shapes' kernels are right to 2^-42 of the pair's extent: a
/// pair nearer than 2^-40 of it counts as touching while something moves.
class MovingMeshAndSolids final : public StepSearch {
 public:
  /// Adds the children of a closed node.
  using Open = std::function<void(int node, std::vector<ShapeNode>& nodes)>;

  /// Takes the root of the solids. None: nothing is touched. Throws std::invalid_argument if the
  /// model is not finished, or a solid is larger than 2^300.
  MovingMeshAndSolids(const Modeld& mesh, const Motion& mesh_motion, std::vector<ShapeNode> solids,
                      const Motion& solids_motion, Open open, ContinuousCounts& counts);

 private:
  // A node pair is a node of the mesh (a) and one of the solids (b).
  bool nodesApart(NodePair pair, const RelativeVelocities& v, double duration) override;
  double leavesApart(NodePair pair, const RelativeVelocities& v, double required) override;
  int split(NodePair pair, const RelativeVelocities& v, NodePair* parts) override;

  double pad(const RelativeVelocities& v) const;
  /// Returns the time for which the slab across n between the solid and corners proves them apart.
  double slabTime(const Eigen::Vector3d& n, const ShapeNode& part,
                  const std::array<Eigen::Vector3d, 3>& corners, const RelativeVelocities& v,
                  double duration) const;

  const Modeld& mesh_;
  std::vector<ShapeNode> solids_;
  const Open open_;
  const double reach_;
  Eigen::Vector3d slab_ = Eigen::Vector3d::UnitZ();  ///< normal of the slab that did best of late
};

}  // namespace kios::continuous
