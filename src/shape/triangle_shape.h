// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>

#include "shape/solid.h"

// A triangle against a solid, both in the solid's own frame, in double. Triangles may degenerate to
// segments and points. L below is the extent of the pair as seen from the solid's origin: the
// largest |coordinate| of the triangle plus the solid's reach. No coordinate or length may exceed
// 2^300, and L should be above 2^-300 (squares of smaller lengths underflow).

namespace kios::shape {

using Triangle = TriangleVertices<double>;
class ConvexFaces;

/// True if the closed triangle and the closed, full solid have a point in common. By direct tests,
/// right but for rounding: a pair whose overlap or gap is below 2^-46 L may be judged either way
/// (a convex shape without faces: 2^-36 L). `faces`, unless null, are those of a convex shape;
/// `across`, unless null, is set to a direction from that to the triangle across which they are
/// apart, if GJK came upon one.
bool intersects(const Solid& solid, const Triangle& triangle, const ConvexFaces* faces = nullptr,
                std::optional<Vec>* across = nullptr);

/// Largest |x|_1 of the corners: the size that tolerances of contact are measured by.
inline double sizeOf(const Triangle& t) {
  return std::max({t[0].lpNorm<1>(), t[1].lpNorm<1>(), t[2].lpNorm<1>()});
}

struct TriangleShapeDistance {
  double distance;  ///< 0 if and only if intersects(); else within 2^-43 L of the exact one
  double lower;     ///< proven by a separating slab (but for rounding); distance - lower bounds the
                    ///< error of the distance
  Vec on_triangle;  ///< witness points; one common point at distance 0
  Vec on_shape;
};

/// Distance of a triangle and a solid. Ends early once the pair is proven farther than `required`;
/// `distance` is then above that, but no more than an upper bound.
TriangleShapeDistance distance(const Solid& solid, const Triangle& triangle, double required);

struct TriangleShapeContact {
  Vec position;  ///< a point of both (half-space: halfway from the deepest corner to the surface)
  Vec normal;    ///< unit; moving the triangle by normal * depth ends the overlap
  double depth;  ///< >= 0
};

/// For a pair that intersects(). Moving by depth along the normal always ends the overlap. It is
/// the least such move for spheres, capsules, boxes, half-spaces and planes (for the plane FCL's:
/// to the side that has more of the triangle); the least along the normals of the faces and of the
/// triangle for convex shapes; a local minimum to 2^-7 rad for the others.
TriangleShapeContact contact(const Solid& solid, const Triangle& triangle,
                             const ConvexFaces* faces = nullptr);

}  // namespace kios::shape
