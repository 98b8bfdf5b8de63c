// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fcl_kios/triangle/triangle.h"
#include "solid/components.h"

namespace kios {

/// Finds the things that a ray along windingDirection() may meet, such as triangles: by squares
/// that their shadows along it cover, each in squares of about its size. O(n log n).
class ShadowGrid {
 public:
  using Shadow = Eigen::Vector2d;
  /// Encloses the shadow of a thing.
  struct Box {
    Shadow low = Shadow::Constant(4), high = Shadow::Constant(-4);
    void extend(const Box& o) {
      low = low.cwiseMin(o.low);
      high = high.cwiseMax(o.high);
    }
  };
  /// No coordinate is larger than `largest`, by which all are scaled.
  static Box boxOf(const TriangleVertices<double>& corners, double largest);

  ShadowGrid(std::vector<Box> boxes, double largest);

  /// Finds every thing that the ray from the point p may meet, by its number; none twice.
  void find(const Point<double>& p, std::vector<std::size_t>& things) const;

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
    std::size_t thing;
    bool operator<(const Entry& o) const { return square < o.square; }
  };
  static Shadow shadowOf(const Point<double>& p, double largest);
  Square squareOf(const Shadow& p, int level) const;

  const std::vector<Box> boxes_;
  const double largest_;
  double size_ = 0;
  Shadow low_ = Shadow::Zero();
  std::vector<int> levels_;
  std::vector<Entry> entries_;
};

/// Says which closed components of a mesh lie in others. A component winds round no point outside
/// of its box, so that a ray from a point looks only into the components whose boxes hold it:
/// cavities in line don't meet each other's rays. O(n log n) for a mesh, unless many boxes overlap:
/// it is O(log n) for each box that a component begins in, and a look at each that lies along its
/// ray.
template <typename S>
class Nesting {
 public:
  /// `parts` must live as long as this; each one must be closed.
  Nesting(const engine::MeshView<S>& mesh, const Components<S>& parts);

  /// Returns true if the others wind round the component's vertices, or all of these lie on others,
  /// so that nothing is proven wrong.
  bool liesWithinOthers(int component);

 private:
  struct Part {
    fcl::Vector3d low, high;
    std::optional<ShadowGrid> triangles;  ///< made where a point lies in the box
  };
  TriangleVertices<double> cornersOf(int triangle) const;

  const engine::MeshView<S> mesh_;
  const Components<S>& components_;
  std::vector<Part> parts_;
  double largest_ = 0;
  std::optional<ShadowGrid> boxes_;  ///< of all parts
  std::vector<std::size_t> near_parts_, near_;
};

}  // namespace kios
