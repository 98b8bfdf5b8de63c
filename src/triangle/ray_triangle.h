// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "fcl_kios/triangle.h"
#include "triangle/predicates.h"
#include "triangle/scaled_origin.h"

namespace kios {

/// The points origin + t direction 2^exponent, t_min <= t <= t_max, all of them finite; direction
/// not zero.
struct GivenRay {
  Point<double> origin, direction;
  int exponent;
  double t_min, t_max;
};

/// The first point of a ray in a closed triangle.
struct TriangleHit {
  double t;           ///< the exact parameter, rounded to nearest
  double weights[3];  ///< barycentric coordinates, >= 0, each to 2^-51
  int side;           ///< sign of the direction along (p1 - p0) x (p2 - p0); 0: none crosses a face
};

/// A ray for exact tests of triangles, which may be segments or points. Verdicts, t and sides are
/// exact for all finite coordinates; they depend on nothing but the ray and the triangle's points.
class ExactRay {
 public:
  /// `largest`: about the largest coordinate of the triangles; scales what is computed first.
  ExactRay(const GivenRay& ray, double largest);

  /// Returns true and sets `hit` if they meet.
  bool hits(const TriangleVertices<double>& corners, TriangleHit& hit) const;

 private:
  using Corners = ScaledOrigin::Corners;

  /// Returns the sign of direction . ((corner i - origin) x (corner j - corner i)): the side on
  /// which the ray passes the edge.
  Sign filteredSide(const Corners& t, int i, int j) const;
  Sign twofoldSide(const Corners& t, int i, int j) const;
  /// Sets the hit of a face that the ray's line crosses. False if rounding leaves something open.
  bool cross(const Corners& t, TriangleHit& hit, bool& in_range) const;

  const GivenRay given_;
  const ScaledOrigin origin_;
  double direction_[3];  ///< scaled, of at most 2
  int shift_;            ///< t = that of the scaled ray times 2^shift
  bool exact_ = true;    ///< nothing of the direction is lost by that
};

/// Decides it in integers of any size.
bool hitInIntegers(const GivenRay& ray, const TriangleVertices<double>& corners, TriangleHit& hit);

}  // namespace kios
