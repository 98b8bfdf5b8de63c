// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "volume/lanes.h"

namespace kios::engine {

/// A node of the binary tree over a range of the permuted triangles.
struct BinaryNode {
  int first, count;
  int left = -1, right = -1;  ///< -1: a leaf
  float size = 0;             ///< of inner nodes: diagonal of the box along the principal axes

  bool isLeaf() const { return left < 0; }
};

/// Triangles as the split sees them: corners in lanes x, y, z, 0 relative to some origin.
struct Corners {
  lanes::Float4 v[3];
};

/// Splits the triangles down to leaves of at most kLeafTriangles by the surface-area-like cost
/// diag^2 * ceil(n / kLeafTriangles) of both sides, along the principal axes of each node. Permutes
/// `order`, which lists all triangles. Node 0 is the root; children follow their parents.
std::vector<BinaryNode> partition(const std::vector<Corners>& triangles,
                                  std::vector<std::uint32_t>& order);

}  // namespace kios::engine
