// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "fcl/narrowphase/collision_request.h"
#include "fcl/narrowphase/collision_result.h"
#include "fcl/narrowphase/distance_request.h"
#include "fcl/narrowphase/distance_result.h"
#include "fcl_kios/fcl/model.h"

namespace kios {

/// fcl::collide and fcl::distance of two meshes over k-IOS, with FCL's conventions for requests
/// and results. Throw as initialize() of the traversal nodes does.
template <typename S>
std::size_t collideMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1,
                          const Model<S>& model2, const fcl::Transform3<S>& tf2,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);
template <typename S>
S distanceMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1, const Model<S>& model2,
                 const fcl::Transform3<S>& tf2, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result);

}  // namespace kios
