// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "shape/gjk.h"
#include "shape/triangle_shape.h"

namespace kios::shape {

/// Bounded solids without GJK: whether they have a point in common with a triangle. `common`, if
/// not null, becomes one, to a few eps of the extent. A convex shape must have faces.
bool meets(const Solid& solid, const Triangle& triangle, Vec* common);

/// True if the coordinates of a triangle close to an ellipsoid of such radii are too large, in
/// units of the radii, for distances in those units.
bool isLargeInRadii(const Vec& radii, const Triangle& triangle);

/// Slabs wider than this prove a pair apart, whatever the rounding.
inline double clearOf(const Triangle& t, const CoreDistance& core) {
  return 0x1p-40 * (sizeOf(t) + core.on_core.lpNorm<1>());
}

/// Decides it where GJK, that found no clear slab, may have found a common point.
bool meetsAt(const Solid& solid, const Triangle& triangle, const CoreDistance& core, Vec* common);

}  // namespace kios::shape
