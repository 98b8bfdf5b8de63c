// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <typeinfo>

#include "fcl/narrowphase/collision.h"
#include "fcl/narrowphase/distance.h"
#include "fcl/shape_solid.h"
#include "fcl_kios/fcl/fcl_own.h"
#include "fcl_kios/fcl/mesh_queries.h"
#include "fcl_kios/fcl/octree_queries.h"
#include "fcl_kios/fcl/shape_queries.h"
#include "fcl_kios/overloads.h"

namespace kios {

/// The model behind a geometry, nullptr if it is no kIOS model. By type, never by node type: all
/// foreign volumes share BV_UNKNOWN.
template <typename S>
const Model<S>* asModel(const fcl::CollisionGeometry<S>* geometry) {
  if (!geometry) throw std::invalid_argument("fcl_kios: a collision geometry is null.");
  if (geometry->getNodeType() != fcl::BV_UNKNOWN || geometry->getObjectType() != fcl::OT_BVH) {
    return nullptr;
  }
  if (typeid(*geometry) == typeid(Model<S>)) return static_cast<const Model<S>*>(geometry);
  return dynamic_cast<const Model<S>*>(geometry);
}

/// The C++ name of the geometry's type, for messages.
template <typename S>
std::string typeName(const fcl::CollisionGeometry<S>& geometry);

template <typename S>
[[noreturn]] void refusePair(const char* query, const fcl::CollisionGeometry<S>& o1,
                             const fcl::CollisionGeometry<S>& o2) {
  const bool models = o1.getObjectType() == fcl::OT_BVH && o2.getObjectType() == fcl::OT_BVH;
  throw std::invalid_argument(std::string("fcl_kios: ") + query + " of " + typeName(o1) + " and " +
                              typeName(o2) + " is not supported" +
                              (models
                                   ? "; convert the other model by kios::toKIOS(model)."
                                   : "; replace the other by a mesh, built by kios::makeModel()."));
}

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
  requireObjects(o1, o2);
  return kios::collide(o1->collisionGeometry().get(), o1->getTransform(),
                       o2->collisionGeometry().get(), o2->getTransform(), request, result);
}

template <typename S>
S distance(const fcl::CollisionObject<S>* o1, const fcl::CollisionObject<S>* o2,
           const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  requireObjects(o1, o2);
  return kios::distance(o1->collisionGeometry().get(), o1->getTransform(),
                        o2->collisionGeometry().get(), o2->getTransform(), request, result);
}

}  // namespace kios
