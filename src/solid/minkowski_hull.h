// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solid/solid_pair.h"

namespace kios {

/// Says how deep the hulls of two meshes overlap, in a's frame.
struct HullDepth {
  /// A ball of this radius about the origin lies in the hull of all differences a_i - b_j of
  /// vertices: proven; 0 if that couldn't be certified.
  double lower = 0;
  double upper = 0;                              ///< about the height of that hull along `normal`
  fcl::Vector3d normal = fcl::Vector3d::Zero();  ///< unit: b leaves a's hull along it; or zero
};

/// Holds the extreme differences of vertices of two meshes, b's as posed in a's frame.
class Differences {
 public:
  /// `pair` must outlive this.
  explicit Differences(const SolidPair& pair);

  struct Point {
    fcl::Vector3d at;
    int a = 0, b = 0;  ///< vertices of the graphs, from which the next walk may start
  };
  /// Returns a point from which no step leads farther along n, and which is certain to be one of
  /// the points. Both meshes must be convex.
  Point farthest(const fcl::Vector3d& n, const Point& near) const;
  /// n . p for the farthest point p: not less, rounding is paid for. n is a unit vector.
  double height(const fcl::Vector3d& n) const;
  /// Bounds the rounding of a point.
  double error() const { return error_; }

 private:
  const RelativePose<double>& X_AB_;
  const Mesh &a_, &b_;
  const VertexGraph &graph_a_, &graph_b_;
  const double error_;
};

/// Expands a polytope of differences towards the faces nearest to the origin (van den Bergen's
/// EPA), until upper <= (1 + rel_gap) lower or `max_points` were added. Both meshes must be convex.
HullDepth hullDepth(const Differences& differences, double size, double rel_gap, int max_points);

}  // namespace kios
