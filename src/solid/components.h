// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "build/mesh_view.h"
#include "fcl_kios/solid/closedness.h"

namespace kios {

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
  /// Holds a side of a triangle, at the edge between two welded vertices.
  struct Half {
    std::uint32_t low, high;
    std::uint32_t triangle : 30;
    std::uint32_t corner : 2;
    bool forward;  ///< it runs from low to high

    bool sameEdge(const Half& o) const { return low == o.low && high == o.high; }
    bool operator<(const Half& o) const {
      if (low != o.low) return low < o.low;
      if (high != o.high) return high < o.high;
      return triangle < o.triangle;
    }
  };

  void connect();
  void judgeEdges();
  void findInsideOut();
  bool windsInwards(int component) const;

  const engine::MeshView<S> mesh_;
  std::vector<std::uint32_t> welded_;
  std::vector<Half> halves_;
  std::vector<int> component_;  ///< by triangle; -1 for points
  std::vector<int> first_;      ///< triangle of each component
  std::vector<int> triangles_;  ///< component by component
  std::vector<int> begin_;      ///< of each component in triangles_
  std::vector<int> inside_out_;
  Closedness<S> closedness_;
};

}  // namespace kios
