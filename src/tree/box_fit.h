// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tree/moment_fit.h"
#include "tree/tree.h"

namespace kios::engine {

/// The points of a node among the chunks of its tree.
struct ChunkRange {
  std::size_t begin = 0, end = 0;
};

/// Completes the boxes of a tree that has one for each node: of that box, the one along the model's
/// axes and the one along the longest edge and the normal of the node's largest triangle the one of
/// least surface stays. Marks the nodes that are flat, and writes the boxes of the blocks. Returns
/// whether any node is flat.
bool fitBoxes(const std::vector<PointChunk>& chunks, const std::vector<ChunkRange>& of_node,
              Tree& tree);

}  // namespace kios::engine
