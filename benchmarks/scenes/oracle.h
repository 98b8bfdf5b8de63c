// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "mesh.h"
#include "triangle_oracle.h"

namespace kios::scenes {

/// The triangles of a mesh under a binary tree of boxes, one a leaf: a node's children hold the
/// halves of its range of them.
struct ExactTree {
  using Box = Eigen::AlignedBox<long double, 3>;

  explicit ExactTree(const Mesh& mesh);
  /// To be called when the triangles were moved.
  void findBoxes();

  std::vector<ExactTriangle> triangles;  ///< from the tree's left to its right
  std::vector<int> ids;                  ///< of these in the mesh
  std::vector<Box> boxes;                ///< of nodes
};

/// The true answers for two triangle soups at given poses, in long double. The common frame is A's:
/// x -> R1^T (R2 x + (t2 - t1)) with the double matrices as given, whether or not they are exact
/// rotations. Const calls are safe from several threads.
class MeshOracle {
 public:
  /// Holds pairs of a triangle of A and a triangle of B.
  using Pairs = std::vector<std::pair<int, int>>;

  /// Throws std::invalid_argument if a mesh has no triangle.
  MeshOracle(const Mesh& a, const Mesh& b);

  /// Distance, 0 in contact (touching counts), rounded to double once.
  double distance(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const;

  /// Returns true if some pair of triangles meets (trianglesMeet).
  bool collide(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const;

  /// Returns all pairs that meet, in ascending order.
  Pairs collidingPairs(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const;

  /// Searches all pairs of triangles, without a tree. The result is equal, bit by bit.
  double distanceBruteForce(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const;

 private:
  ExactTree placedB(const fcl::Transform3d& X_WA, const fcl::Transform3d& X_WB) const;

  ExactTree a_, b_;  // each in its own frame
};

}  // namespace kios::scenes
