// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "search/mesh.h"
#include "solid/sides.h"

namespace kios {

/// The vertices of a mesh, equal ones as one, and the edges between them. On a convex one a
/// walk uphill along edges ends at the farthest vertex.
class VertexGraph {
 public:
  VertexGraph() = default;
  /// `sides`: each edge once each way.
  VertexGraph(std::vector<fcl::Vector3d> points, const std::vector<Side>& sides);

  bool empty() const { return points_.empty(); }
  const fcl::Vector3d& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  /// A vertex with no neighbour that is farther along n, reached from `start`.
  int climb(const fcl::Vector3d& n, int start) const;

 private:
  std::vector<fcl::Vector3d> points_;
  std::vector<int> begin_, neighbours_;  ///< those of vertex i from begin_[i] to begin_[i + 1]
};

/// Says how nearly a solid is the hull of its vertices.
///
/// Let a point c see all faces from within, and the mesh wind round it once: then the cones from c
/// over the faces tile space. On the cone of face i let G be g_i, the linear function of x - c that
/// is 1 on the face's plane. G is 1 at all vertices. Where one goes from c's cone over face i to
/// that over j, g_j - g_i grows by k times the distance from the plane through c and their edge; k
/// < 0 where the edge is reflex. A segment from face 0 to a vertex v passes each such plane at most
/// once, so that 1 = G(v) >= g_0(v) - E, where E is the sum of all -k > 0, each times the largest
/// distance of a vertex from that plane: no vertex is higher than 1 + E over any face. The hull,
/// drawn towards c by the factor 1 / (1
/// + E), is below all planes. A point below all planes lies in the solid: it sees each face from
/// within, too.
struct Convexity {
  bool convex = false;  ///< E is at most 2^-20
  double moved = 0;     ///< >= the way of any vertex of the hull to its place in the solid
  VertexGraph graph;    ///< empty unless convex
};

/// The mesh must be a solid of one component. O(n log n).
Convexity measureConvexity(const Mesh& mesh);

}  // namespace kios
