// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include "fcl_kios/fcl_own.h"
#include "fcl_kios/overloads.h"
#include "model/kios_model.h"
#include "solid/mesh_and_other.h"
#include "volume/errors.h"

namespace kios {

/// Throws std::invalid_argument if rel_err is 1 or more. FCL ignores it, so that callers who
/// confuse the request's arguments never noticed; an error that is meant is smaller.
template <typename S>
void requireRelativeError(const fcl::DistanceRequest<S>& request) {
  if (!(request.rel_err >= 1)) return;  // the query refuses negative values and NaN
  refuse(
      "DistanceRequest::rel_err is ", request.rel_err,
      ", but must be below 1: fcl::DistanceRequest takes (enable_nearest_points, "
      "enable_signed_distance, rel_err, abs_err, distance_tolerance, gjk_solver_type); set its "
      "members by name, rel_err = 0 for exact distances (kios::distance() takes larger errors).");
}

template <typename S>
[[gnu::hot]] std::size_t collide(const fcl::CollisionGeometry<S>* a, const fcl::Transform3<S>& X_WA,
                                 const fcl::CollisionGeometry<S>* b, const fcl::Transform3<S>& X_WB,
                                 const fcl::CollisionRequest<S>& request,
                                 fcl::CollisionResult<S>& result) {
  const Model<S>*mesh_a = asModel(a), *mesh_b = asModel(b);
  if (mesh_a) return MeshAndOther<S>{*mesh_a, X_WA, *b, X_WB, mesh_b}.collide(request, result);
  if (mesh_b) return MeshAndOther<S>{*mesh_b, X_WB, *a, X_WA, mesh_a}.collide(request, result);
  return fcl_own::collide(a, X_WA, b, X_WB, request, result);
}

template <typename S>
[[gnu::hot]] S distance(const fcl::CollisionGeometry<S>* a, const fcl::Transform3<S>& X_WA,
                        const fcl::CollisionGeometry<S>* b, const fcl::Transform3<S>& X_WB,
                        const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  const Model<S>*mesh_a = asModel(a), *mesh_b = asModel(b);
  if (mesh_a || mesh_b) requireRelativeError(request);
  if (mesh_a) return MeshAndOther<S>{*mesh_a, X_WA, *b, X_WB, mesh_b}.distance(request, result);
  if (mesh_b) return MeshAndOther<S>{*mesh_b, X_WB, *a, X_WA, mesh_a}.distance(request, result);
  return fcl_own::distance(a, X_WA, b, X_WB, request, result);
}

}  // namespace kios

// The overloads of fcl_kios/overloads.h for one scalar, which can't be a parameter: FCL's templates
// would be as good a match.
// NOLINTBEGIN(bugprone-macro-parentheses): a type is not put in parentheses.
#define KIOS_OVERLOADS(S)                                                                      \
  std::size_t collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,                \
                      const CollisionGeometry<S>* o2, const Transform3<S>& tf2,                \
                      const CollisionRequest<S>& request, CollisionResult<S>& result) {        \
    return kios::collide(o1, tf1, o2, tf2, request, result);                                   \
  }                                                                                            \
  [[gnu::hot]] std::size_t collide(const CollisionObject<S>* o1, const CollisionObject<S>* o2, \
                                   const CollisionRequest<S>& request,                         \
                                   CollisionResult<S>& result) {                               \
    kios::detail::requireObjects(o1, o2);                                                      \
    return kios::collide(o1->collisionGeometry().get(), o1->getTransform(),                    \
                         o2->collisionGeometry().get(), o2->getTransform(), request, result);  \
  }                                                                                            \
  S distance(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,                         \
             const CollisionGeometry<S>* o2, const Transform3<S>& tf2,                         \
             const DistanceRequest<S>& request, DistanceResult<S>& result) {                   \
    return kios::distance(o1, tf1, o2, tf2, request, result);                                  \
  }                                                                                            \
  [[gnu::hot]] S distance(const CollisionObject<S>* o1, const CollisionObject<S>* o2,          \
                          const DistanceRequest<S>& request, DistanceResult<S>& result) {      \
    kios::detail::requireObjects(o1, o2);                                                      \
    return kios::distance(o1->collisionGeometry().get(), o1->getTransform(),                   \
                          o2->collisionGeometry().get(), o2->getTransform(), request, result); \
  }
// NOLINTEND(bugprone-macro-parentheses)
