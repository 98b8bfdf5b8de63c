// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <fcl/common/types.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include "fcl_kios/detail/bv_traits.h"
#include "fcl_kios/detail/bvh_build.h"

namespace kios {

/// A mesh over k-IOS.
template <typename S>
using Model = fcl::BVHModel<kIOS<S>>;
using Modeld = Model<double>;
using Modelf = Model<float>;

/// Builds a model with every check that FCL's own calls can't make. Throws std::invalid_argument
/// if there is no triangle, an index is out of range, or a vertex (used or not) is not finite, and
/// std::bad_alloc if memory runs out.
template <typename S>
std::shared_ptr<Model<S>> makeModel(const std::vector<fcl::Vector3<S>>& vertices,
                                    const std::vector<fcl::Triangle>& triangles);

/// Builds a model of points: each is a triangle of its own, whose corners are that point, and its
/// number is the triangle's in contacts and distances. Every call serves it as it serves meshes,
/// refits included; it bounds nothing, so that no solid is made of it. What is to keep a distance
/// from the points asks closerThan(), or pads the robot's links. BVHModel's own calls do the same:
/// a model that gets vertices and no triangle until endModel() has these triangles thereafter.
/// Throws std::invalid_argument if there is no point or one isn't finite, and std::bad_alloc if
/// memory runs out.
template <typename S>
std::shared_ptr<Model<S>> makePointCloud(const std::vector<fcl::Vector3<S>>& points);

/// Throws std::invalid_argument unless the model is a finished mesh with indices in range and
/// finite vertices. The message says what is wrong. O(vertices + triangles).
template <typename S>
void validate(const Model<S>& model);

namespace detail {
/// Checks that the model is finished, which toKIOS() does first. Throws std::invalid_argument if
/// not.
void requireConvertible(fcl::BVHBuildState state, int num_primitives, int num_bvs);
}  // namespace detail

/// Makes a k-IOS model of a mesh or point cloud over any other volume of FCL: the same vertices and
/// triangles in the same order, user data, cost density and thresholds. The AABB is computed from
/// the vertices, so that it is right even where the other's is stale (see bounds.h). Vertices are
/// taken as they stand: those from before an update, and the splitter's method, stay behind. Throws
/// std::invalid_argument for an empty or unfinished model, and as makeModel().
template <typename BV>
std::shared_ptr<Model<typename BV::S>> toKIOS(const fcl::BVHModel<BV>& model) {
  using S = typename BV::S;
  const bool cloud = model.getModelType() == fcl::BVH_MODEL_POINTCLOUD;
  detail::requireConvertible(model.build_state, cloud ? model.num_vertices : model.num_tris,
                             model.getNumBVs());
  const std::vector<fcl::Vector3<S>> vertices(model.vertices, model.vertices + model.num_vertices);
  const std::vector<fcl::Triangle> triangles(model.tri_indices, model.tri_indices + model.num_tris);
  const auto converted = cloud ? makePointCloud(vertices) : makeModel(vertices, triangles);
  converted->user_data = model.user_data;
  converted->cost_density = model.cost_density;
  converted->threshold_occupied = model.threshold_occupied;
  converted->threshold_free = model.threshold_free;
  converted->computeLocalAABB();
  return converted;
}

/// Does nothing, as endModel() and refits prepare what queries search. Deprecated, gone in the next
/// version. Throws std::invalid_argument if the model is not a finished mesh.
template <typename S>
void prepare(const Model<S>& model);

/// Returns the bytes of the tree that queries search, beside FCL's; 0 of what isn't a finished
/// mesh. Copies of a model and models of equal content, anywhere in the process, share one.
template <typename S>
std::size_t preparedBytes(const Model<S>& model);

/// Makes a model right whose vertices were written without beginReplaceModel() or
/// beginUpdateModel(): refits all that was made of them. Throws as
/// validate(), and std::bad_alloc if memory runs out: the model then is unfinished.
template <typename S>
void verticesChanged(Model<S>& model);
template <typename S>
[[deprecated("now verticesChanged()")]] void invalidate(Model<S>& model) {
  verticesChanged(model);
}

/// Names the instruction set that searches: AVX3 (AVX-512), AVX2, SSE4, NEON, or EMU128 or SCALAR
/// (plain C++). The environment variable FCL_KIOS_SIMD chooses one, for tests; answers don't depend
/// on it.
const char* simdTarget();

}  // namespace kios

// Axis-aligned boxes after a model was deformed. FCL's endReplaceModel() and endUpdateModel()
// refresh the tree of volumes, but neither the model's AABB nor those of the objects that hold it,
// by which every broadphase manager prunes: without these calls a manager misses pairs. They write
// to the model and the objects, so no query may run on them meanwhile.

namespace fcl {
template <typename S>
class CollisionGeometry;
template <typename S>
class CollisionObject;
template <typename S>
class BroadPhaseCollisionManager;
}  // namespace fcl

namespace kios {

/// Recomputes a geometry's AABB, centre and radius, and the world AABBs of the `objects` that hold
/// it. Each manager they are in needs update() afterwards; FCL's SaPCollisionManager::update() is
/// wrong for boxes that change their size, and crashes: there clear() and register the objects
/// anew.
template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   const std::vector<fcl::CollisionObject<S>*>& objects);

/// Refreshes all objects of a manager, which is updated, too (SaP: filled anew). For a geometry
/// whose objects are in several managers, call it once for each.
template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   fcl::BroadPhaseCollisionManager<S>& manager);

}  // namespace kios
