// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/geometry/collision_geometry.h>

namespace kios {

/// True for objects of one of FCL's own classes of shapes. Of a class derived from one, FCL's
/// answers may depend on more than shapeValues().
template <typename S>
bool isShapeOfFcl(const fcl::CollisionGeometry<S>& geometry);

/// Returns all that the distances to a shape depend on but its pose: its sizes, or the vertices and
/// faces of a convex. A caller may change them in place at any time, and nothing tells so. Empty
/// for what is no shape by its node type.
template <typename S>
std::vector<S> shapeValues(const fcl::CollisionGeometry<S>& geometry);

/// True if shapeValues() would return just these values.
template <typename S>
bool hasShapeValues(const fcl::CollisionGeometry<S>& geometry, const std::vector<S>& values);

}  // namespace kios
