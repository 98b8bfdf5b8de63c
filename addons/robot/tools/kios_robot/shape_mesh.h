// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <fcl/geometry/collision_geometry.h>

namespace kios::robot_tool {

/// Triangles to look at.
struct ShapeMesh {
  std::vector<fcl::Vector3d> vertices;
  std::vector<std::uint32_t> corners;  ///< three a triangle
};

/// A mesh as it is, a bounded shape in facets, a half-space or plane as a square of the side
/// `extent` about the point of it that is nearest to the origin. Empty for octrees.
ShapeMesh meshOf(const fcl::CollisionGeometryd& geometry, double extent);

}  // namespace kios::robot_tool
