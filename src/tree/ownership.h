// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace kios::engine {

/// The features that each leaf owns. The distance of two disjoint meshes is attained by two edges
/// or by a vertex and a face, so it suffices that every edge and every vertex lies in one leaf that
/// holds one of its triangles.
struct Ownership {
  /// By leaf, one after the other: leaf l owns edges [edge_begin[l], edge_begin[l + 1]), vertices
  /// likewise. Each as its corner in its first triangle by index, so that of equal answers those
  /// with the least ids win.
  std::vector<FeatureId> edges, vertices;
  std::vector<std::uint32_t> edge_begin, vertex_begin;
};

/// Leaf l holds the triangles order[leaf_begin[l], leaf_begin[l + 1]); `corners` lists the welded
/// vertices of each triangle by index. Features that several leaves could own go to the one that
/// owns fewest.
Ownership assignFeatures(const std::vector<Corners3>& corners,
                         const std::vector<std::uint32_t>& order,
                         const std::vector<std::uint32_t>& leaf_begin, std::size_t num_vertices);

}  // namespace kios::engine
