// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fcl_kios/solid/penetration.h"
#include "solid/mesh_and_other.h"

namespace kios {

/// A point of the shape, in the world, that lies in the solid; none if the shape, whose surface
/// must not meet the solid's, lies outside. Half-spaces and planes are in no solid.
template <typename S>
std::optional<fcl::Vector3<S>> shapePointIn(const MeshAndOther<S>& pair);

/// Returns a short translation of the shape that is proven to part it from a solid that it
/// overlaps, and no lower bound: away from the hull along a few directions, shortened by bisection.
template <typename S>
Penetration shapeExit(const MeshAndOther<S>& pair);

}  // namespace kios
