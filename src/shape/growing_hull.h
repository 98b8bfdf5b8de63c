// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/triangle_shape.h"

namespace kios::shape {

/// Distance of a triangle and a convex shape whose faces aren't known, 0 if they meet: that of
/// triangles over a few of the points, by the certified kernel. The point that lies farthest
/// towards the triangle joins them until there is none beyond. Costs the cube of their number.
// The direction towards the triangle loses digits as the distance falls, and a point beyond might
// be passed over for that: so points count as far as the direction may be off.
TriangleShapeDistance distanceToPoints(const Solid& convex, const Triangle& triangle);

}  // namespace kios::shape
