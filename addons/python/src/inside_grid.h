// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "fcl_kios/model.h"

// A proof of contact that needs no search. A closed mesh parts space, and how often it winds round
// a point changes only where its surface is crossed. Where one vertex of another mesh lies inside
// and one outside, and edges lead from the one to the other, an edge crosses the surface.

namespace kios::python {

/// The cells of a grid around a closed mesh: which lie inside, which outside, and which the surface
/// may pass through.
class InsideGrid {
 public:
  enum Cell : std::uint8_t { kSurface, kInside, kOutside };
  /// Points by coordinate, four at once. In lengths of cells, from the grid's corner: see
  /// toCells().
  using Float4 __attribute__((vector_size(16))) = float;
  struct Points {
    Float4 at[3];
  };

  /// nullptr if the mesh has no inside, or its triangles are too long for a grid to be worth it.
  static std::unique_ptr<const InsideGrid> of(const Modeld& mesh);

  /// The cells that points lie in, as bits 1 << Cell. They are right for all points that are within
  /// tolerance() of these. Beyond the grid all is outside, as its border is.
  unsigned int cellsAt(const Points& points) const {
    using Int4 __attribute__((vector_size(16))) = int;
    const Float4 zero = {};
    Float4 index = zero;  // whole, below 2^24
    for (int c = 2; c >= 0; --c) {
      const Float4 n = zero + static_cast<float>(size_[c]), last = n - 1.0F;
      Float4 at = points.at[c];
      at = at > zero ? at : zero;
      at = at < last ? at : last;
      index = index * n + __builtin_convertvector(__builtin_convertvector(at, Int4), Float4);
    }
    const Int4 cells = __builtin_convertvector(index, Int4);
    unsigned int met = 0;
    for (int k = 0; k < 4; ++k) met |= 1U << cells_[static_cast<std::size_t>(cells[k])];
    return met;
  }
  /// Maps points from the mesh's frame to cells.
  fcl::Transform3d toCells() const {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() *= cells_per_length_;
    X.translation() = -cells_per_length_ * low_;
    return X;
  }
  double tolerance() const { return tolerance_; }
  /// Whether all of a ball lies outside the box around the grid.
  bool isFar(const Eigen::Vector3d& center, double radius) const {
    return (center - center.cwiseMax(low_).cwiseMin(high_)).squaredNorm() > radius * radius;
  }

 private:
  InsideGrid() = default;
  /// Lays a grid of at most `most` cells a side. False if too many cells lie about triangles.
  bool layOut(const Modeld& mesh, int most);
  void markSurface(const Modeld& mesh);
  void markRest(const Modeld& solid);
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  Eigen::Vector3d center(int x, int y, int z) const {
    return low_ + (Eigen::Vector3d(x, y, z).array() + 0.5).matrix() / cells_per_length_;
  }

  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
  double cells_per_length_ = 0, tolerance_ = 0;
  int size_[3] = {};
  std::vector<std::uint8_t> cells_;  ///< of Cell
};

/// Vertices of one connected part of a mesh, far from each other.
class SpreadVertices {
 public:
  explicit SpreadVertices(const Modeld& mesh);

  /// Whether the mesh, at this pose in the grid's frame, is proven to cross the surface there.
  /// False where nothing is proven, as for poses that aren't rigid.
  bool crosses(const InsideGrid& grid, const fcl::Transform3d& X) const;

 private:
  std::vector<InsideGrid::Points> vertices_;  ///< in the mesh's frame
  double largest_ = 0;                        ///< coordinate
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0;  ///< of a ball around them
};

}  // namespace kios::python
