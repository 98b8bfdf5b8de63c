// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include "fcl_kios/fcl_own.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/query/mesh_queries.h"
#include "model/kios_model.h"
#include "query/mesh_and_other.h"

namespace kios {

/// Throws std::invalid_argument if rel_err is 1 or more. FCL ignores it, so that callers who
/// confuse the request's arguments never noticed; an error that is meant is smaller.
template <typename S>
void requireRelativeError(const fcl::DistanceRequest<S>& request) {
  if (!(request.rel_err >= 1)) return;  // what is negative or NaN is refused by the query
  std::ostringstream message;
  message << "fcl_kios: DistanceRequest::rel_err is " << request.rel_err
          << ", but must be below 1: fcl::DistanceRequest takes (enable_nearest_points, "
             "enable_signed_distance, rel_err, abs_err, distance_tolerance, gjk_solver_type); set "
             "its members by name, rel_err = 0 for exact distances (kios::distance() takes larger "
             "errors).";
  throw std::invalid_argument(message.str());
}

template <typename S>
std::size_t collide(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
                    const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2,
                    const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  const Model<S>*model1 = asModel(o1), *model2 = asModel(o2);
  if (model1 && model2) return collideMeshes(*model1, tf1, *model2, tf2, request, result);
  if (model1) return collideOther(*model1, tf1, *o2, tf2, request, result);
  if (model2) return collideOther(*model2, tf2, *o1, tf1, request, result);
  return fcl_own::collide(o1, tf1, o2, tf2, request, result);
}

template <typename S>
S distance(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
           const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2,
           const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  const Model<S>*model1 = asModel(o1), *model2 = asModel(o2);
  if (model1 || model2) requireRelativeError(request);
  if (model1 && model2) return distanceMeshes(*model1, tf1, *model2, tf2, request, result);
  if (model1) return distanceOther(*model1, tf1, *o2, tf2, request, result);
  if (model2) return distanceOther(*model2, tf2, *o1, tf1, request, result);
  return fcl_own::distance(o1, tf1, o2, tf2, request, result);
}

/// The same for two objects; throws std::invalid_argument if either is null.
template <typename S>
std::size_t collide(const fcl::CollisionObject<S>* o1, const fcl::CollisionObject<S>* o2,
                    const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  detail::requireObjects(o1, o2);
  return kios::collide(o1->collisionGeometry().get(), o1->getTransform(),
                       o2->collisionGeometry().get(), o2->getTransform(), request, result);
}

template <typename S>
S distance(const fcl::CollisionObject<S>* o1, const fcl::CollisionObject<S>* o2,
           const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  detail::requireObjects(o1, o2);
  return kios::distance(o1->collisionGeometry().get(), o1->getTransform(),
                        o2->collisionGeometry().get(), o2->getTransform(), request, result);
}

}  // namespace kios
