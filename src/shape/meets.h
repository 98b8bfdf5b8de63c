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

/// The distance of a triangle and the core of a bounded solid, other than a convex one, by closed
/// forms: of a corner, of an edge, of the face. Each comes with the slab across it; a feature is
/// the nearest one if the rest of the triangle lies beyond that slab, but for 2^-49 of sizeOf(t)
/// and the solid's reach. Corners and edges are evaluated by their own coordinates alone, so that
/// triangles that share a nearest one are bitwise as far. Returns false if no slab decides, or if
/// the pair is nearer than 2^-36 of those lengths: GJK and the kernels of close pairs then do. Ends
/// early, with `upper` no more than an upper bound, once the pair is proven farther than
/// `required`.
bool distanceByCertificate(const Solid& solid, const Triangle& triangle, double required,
                           CoreDistance& core);

/// The nearest of these features of a cylinder, cone or ellipsoid and a triangle that don't
/// intersect, for those that GJK, which sees chords of them, can't resolve: within about 2^-48 of
/// the extent.
CoreDistance nearestFeature(const Solid& solid, const Triangle& triangle);

}  // namespace kios::shape
