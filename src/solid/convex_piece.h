// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "fcl_kios/triangle.h"

namespace kios {

/// A convex polygon, or a convex body between polygons.
class ConvexPiece {
 public:
  using Polygon = std::vector<Pointd>;

  ConvexPiece() = default;
  explicit ConvexPiece(const TriangleVerticesd& t)
      : ConvexPiece(std::vector<Polygon>{{t[0], t[1], t[2]}}) {}
  /// A box: its axes are columns, unit and orthogonal.
  ConvexPiece(const Pointd& center, const Eigen::Matrix3d& axes, const Pointd& half);

  /// A point of the piece, to rounding.
  const Pointd& center() const { return center_; }
  /// No point is farther from the centre, but for rounding.
  double radius() const { return radius_; }
  bool isEmpty() const { return faces_.empty(); }
  bool isFlat() const { return faces_.size() == 1; }
  /// The unit normal of a polygon; zero if it has none.
  Pointd normal() const;
  /// Where the piece lies along a direction.
  std::pair<double, double> rangeAlong(const Pointd& n) const;
  template <typename Visit>
  void forCorners(const Visit& visit) const {
    for (const Polygon& face : faces_) {
      for (const Pointd& p : face) visit(p);
    }
  }

  /// The parts where n p <= offset and where n p >= offset, which share what is between: together
  /// they cover the piece, but for rounding of the coordinates. One may be empty.
  std::pair<ConvexPiece, ConvexPiece> cut(const Pointd& n, double offset) const;
  /// Across the longest side of the box around it, not quite in the middle: middles meet faces.
  std::pair<ConvexPiece, ConvexPiece> halves() const;

 private:
  explicit ConvexPiece(std::vector<Polygon> faces);

  std::vector<Polygon> faces_;
  Pointd center_ = Pointd::Zero();
  double radius_ = 0;
};

}  // namespace kios
