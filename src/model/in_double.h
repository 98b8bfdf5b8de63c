// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <fcl/geometry/collision_geometry.h>

namespace kios {

/// Makes the same geometry in double, whose queries libfcl holds; a geometry in double is the
/// argument itself, which must outlive what is returned. An octree shares its cells. A mesh over
/// another volume of FCL becomes a k-IOS model, at the cost of its build: kios::toKIOS() spares
/// that. A geometry that is none of FCL's has neither content nor a query, as in FCL.
std::shared_ptr<const fcl::CollisionGeometryd> inDouble(const fcl::CollisionGeometryf& geometry);
std::shared_ptr<const fcl::CollisionGeometryd> inDouble(const fcl::CollisionGeometryd& geometry);

}  // namespace kios
