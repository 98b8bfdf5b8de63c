// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fcl_kios/bv/kios.h"

namespace kios::inspect {

struct Ball {
  fcl::Vector3d center;
  double radius;
};

/// The spheres of a volume relative to the centre of S0, exactly as the volume stores them.
std::vector<Ball> ballsOf(const kIOSd& volume);

/// The boundary of a k-IOS as a closed mesh, wound counter-clockwise seen from outside, relative to
/// the centre of S0. Vertices lie on the boundary, to rounding; those on a crease, where two
/// spheres meet, are shared by the faces of both.
struct Surface {
  struct Face {
    std::array<std::uint32_t, 3> corners;
    int ball;  ///< the sphere that it approximates
  };
  std::vector<fcl::Vector3d> vertices;
  std::vector<Face> faces;
};

/// Triangulates a volume from 20 * 4^subdivisions directions' triangles (0 <= subdivisions <= 6),
/// more where spheres meet. The intersection is convex and so star-shaped about any point inside:
/// each vertex is where a ray from there leaves the first sphere. Directions follow the shape, so
/// that flat and long volumes are covered evenly. Empty if the volume is, or has no interior: that
/// of a single point.
Surface triangulate(const kIOSd& volume, int subdivisions);

/// The unit icosphere that triangulate() starts from: vertices and triangles.
struct Directions {
  std::vector<fcl::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
Directions icosphere(int subdivisions);

}  // namespace kios::inspect
