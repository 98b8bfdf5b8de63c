// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/gjk.h"
#include "shape/triangle_shape.h"

// Solids whose core is a polytope (a capsule's segment, a box, a convex shape) by the faces of that
// core, with the exact and certified kernels of two triangles, for pairs that are too close for
// GJK. O(faces).

namespace kios::shape {

/// True if the core is a polytope, other than a point, whose faces are known.
bool hasFaces(const Solid& solid);

/// Returns true if a triangle meets a capsule's segment or a full convex shape; exact. Then
/// `common`, unless null, becomes a common point, to a few eps of the extent.
bool meetsHull(const Solid& solid, const Triangle& triangle, Vec* common = nullptr);

/// Distance of a triangle and a core that don't intersect: that of the nearest face, within 16 eps
/// of the extent. Faces farther than `within` are passed over, which must be the distance of two
/// points of the pair or infinite.
CoreDistance distanceToHull(const Solid& solid, const Triangle& triangle, double within);

/// Distance of a triangle and a convex shape whose faces aren't known, 0 if they meet: that of
/// triangles over a few of the points, by the certified kernel. The point that lies farthest
/// towards the triangle joins them until there is none beyond. Costs the cube of their number.
CoreDistance distanceToPoints(const Solid& convex, const Triangle& triangle);

/// GJK's bracket for the pair, or if that is left open beyond rounding around or below `required`,
/// and the core is a polytope, the distance by its faces or points.
CoreDistance closedBracket(const Solid& solid, const Triangle& triangle, double required,
                           const CoreDistance& core);

}  // namespace kios::shape
