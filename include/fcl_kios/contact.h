// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <fcl/config.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/detail/counts.h"
#include "fcl_kios/model.h"

namespace kios {

/// Answers fcl::collide and fcl::distance of two meshes over k-IOS, with FCL's conventions for
/// requests and results. Poses X_WA and X_WB in the world, points and normals of results there too,
/// lengths in the models' units. Collision is exact; distance is right to 16 eps of the extent of
/// the nearest triangles, or to what the request allows (docs/guarantees.md). Safe from many
/// threads. Source of the tests of volumes: paper, IV. Throw std::invalid_argument if a model is
/// not a finished mesh, a pose is not rigid, or an error bound is negative or NaN.
///
/// A pair that the root volumes can't decide is searched in the trees that the models have since
/// they were finished. `counts`, if given, is added to.
template <typename S>
std::size_t collideMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                          const fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                          fcl::CollisionResult<S>& result, SearchCounts* counts = nullptr);
template <typename S>
S distanceMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                 const fcl::Transform3<S>& X_WB, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result, SearchCounts* counts = nullptr);

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
