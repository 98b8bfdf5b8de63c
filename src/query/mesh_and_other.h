// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/query/octree_queries.h"
#include "fcl_kios/query/shape_queries.h"
#include "model/kios_model.h"
#include "shape/shape_solid.h"

namespace kios {

/// A mesh over k-IOS against anything but another. Results have FCL's order, whatever that of the
/// call: mesh and shape, octree and mesh.
template <typename S>
std::size_t collideOther(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  if (isShape(other)) return collideShape(model, X_WM, other, X_WO, request, result);
#if FCL_HAVE_OCTOMAP
  if (other.getObjectType() == fcl::OT_OCTREE) {
    return collideOctree(static_cast<const fcl::OcTree<S>&>(other), X_WO, model, X_WM, request,
                         result);
  }
#endif
  refusePair<S>("collide", model, other);
}

template <typename S>
S distanceOther(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  if (isShape(other)) return distanceShape(model, X_WM, other, X_WO, request, result);
#if FCL_HAVE_OCTOMAP
  if (other.getObjectType() == fcl::OT_OCTREE) {
    return distanceOctree(static_cast<const fcl::OcTree<S>&>(other), X_WO, model, X_WM, request,
                          result);
  }
#endif
  refusePair<S>("distance", model, other);
}

}  // namespace kios
