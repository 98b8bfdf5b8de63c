// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>
#include "solid/sides.h"

namespace kios {

/// Triangles over welded vertices, which are taken away, turned and added. Two faces meet
/// where they share two vertices, whatever their coordinates.
class FaceSet {
 public:
  struct Face {
    std::array<int, 3> corners;
    int given;  ///< its number among the triangles as given; -1 for one that fills a hole
    bool flipped = false;
  };

  /// Takes the triangles with three distinct corners, `by` giving the corner for each index.
  FaceSet(const std::vector<fcl::Triangle>& triangles, const std::vector<int>& by);

  const std::vector<Face>& faces() const { return faces_; }
  int degenerate() const { return degenerate_; }

  /// Takes away faces that are there already; see repair.h. Returns how many.
  int dropDoubles();
  /// Turns neighbours to one side, as few of them as can be.
  void turnNeighbours();
  void flip(std::size_t face);
  void fill(const std::array<int, 3>& corners);

  /// Ways round holes, in the order that a triangle would fill them: along edges of one
  /// face.
  std::vector<std::vector<int>> holes() const;
  /// A closed part of the surface.
  struct Part {
    std::vector<int> faces;
    bool as_given;  ///< no face of it was turned, or all were
  };
  /// The parts connected by edges of two faces (`across_branches`: by any edges) that are
  /// closed by themselves: as many faces run through each edge one way as the other.
  std::vector<Part> closedParts(bool across_branches) const;

 private:
  /// The faces' sides, edge by edge.
  std::vector<Side> sides() const;

  std::vector<Face> faces_;
  int degenerate_ = 0;
};

/// The triangles of least area that fill a hole, over its vertices and in their order
/// (Barequet and Sharir, Filling gaps in the boundary of a polyhedron, 1995). Diagonals of which
/// `avoid` is true are taken only where nothing else is left. O(k^3) in at least 3 corners. Returns
/// places among the corners.
std::vector<std::array<int, 3>> fillHole(const std::vector<fcl::Vector3d>& corners,
                                         const std::function<bool(int, int)>& avoid);

/// The length of the way round.
double perimeterOf(const std::vector<fcl::Vector3d>& corners);

}  // namespace kios
