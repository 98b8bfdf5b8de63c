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

}  // namespace kios
