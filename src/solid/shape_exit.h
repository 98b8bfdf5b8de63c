// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <fcl/geometry/collision_geometry.h>
#include "fcl_kios/solid/penetration.h"

namespace kios {

/// A point of the shape, in the world, that lies in the solid; none if the shape, whose surface
/// must not meet the solid's, lies outside. Half-spaces and planes are in no solid.
template <typename S>
std::optional<fcl::Vector3<S>> shapePointIn(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
                                            const fcl::CollisionGeometry<S>& shape,
                                            const fcl::Transform3<S>& X_WS);

/// Returns a short translation of the shape that is proven to part it from a solid that it
/// overlaps, and no lower bound: away from the hull along a few directions, shortened by bisection.
template <typename S>
Penetration shapeExit(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
                      const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS);

}  // namespace kios
