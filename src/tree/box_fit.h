// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/moment_fit.h"
#include "tree/tree.h"

namespace kios::engine {

/// The points of a tree's leaves in chunks, one leaf after the other, and those of each node.
class TreePoints {
 public:
  explicit TreePoints(const Tree& tree);

  const PointChunk* chunksOf(std::size_t node) const { return &chunks_[ranges_[node].begin]; }
  std::size_t numChunks(std::size_t node) const { return ranges_[node].end - ranges_[node].begin; }

 private:
  struct Range {
    std::size_t begin, end;
  };

  std::vector<PointChunk> chunks_;
  std::vector<Range> ranges_;  ///< by node
};

/// Completes the boxes of a tree that has one for each node: of that box, the one along the model's
/// axes and the one along the longest edge and the normal of the node's largest triangle the one of
/// least surface stays. Marks the nodes that are flat, and writes the boxes of the blocks. Returns
/// whether any node is flat.
bool fitBoxes(const TreePoints& points, Tree& tree);

/// Sets the root's box: that of a tree which has boxes, else chosen likewise, beginning with
/// root_box; more exactly than others.
void fitRootBox(const TreePoints& points, Tree& tree);

/// Fits a box to a triangle of a leaf, as exactly.
Box triangleBox(const Tree& tree, const Leaf& leaf, std::uint32_t face);

}  // namespace kios::engine
