// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fcl_kios/solids.h"
#include "search/mesh.h"
#include "solid/sides.h"

namespace kios {

/// Gives the corners of a triangle by its place among some.
using CornersOf = std::function<TriangleVerticesd(std::size_t)>;

/// Returns true if so many triangles, at least one, which are closed, enclose a negative volume:
/// exact.
bool windInwards(std::size_t count, const CornersOf& corners_of);

/// A mesh taken apart into components, and their orientation.
class Components {
 public:
  explicit Components(const Mesh& mesh);

  /// Sets `inside_out` and `oriented` too.
  const Closedness& closedness() const { return closedness_; }
  /// The first triangle of each component that is inside out.
  const std::vector<int>& insideOut() const { return inside_out_; }
  /// Each component's triangles, in ascending order.
  const std::vector<std::vector<int>>& triangles() const { return triangles_; }
  /// Whether a component encloses a negative volume; empty unless all are closed and oriented.
  const std::vector<bool>& inwards() const { return inwards_; }

 private:
  void judgeEdges(const std::vector<Side>& sides);
  void findInsideOut();
  struct Part;
  std::vector<Part> makeParts() const;
  TriangleVerticesd cornersOf(int triangle) const {
    return mesh_.triangle(static_cast<std::size_t>(triangle));
  }

  const Mesh& mesh_;
  std::vector<std::vector<int>> triangles_;
  std::vector<int> inside_out_;
  std::vector<bool> inwards_;
  Closedness closedness_;
};

/// Returns false if every triangle of a solid has the outside before it and the inside behind it:
/// none lies within the union of components. True is wrong for some whose triangles nearly touch or
/// have no area.
bool mayHaveInnerWalls(const Mesh& mesh, const Closedness& closedness);

}  // namespace kios
