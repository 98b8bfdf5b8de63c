// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <fcl/common/types.h>
#include "engine/mesh.h"

namespace kios {

/// Finds the triangles that a ray along windingDirection() may meet: by squares that their shadows
/// along it cover, each in squares of about its size. O(n log n).
class ShadowGrid {
 public:
  template <typename S>
  explicit ShadowGrid(const engine::MeshView<S>& mesh);

  /// About the largest coordinate of the mesh.
  double largest() const { return largest_; }
  /// Every triangle that the ray from the vertex p meets, and others; none twice.
  void find(const fcl::Vector3d& p, std::vector<std::size_t>& triangles) const;

 private:
  struct Square {
    int level;  ///< of 2^level by 2^level squares
    std::uint32_t i, j;
    bool operator<(const Square& o) const {
      return level != o.level ? level < o.level : i != o.i ? i < o.i : j < o.j;
    }
  };
  struct Entry {
    Square square;
    std::size_t triangle;
    bool operator<(const Entry& o) const { return square < o.square; }
  };
  using Shadow = Eigen::Vector2d;
  struct Box {
    Shadow low, high;
  };

  Shadow shadowOf(const fcl::Vector3d& p) const;
  Square squareOf(const Shadow& p, int level) const;

  double largest_ = 0, size_ = 0;
  Shadow low_ = Shadow::Zero();
  std::vector<Box> boxes_;  ///< of shadows, by triangle
  std::vector<int> levels_;
  std::vector<Entry> entries_;
};

}  // namespace kios
