// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/config.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/model/model.h"
#include "fcl_kios/search/counts.h"

#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>

namespace kios {

/// Answers fcl::collide and fcl::distance of an octree and a mesh over k-IOS (docs/shapes.md).
/// Poses X_WO of the octree and X_WM of the mesh in the world. The octree is object 1 of the
/// results whatever the order of FCL's call, and b1 the query cell id, as FCL does. Occupied cells
/// are full boxes; collide follows FCL's thresholds for occupied, uncertain and free cells. An
/// octree without cells touches nothing and is infinitely far. `counts`, if given, is added to:
/// volume_tests, and leaf_kernels for pairs of a cell and a triangle.
///
/// Throw std::invalid_argument if the model is not a finished mesh, a pose is not rigid, or an
/// error bound is negative or NaN.
template <typename S>
std::size_t collideOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                          const Model<S>& model, const fcl::Transform3<S>& X_WM,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts = nullptr);
template <typename S>
S distanceOctree(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                 const Model<S>& model, const fcl::Transform3<S>& X_WM,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 SearchCounts* counts = nullptr);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
