// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace kios {

/// A side of a triangle, at the edge between two welded vertices.
struct Side {
  int low, high, triangle;
  std::uint8_t corner;  ///< of the triangle, at which it begins
  bool forward;         ///< it runs from low to high

  bool sameEdge(const Side& o) const { return low == o.low && high == o.high; }
  bool operator<(const Side& o) const {
    return std::tie(low, high, triangle) < std::tie(o.low, o.high, o.triangle);
  }
};

/// The sides of triangles with distinct ends, edge by edge. corners_of(t) gives the three
/// vertices of a triangle.
template <typename Corners>
std::vector<Side> sidesOf(std::size_t num_triangles, const Corners& corners_of) {
  std::vector<Side> sides;
  sides.reserve(3 * num_triangles);
  for (std::size_t t = 0; t < num_triangles; ++t) {
    const auto corners = corners_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = static_cast<int>(corners[k]), to = static_cast<int>(corners[(k + 1) % 3]);
      if (from == to) continue;
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t),
                       static_cast<std::uint8_t>(k), from < to});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Calls visit(begin, end) for each run of sides of one edge.
template <typename Visit>
void forEdges(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].sameEdge(sides[i])) ++end;
    visit(i, end);
  }
}

/// The connected parts of a surface, in the order of their first triangles.
struct Parts {
  std::vector<int> of;  ///< by triangle; -1 for one that has no side
  /// By triangle: it is wound against the first one of its part, along the way that joined them.
  std::vector<bool> turned;
  std::vector<std::vector<int>> triangles;
};

/// Finds the parts that are connected by edges of two triangles, or `across_branches` by any edges.
Parts partsOf(const std::vector<Side>& sides, std::size_t num_triangles, bool across_branches);

}  // namespace kios
