// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "continuous/pair_search.h"
#include "shape/solid.h"

namespace kios::continuous {

/// A moving mesh and a moving shape. All tests are in the shape's frame and turn with it, so that
/// unbounded shapes have no velocities but near the mesh. The shape's kernels are right to 2^-42 of
/// the pair's extent: what is nearer than 2^-40 of it counts as touching while something moves.
class MovingMeshAndSolid final : public PairSearch {
 public:
  /// `geometry` is the shape that `solid` describes. Throws std::invalid_argument if the model is
  /// not finished, or the shape is larger than 2^300.
  MovingMeshAndSolid(const Modeld& mesh, const Motion& mesh_motion,
                     const fcl::CollisionGeometryd& geometry, shape::Solid solid,
                     const Motion& solid_motion, ContinuousCounts& counts);

  bool touching(double t) override;

 private:
  // A node pair is a node of the mesh (a) and 0.
  bool nodesApart(NodePair pair, const RelativeVelocities& v, double duration) override;
  double leavesApart(NodePair pair, const RelativeVelocities& v, double enough) override;
  bool split(NodePair pair, const RelativeVelocities& v, NodePair& near,
             NodePair& far) const override;

  double pad(const RelativeVelocities& v) const;
  /// Time for which the slab across n between solid and corners proves them apart.
  double slabTime(const Eigen::Vector3d& n, const std::array<Eigen::Vector3d, 3>& corners,
                  const RelativeVelocities& v, double duration) const;

  const Modeld& mesh_;
  const fcl::CollisionGeometryd& geometry_;
  const shape::Solid solid_;
  const double reach_;
  Eigen::Vector3d slab_ = Eigen::Vector3d::UnitZ();  ///< normal of the slab that did best of late
};

}  // namespace kios::continuous
