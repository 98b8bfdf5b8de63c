// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/math/bv/OBBRSS.h>

#include "fcl_kios/triangle.h"
#include "scenes/mesh.h"

namespace kios::paper {

/// A triangle mesh in its own frame under the binary tree of FCL's OBBRSS, one triangle a leaf:
/// each node is split across its longest principal axis, at the mean of its triangles' centroids.
/// Knows no volumes, so that all of them can be compared on one tree.
class MeshSplit {
 public:
  struct Node {
    int left = 0;       ///< left child, the right one follows it; 0 for a leaf
    int first = 0;      ///< its triangles stand at first, ..., first + count - 1 of triangle()
    int count = 0;      ///< 1 for a leaf
    double extent = 0;  ///< longest side of the axis-aligned box of the vertices
    bool leaf() const { return left == 0; }
  };

  /// Throws std::runtime_error if FCL refuses the mesh.
  explicit MeshSplit(const scenes::Mesh& mesh);

  /// Returns the 2 n - 1 nodes for n triangles; the root first, children after their parent.
  const std::vector<Node>& nodes() const { return nodes_; }
  int triangleCount() const { return static_cast<int>(order_.size()); }
  /// Returns the id of the triangle at `place`, in the order of the mesh.
  int triangle(int place) const { return order_[place]; }
  TriangleVertices<double> corners(int triangle_id) const;
  /// Returns the distinct vertices of a node's triangles.
  std::vector<fcl::Vector3d> points(const Node& node) const;

 private:
  void add(const fcl::BVHModel<fcl::OBBRSSd>& model, int index);

  const scenes::Mesh mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace kios::paper
