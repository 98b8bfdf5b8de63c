// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/solid.h"
#include "shape/triangle_shape.h"
#include "triangle/point_distance.h"

// Nearest points by closed forms, in the solid's frame.

namespace kios::shape {

struct NearestPoint {
  double distance;  ///< 0 for points of the solid
  Vec on_shape;
  Vec normal;  ///< unit, the gradient of the distance: accurate however small that is
};

/// The point of a triangle nearest to the origin: its distance is the least but for 16 eps of the
/// diagonal of the box around both.
inline Vec nearestToOrigin(const Triangle& t) { return nearestOnTriangle(Vec::Zero(), t).point; }

/// The cross product of two edges, each component with nearly all its digits however thin the
/// triangle is.
Vec faceNormal(const Triangle& triangle);

/// The point of the core of a bounded solid, other than a convex one, nearest to p. For boxes,
/// capsules and spheres the normal of a point of the core means nothing.
NearestPoint nearestPoint(const Solid& solid, const Vec& p);

}  // namespace kios::shape
