// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fcl_kios/model/model.h"

namespace kios {

/// Names an edge of a mesh that keeps it from being a solid.
template <typename S>
struct FaultyEdge {
  int triangle = -1;  ///< the first one at the edge; -1: there is no such edge
  /// The edge's ends in the model's frame, in that triangle's order.
  fcl::Vector3<S> from = fcl::Vector3<S>::Zero(), to = fcl::Vector3<S>::Zero();
};

using FaultyEdged = FaultyEdge<double>;
using FaultyEdgef = FaultyEdge<float>;

/// Says what a mesh must be to have an inside, vertices of equal coordinates taken as one. A
/// triangle with two corners alike passes the edge between them once each way.
template <typename S>
struct Closedness {
  /// There is an edge, and every edge belongs to an even number of triangles.
  bool closed = false;
  /// As many triangles run through every edge one way as the other, and no component is inside out:
  /// one whose normals point inwards is the wall of a cavity, and must lie within the others.
  bool oriented = false;
  int components = 0;         ///< of triangles that are connected by edges
  int open_edges = 0;         ///< of an odd number of triangles: of one, nearly always
  int misoriented_edges = 0;  ///< of an even number, not as many one way as the other
  int inside_out = 0;         ///< components; looked for where all edges are in order
  int edges = 0;              ///< between distinct vertices
  int branching_edges = 0;    ///< of more than two triangles
  int first_inside_out = -1;  ///< a triangle of the first such component
  /// Lists the first edges that are open or misoriented, by triangle.
  std::array<FaultyEdge<S>, 3> first;

  bool isSolid() const { return closed && oriented; }
};
using Closednessd = Closedness<double>;
using Closednessf = Closedness<float>;

/// Examines whether a mesh may be a solid: O(n log n), and for each component whose normals point
/// inwards a look at the box of each other one, and O(log n) where it begins in that. Exact for all
/// finite coordinates, but where components wind inwards for those below 2^-960 of the largest.
/// Throws std::invalid_argument if the model is not a finished mesh.
template <typename S>
Closedness<S> inspectClosedness(const Model<S>& model);
/// Examines a mesh without a model, its indices in range and its vertices finite.
template <typename S>
Closedness<S> inspectClosedness(const std::vector<fcl::Vector3<S>>& vertices,
                                const std::vector<fcl::Triangle>& triangles);

/// Says what keeps a mesh from being a solid, as messages say it: the counts, and where the first
/// three edges are. Empty if nothing does.
template <typename S>
std::string faultsOf(const Closedness<S>& closedness);

}  // namespace kios
