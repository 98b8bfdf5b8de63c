// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/geometry/collision_geometry.h>

namespace kios {

/// All that the distances to one of FCL's shapes depend on but its pose: its sizes, or the vertices
/// and faces of a convex. A caller may change them in place at any time, and nothing tells so.
///
/// Returns true if `values` are still the shape's; else writes them. Of a class that
/// isn't one of FCL's own nothing is known, nor of octrees, which take up measurements, and meshes
/// over other volumes: false, and no values.
template <typename S>
bool updateShapeValues(const fcl::CollisionGeometry<S>& geometry, std::vector<S>& values);

}  // namespace kios
