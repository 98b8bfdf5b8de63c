// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "triangle_oracle.h"

namespace kios::scenes {

/// Holds an axis-aligned box in the frame of its points.
struct ExactBox {
  ExactPoint lower;
  ExactPoint upper;
};

/// Returns the distance of two boxes, 0 if they overlap.
long double boxDistance(const ExactBox& a, const ExactBox& b);

/// Holds a binary tree of axis-aligned boxes over triangles, one triangle a leaf. The topology is
/// fixed at construction; boxes are computed for any later position of the same triangles.
class AabbTree {
 public:
  struct Node {
    int left = -1;      // the right child is left + 1; -1 at a leaf
    int triangle = -1;  // -1 at an inner node
  };

  /// Median split by centroid along the longest side. `triangles` must not be empty.
  explicit AabbTree(const std::vector<ExactTriangle>& triangles);

  /// Returns nodes with the root first and children after their parent.
  const std::vector<Node>& nodes() const { return nodes_; }

  /// Returns the box of each node for the triangles as they lie now: same count and order as at
  /// construction.
  std::vector<ExactBox> boxes(const std::vector<ExactTriangle>& triangles) const;

 private:
  std::vector<Node> nodes_;
};

}  // namespace kios::scenes
