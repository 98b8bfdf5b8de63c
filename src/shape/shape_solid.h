// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include "shape/solid.h"

namespace kios {

/// True for FCL's nine shapes (box, sphere, ellipsoid, capsule, cone, cylinder, convex, half-space
/// and plane), recognised by node type as FCL does.
template <typename S>
bool isShape(const fcl::CollisionGeometry<S>& geometry);

/// The shape in its own frame; a convex one's faces stay the geometry's. Throws
/// std::invalid_argument if it is none of the nine, a size is negative, NaN or infinite, a normal
/// is zero, or a convex shape has no vertices.
template <typename S>
shape::Solid toSolid(const fcl::CollisionGeometry<S>& geometry);

}  // namespace kios
