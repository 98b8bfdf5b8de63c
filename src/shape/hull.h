// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/triangle_shape.h"

// A convex shape by its faces, for what is too close for GJK. O(faces).

namespace kios::shape {

/// Whether a triangle meets the full hull: exact for the faces, by rounding for corners inside.
bool meetsHull(const Solid& convex, const Triangle& triangle);

/// Distance of a triangle and a hull that don't intersect: that of the nearest face, within 16 eps
/// of the extent.
TriangleShapeDistance distanceToHull(const Solid& convex, const Triangle& triangle);

/// The face, its unit normal outwards, by which a triangle leaves the hull on the shortest way.
struct FaceExit {
  Vec normal;
  double depth;
};
FaceExit leastFaceExit(const Solid& convex, const Triangle& triangle);

}  // namespace kios::shape
