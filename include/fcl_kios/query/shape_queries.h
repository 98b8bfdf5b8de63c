// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/model/model.h"
#include "fcl_kios/search/counts.h"

namespace kios {

/// Answers fcl::collide and fcl::distance of a mesh over k-IOS and one of FCL's nine shapes. Docs:
/// docs/shapes.md. Poses X_WM of the mesh and X_WS of the shape in the world, results there too,
/// with the mesh as object 1 whatever the order of FCL's call, as FCL does. The shape is full, the
/// plane infinitely thin; distance at overlap is 0. No solver of FCL's is used, and the model is
/// not copied. Safe from many threads. `counts`, if given, is added to: volume_tests, leaf_kernels,
/// exact.
///
/// Throw std::invalid_argument if the model is not a finished mesh, the shape is none of the nine
/// or has a size that is negative or not finite, a pose is not rigid, or an error bound is negative
/// or NaN.
template <typename S>
std::size_t collideShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                         SearchCounts* counts = nullptr);
template <typename S>
S distanceShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                SearchCounts* counts = nullptr);

}  // namespace kios
