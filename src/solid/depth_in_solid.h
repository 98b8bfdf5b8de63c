// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "fcl_kios/volume.h"
#include "query/posed_tree.h"
#include "search/mesh.h"
#include "solid/convex_piece.h"

namespace kios {

/// How deep a point lies in a solid: its distance to the surface, negative outside.
struct Depth {
  double lower = 0;  ///< proven; 0 outside
  double upper = 0;  ///< proven
  fcl::Vector3d nearest = fcl::Vector3d::Zero();
  /// Unit: out of the solid by the nearest way, or on away from it.
  fcl::Vector3d out = fcl::Vector3d::Zero();
};

/// n x = offset.
struct Cut {
  fcl::Vector3d n;
  double offset;
};

/// One solid of a pair as it lies in the common frame, in which all points are given.
class DepthInSolid {
 public:
  /// X takes the mesh to the frame. `rounding` bounds the errors of points in the frame and of
  /// distances.
  DepthInSolid(const Mesh& mesh, const RelativePose<double>& X, double rounding);

  TriangleVerticesd triangle(int t) const;
  const PosedTree& tree() const { return tree_; }
  /// How much farther than its radius the content of a node may be from its centre.
  double treeError() const { return tree_error_; }
  /// A box around the content of a node; an empty piece if it has none.
  ConvexPiece boxOf(std::uint32_t node) const;
  bool hasWalls() const { return walls_; }

  Depth depthOf(const fcl::Vector3d& p) const;
  /// Returns true only if a piece lies outside of the solid after a move. Else `cut` is a plane of
  /// a triangle that it may meet then, moved back, if one was found that cuts the piece; `blocker`
  /// is the normal of one of the others, if there are any. Adds the nodes and triangles that it
  /// looked at to `visits`.
  bool isOutside(const ConvexPiece& piece, const fcl::Vector3d& v, std::optional<Cut>& cut,
                 fcl::Vector3d& blocker, long long& visits) const;
  /// How far a point of a triangle is from the outside at most: infinity for one of a wall.
  double fromOutside(const fcl::Vector3d& p) const;

 private:
  bool holds(const fcl::Vector3d& p) const;

  const Mesh mesh_;
  const bool walls_;
  const RelativePose<double> X_;
  const double rounding_;
  double tree_error_ = 0;
  const PosedTree tree_;
  const fcl::Vector3d center_;
};

}  // namespace kios
