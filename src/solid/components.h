// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "build/mesh_view.h"
#include "fcl_kios/solid/closedness.h"
#include "fcl_kios/triangle/triangle.h"
#include "solid/sides.h"

namespace kios {

/// Gives the corners of a triangle by its place among some.
using CornersOf = std::function<TriangleVertices<double>(std::size_t)>;

/// Returns true if so many triangles, at least one, which are closed, enclose a negative volume:
/// exact.
bool windInwards(std::size_t count, const CornersOf& corners_of);

/// Holds a mesh taken apart into components, and their orientation.
template <typename S>
class Components {
 public:
  explicit Components(const engine::MeshView<S>& mesh);

  /// Sets `inside_out` and `oriented` too.
  const Closedness<S>& closedness() const { return closedness_; }
  /// Returns the first triangle of each component that is inside out.
  const std::vector<int>& insideOut() const { return inside_out_; }
  /// Ranges over a component's triangles, in ascending order.
  struct Triangles {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  Triangles trianglesOf(int component) const {
    const auto c = static_cast<std::size_t>(component);
    return {triangles_.data() + begin_[c], triangles_.data() + begin_[c + 1]};
  }

 private:
  void listTriangles(const Parts& parts);
  void judgeEdges(const std::vector<Side>& sides);
  void findInsideOut();
  struct Part;
  std::vector<Part> makeParts() const;
  static bool liesWithinOthers(std::vector<Part>& parts, int component);
  TriangleVertices<double> cornersOf(int triangle) const;

  const engine::MeshView<S> mesh_;
  std::vector<int> triangles_;  ///< component by component
  std::vector<int> begin_;      ///< of each component in triangles_
  std::vector<int> inside_out_;
  Closedness<S> closedness_;
};

}  // namespace kios
