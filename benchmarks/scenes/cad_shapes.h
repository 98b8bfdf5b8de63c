// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "mesh.h"

// Meshes as CAD programs tessellate parts: flat faces, few vertices where the shape is straight, so
// that triangles are long and thin. Closed, vertices shared, counter-clockwise seen from outside.

namespace kios::scenes {

/// Prism about z from z = 0 to `length` whose side is `strips` rectangles of length x width, two
/// triangles each; caps are fans about their centres: 4 strips triangles.
Mesh stripCylinder(int strips, double length, double width);

/// Holds a point of a profile that turns about z.
struct ProfilePoint {
  double radius;
  double z;
};

/// Returns a solid of revolution. The profile runs upwards outside the solid's axis, from a point
/// on it (radius 0) to another: its ends become fans, each step between two a ring of long quads.
Mesh turnedPart(const std::vector<ProfilePoint>& profile, int segments);

/// Bar along z from z = 0 to `length` over a rectangle of sides x, y, its upright edges rounded by
/// `fillet` in so many steps each: 2 * 4 (steps + 1) strips as long as the bar, ends as fans.
Mesh filletedBar(double x, double y, double length, double fillet, int steps);

/// Returns a cylinder from z = 0 to `length` with a chamfered flange of 1.35 times its radius at
/// each end.
Mesh flangedCylinder(double radius, double length, int segments);

/// Returns a block [-size/2, size/2] with a round bore along z, upright edges rounded by
/// `rounding`, chamfers at top and bottom. `segments`, a multiple of 4, counts the bore's edges; 12
/// segments triangles. Sides are single long quads; top and bottom are fans between the bore and
/// the roundings.
Mesh boredBlock(const fcl::Vector3d& size, double rounding, double chamfer, double bore_radius,
                int segments);

/// Returns the mesh with its vertices at X p.
Mesh moved(const fcl::Transform3d& X, Mesh mesh);

/// Returns all triangles of the parts, in order, as one mesh.
Mesh merged(const std::vector<Mesh>& parts);

/// Returns the mesh with equal vertices made one, in order of first use.
Mesh welded(const Mesh& mesh);

}  // namespace kios::scenes
