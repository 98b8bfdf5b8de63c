// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/triangle.h"
#include "triangle/scaled_origin.h"

namespace kios {

/// How a ray without end passes an oriented triangle.
enum class Crossing {
  kNone,
  kForward,   ///< along (p1 - p0) x (p2 - p0)
  kBackward,  ///< against it
  kOrigin     ///< the ray's origin lies on the closed triangle
};

/// A ray that is turned by an infinitesimal angle, so that it passes no edge and no vertex: its
/// direction is d + e x + e^2 y, e -> 0, x and y the axes and d_z != 0 (simulation of simplicity).
/// The sum of forward minus backward crossings of a closed oriented mesh is its winding number at
/// the origin, unless that lies on the mesh. Verdicts are exact for all finite coordinates.
class RayCrossing {
 public:
  /// `largest`: about the largest coordinate of the triangles; scales what is computed first.
  RayCrossing(const Point<double>& origin, const Point<double>& direction, double largest);

  /// A triangle that degenerates to a segment or a point is crossed nowhere, but may hold the
  /// origin.
  Crossing cross(const TriangleVertices<double>& corners) const;

 private:
  Crossing crossInIntegers(const TriangleVertices<double>& corners) const;
  Crossing ifOrigin(const TriangleVertices<double>& corners) const;

  const Point<double> given_origin_, direction_;  ///< |direction| about 1
  const ScaledOrigin origin_;
};

}  // namespace kios
