// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include <fcl/common/types.h>

namespace kios {

/// Holds the vertices of a mesh, equal ones as one, and the edges between them. On a convex one a
/// walk uphill along edges ends at the farthest vertex.
class VertexGraph {
 public:
  VertexGraph() = default;
  /// The neighbours of vertex i are those from begin[i] to begin[i + 1].
  VertexGraph(std::vector<fcl::Vector3d> points, std::vector<int> begin,
              std::vector<int> neighbours)
      : points_(std::move(points)), begin_(std::move(begin)), neighbours_(std::move(neighbours)) {}

  bool empty() const { return points_.empty(); }
  const fcl::Vector3d& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  /// Returns a vertex with no neighbour that is farther along n, reached from `start`.
  int climb(const fcl::Vector3d& n, int start) const;

 private:
  std::vector<fcl::Vector3d> points_;
  std::vector<int> begin_, neighbours_;
};

}  // namespace kios
