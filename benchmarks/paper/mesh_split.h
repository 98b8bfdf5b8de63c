// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>
#include "fcl_kios/triangle.h"

namespace kios::paper {

/// A triangle mesh in its own frame, split into a binary tree with one triangle a leaf: each node
/// across the longest principal axis of its vertices, at the mean of its triangles' centroids, as
/// fcl::BVHModel<kIOSd> does. Knows no volumes, so that all of them can be compared on one tree.
class MeshSplit {
 public:
  struct Node {
    int left = 0;       ///< left child, the right one follows it; 0 for a leaf
    int first = 0;      ///< its triangles stand at first, ..., first + count - 1 of triangle()
    int count = 0;      ///< 1 for a leaf
    double extent = 0;  ///< longest side of the axis-aligned box of the vertices
    bool leaf() const { return left == 0; }
  };

  /// Throws std::invalid_argument if there is no triangle, an index is out of range, or a
  /// coordinate that a triangle uses is NaN, infinite or above 2^1000 in magnitude.
  MeshSplit(std::vector<fcl::Vector3d> vertices, std::vector<fcl::Triangle> triangles);

  /// Returns the 2 n - 1 nodes for n triangles; the root first, children after their parent.
  const std::vector<Node>& nodes() const { return nodes_; }
  int triangleCount() const { return static_cast<int>(triangles_.size()); }
  /// Returns the id of the triangle at `place`, in the order of the constructor.
  int triangle(int place) const { return static_cast<int>(order_[place]); }
  TriangleVertices<double> corners(int triangle_id) const;
  /// Returns the distinct vertices of a node's triangles.
  std::vector<fcl::Vector3d> points(const Node& node) const;

 private:
  int partition(const Node& node, const std::vector<fcl::Vector3d>& points);

  std::vector<fcl::Vector3d> vertices_;
  std::vector<fcl::Triangle> triangles_;
  std::vector<unsigned int> order_;
  std::vector<Node> nodes_;
};

}  // namespace kios::paper
