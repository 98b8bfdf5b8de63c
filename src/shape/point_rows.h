// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_kios/triangle.h"

namespace kios::shape {

/// Coordinates of points in rows, as vectors of the machine read them.
class PointRows {
 public:
  PointRows() = default;  ///< of no points
  explicit PointRows(const std::vector<Point<double>>& points);

  bool empty() const { return rows_.empty(); }

  /// The index of the first of the points whose n . p, computed without fused operations, is the
  /// largest, bit for bit the same on every machine; 0 if n is NaN.
  std::size_t farthestAlong(const Point<double>& n) const;

 private:
  std::vector<double> rows_;  ///< x of all points, y, z; the last point is repeated
};

/// Planes {normal x = offset} in rows: x, y and z of the normals, each of `count`, a multiple of 8,
/// and the offsets.
struct PlaneRows {
  const double *normals, *offsets;
  std::size_t count;

  /// The index of the first plane over which the lowest corner of a triangle lies highest, and how
  /// high that is; as PointRows::farthestAlong().
  std::size_t highestOver(const TriangleVertices<double>& triangle, double& height) const;
};

}  // namespace kios::shape
