// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>

#include "mesh.h"

// Deterministic meshes in their own frames. Closed shapes surround the origin and wind
// counter-clockwise seen from outside; vertices are shared unless a function says otherwise.

namespace kios::scenes {

/// Returns a torus about z with knobs, hole radius 0.49, outer radius 1.21, 3240 triangles: the
/// generated counterpart of PQP's torus2.
Mesh knobbyTorus();

/// Returns a torus about z whose centre line is bent into a saddle, radii 0.36 and 0.1, 1332
/// triangles: the generated counterpart of PQP's torus1.
Mesh bentTorus();

/// Returns a star-shaped blob with smooth bumps, radius 0.48 to 0.95, 2204 triangles: as many as
/// PQP's bunny and about its size.
Mesh bumpyBlob();

/// Returns a torus about z with bumps, major radius 1 and tube radius 0.34 to 0.46. The number of
/// triangles is even and within 1 % of `triangles` for 100 and more; the shape hardly depends on
/// it.
Mesh bumpyTorus(int triangles);

/// Returns a box [-size/2, size/2] with n x n squares of two triangles on each face, vertices
/// shared between faces: 12 n^2 triangles.
Mesh subdividedBox(const fcl::Vector3d& size, int n);

/// Returns an icosahedron subdivided `subdivisions` times, vertices on the sphere: 20 *
/// 4^subdivisions triangles.
Mesh icosphere(double radius, int subdivisions);

/// Returns a sphere with poles on z, `rings` >= 2 bands of latitude, `segments` >= 3 of longitude:
/// 2 segments (rings - 1) triangles, slivers near the poles.
Mesh uvSphere(double radius, int rings, int segments);

/// Returns an open height field z = amplitude sin(2 pi x / width) sin(2 pi y / depth) over a
/// centred rectangle, nx x ny squares of two triangles; flat, with all triangles coplanar, for
/// amplitude 0.
Mesh sheet(double width, double depth, int nx, int ny, double amplitude);

Mesh singleTriangle(const fcl::Vector3d& a, const fcl::Vector3d& b, const fcl::Vector3d& c);

/// Returns `count` unconnected triangles. First corners are uniform in the cube [-half_width,
/// half_width]^3; the two edges there have uniform directions and log-uniform lengths in [min_edge,
/// max_edge].
Mesh randomSoup(int count, double half_width, double min_edge, double max_edge, std::uint64_t seed);

/// Returns the triangles of a mesh, each with vertices of its own and shrunk towards its centroid
/// by a factor 1 - s, s log-uniform in [least, most]: a soup that cannot be welded.
Mesh shrunkSoup(const Mesh& mesh, double least, double most, std::uint64_t seed);

}  // namespace kios::scenes
