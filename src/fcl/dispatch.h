// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/distance_result.h>

namespace kios {

/// Distance of any two geometries, asked as fcl::distance() does with its default request. Pairs of
/// floats without a kIOS model are asked in double, of which libfcl has the tables, and the answer
/// is rounded once.
template <typename S>
fcl::DistanceResult<S> distanceOfAny(const fcl::CollisionGeometry<S>& a,
                                     const fcl::Transform3<S>& X_WA,
                                     const fcl::CollisionGeometry<S>& b,
                                     const fcl::Transform3<S>& X_WB, bool nearest_points);

}  // namespace kios
