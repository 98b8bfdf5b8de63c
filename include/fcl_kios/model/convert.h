// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "fcl_kios/model/model.h"

namespace kios {

namespace detail {
/// Checks that the model is a finished mesh, which toKIOS() does first. Throws
/// std::invalid_argument if not.
void requireConvertible(fcl::BVHBuildState state, fcl::BVHModelType type, int num_tris,
                        int num_bvs);
}  // namespace detail

/// Makes a k-IOS model of a mesh over any other volume of FCL: the same vertices and triangles in
/// the same order, user data, cost density and thresholds. The AABB is computed from the vertices,
/// so that it is right even where the other's is stale (see bounds.h). Vertices are taken as they
/// stand: those from before an update, and the splitter's method, stay behind. Throws
/// std::invalid_argument for a point cloud, an empty or unfinished model, and as makeModel().
template <typename BV>
std::shared_ptr<Model<typename BV::S>> toKIOS(const fcl::BVHModel<BV>& model) {
  using S = typename BV::S;
  detail::requireConvertible(model.build_state, model.getModelType(), model.num_tris,
                             model.getNumBVs());
  const std::vector<fcl::Vector3<S>> vertices(model.vertices, model.vertices + model.num_vertices);
  const std::vector<fcl::Triangle> triangles(model.tri_indices, model.tri_indices + model.num_tris);
  const auto converted = makeModel(vertices, triangles);
  converted->user_data = model.user_data;
  converted->cost_density = model.cost_density;
  converted->threshold_occupied = model.threshold_occupied;
  converted->threshold_free = model.threshold_free;
  converted->computeLocalAABB();
  return converted;
}

}  // namespace kios
