// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/common/types.h>

namespace kios::articulated {

/// How far a content reaches along any direction, from above: h(n) = max n . x is convex and
/// homogeneous, so that for n = sum l_i g_i, l_i >= 0, h(n) <= sum l_i h(g_i). The table holds h at
/// the points g of a grid on the octahedron |x|_1 = 1; a direction lies in one of its triangles.
/// The bound is exact where one point of the content is farthest along all three corners, as in
/// most directions from polyhedra, and above by about 1 / 1000 of the size for smooth contents.
class SupportTable {
 public:
  SupportTable() = default;
  /// Tabulates the hull of `points`, each grown by `margin`.
  SupportTable(const std::vector<fcl::Vector3d>& points, double margin);

  bool empty() const { return heights_.empty(); }
  /// >= n . x for every point x, if n is finite. `point`, if given, is where the bound would be
  /// attained, near the content's surface.
  double along(const fcl::Vector3d& n, fcl::Vector3d* point = nullptr) const;

 private:
  static constexpr int kCuts = 8;  ///< of an edge of the octahedron
  static constexpr int kSide = kCuts + 1;
  /// The place of (i, j, kCuts - i - j) / kCuts in the octant whose bits are the negative axes.
  static int indexOf(int octant, int i, int j) { return (octant * kSide + i) * kSide + j; }

  std::vector<double> heights_;
};

}  // namespace kios::articulated
