// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl/dispatch.h"

#include <optional>

#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/continuous_collision_object.h>
#include "fcl_kios/motion.h"
#include "fcl_kios/overloads.h"
#include "model/in_double.h"
#include "model/kios_model.h"
#include "solid/mesh_and_other.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Throws std::invalid_argument if rel_err is 1 or more. FCL ignores it, so that callers who
/// confuse the request's arguments never noticed; an error that is meant is smaller.
template <typename S>
void requireRelativeError(const fcl::DistanceRequest<S>& request) {
  if (!(request.rel_err >= 1)) return;  // the query refuses negative values and NaN
  refuse("DistanceRequest::rel_err is ", request.rel_err,
         ", but must be below 1: fcl::DistanceRequest takes (enable_nearest_points, "
         "enable_signed_distance, rel_err, abs_err, distance_tolerance, gjk_solver_type); set its "
         "members by name, rel_err = 0 for exact distances (kios::distanceBracket() takes larger "
         "errors).");
}

template <typename S>
[[gnu::hot]] std::optional<std::size_t> collideAnyModel(const fcl::CollisionGeometry<S>* a,
                                                        const fcl::Transform3<S>& X_WA,
                                                        const fcl::CollisionGeometry<S>* b,
                                                        const fcl::Transform3<S>& X_WB,
                                                        const fcl::CollisionRequest<S>& request,
                                                        fcl::CollisionResult<S>& result) {
  const Model<S>*mesh_a = asModel(a), *mesh_b = asModel(b);
  if (mesh_a) return MeshAndOther<S>{*mesh_a, X_WA, *b, X_WB, mesh_b}.collide(request, result);
  if (mesh_b) return MeshAndOther<S>{*mesh_b, X_WB, *a, X_WA, mesh_a}.collide(request, result);
  return std::nullopt;
}

template <typename S>
[[gnu::hot]] std::optional<S> distanceOfAnyModel(const fcl::CollisionGeometry<S>* a,
                                                 const fcl::Transform3<S>& X_WA,
                                                 const fcl::CollisionGeometry<S>* b,
                                                 const fcl::Transform3<S>& X_WB,
                                                 const fcl::DistanceRequest<S>& request,
                                                 fcl::DistanceResult<S>& result) {
  const Model<S>*mesh_a = asModel(a), *mesh_b = asModel(b);
  if (mesh_a || mesh_b) requireRelativeError(request);
  if (mesh_a) return MeshAndOther<S>{*mesh_a, X_WA, *b, X_WB, mesh_b}.distance(request, result);
  if (mesh_b) return MeshAndOther<S>{*mesh_b, X_WB, *a, X_WA, mesh_a}.distance(request, result);
  return std::nullopt;
}

/// Both are looked at: null geometries are refused there.
bool anyModel(const fcl::CollisionGeometryd* o1, const fcl::CollisionGeometryd* o2) {
  const bool first = holdsModel(o1), second = holdsModel(o2);
  return first || second;
}

}  // namespace

std::optional<std::size_t> detail::collideModel(const fcl::CollisionGeometryf* o1,
                                                const fcl::Transform3f& tf1,
                                                const fcl::CollisionGeometryf* o2,
                                                const fcl::Transform3f& tf2,
                                                const fcl::CollisionRequestf& request,
                                                fcl::CollisionResultf& result) {
  return collideAnyModel(o1, tf1, o2, tf2, request, result);
}

std::optional<float> detail::distanceOfModel(const fcl::CollisionGeometryf* o1,
                                             const fcl::Transform3f& tf1,
                                             const fcl::CollisionGeometryf* o2,
                                             const fcl::Transform3f& tf2,
                                             const fcl::DistanceRequestf& request,
                                             fcl::DistanceResultf& result) {
  return distanceOfAnyModel(o1, tf1, o2, tf2, request, result);
}

template <>
fcl::DistanceResultd distanceOfAny(const fcl::CollisionGeometryd& a, const fcl::Transform3d& X_WA,
                                   const fcl::CollisionGeometryd& b, const fcl::Transform3d& X_WB,
                                   bool nearest_points) {
  fcl::DistanceResultd result;
  fcl::distance(&a, X_WA, &b, X_WB, fcl::DistanceRequestd(nearest_points), result);
  return result;
}

template <>
fcl::DistanceResultf distanceOfAny(const fcl::CollisionGeometryf& a, const fcl::Transform3f& X_WA,
                                   const fcl::CollisionGeometryf& b, const fcl::Transform3f& X_WB,
                                   bool nearest_points) {
  fcl::DistanceResultf result;
  const fcl::DistanceRequestf request(nearest_points);
  if (distanceOfAnyModel(&a, X_WA, &b, X_WB, request, result)) return result;
  const fcl::DistanceResultd found =
      distanceOfAny(*inDouble(a), fcl::Transform3d(X_WA.cast<double>()), *inDouble(b),
                    fcl::Transform3d(X_WB.cast<double>()), nearest_points);
  result.min_distance = roundedTo<float>(found.min_distance);
  for (int i = 0; i < 2; ++i) result.nearest_points[i] = roundedTo<float>(found.nearest_points[i]);
  result.b1 = found.b1;
  result.b2 = found.b2;
  return result;
}

}  // namespace kios

namespace fcl {
inline namespace kios_overloads {

std::size_t collide(const CollisionGeometry<double>* o1, const Transform3<double>& tf1,
                    const CollisionGeometry<double>* o2, const Transform3<double>& tf2,
                    const CollisionRequest<double>& request, CollisionResult<double>& result) {
  const auto contacts = kios::collideAnyModel(o1, tf1, o2, tf2, request, result);
  return contacts ? *contacts : kios::fcl_own::collide(o1, tf1, o2, tf2, request, result);
}

[[gnu::hot]] std::size_t collide(const CollisionObject<double>* o1,
                                 const CollisionObject<double>* o2,
                                 const CollisionRequest<double>& request,
                                 CollisionResult<double>& result) {
  kios::detail::requireObjects(o1, o2);
  return collide(o1->collisionGeometry().get(), o1->getTransform(), o2->collisionGeometry().get(),
                 o2->getTransform(), request, result);
}

double distance(const CollisionGeometry<double>* o1, const Transform3<double>& tf1,
                const CollisionGeometry<double>* o2, const Transform3<double>& tf2,
                const DistanceRequest<double>& request, DistanceResult<double>& result) {
  const auto apart = kios::distanceOfAnyModel(o1, tf1, o2, tf2, request, result);
  return apart ? *apart : kios::fcl_own::distance(o1, tf1, o2, tf2, request, result);
}

[[gnu::hot]] double distance(const CollisionObject<double>* o1, const CollisionObject<double>* o2,
                             const DistanceRequest<double>& request,
                             DistanceResult<double>& result) {
  kios::detail::requireObjects(o1, o2);
  return distance(o1->collisionGeometry().get(), o1->getTransform(), o2->collisionGeometry().get(),
                  o2->getTransform(), request, result);
}

double continuousCollide(const CollisionGeometry<double>* o1, const MotionBase<double>* motion1,
                         const CollisionGeometry<double>* o2, const MotionBase<double>* motion2,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result) {
  if (kios::anyModel(o1, o2)) {
    return kios::firstContact(*o1, motion1, *o2, motion2, request, result);
  }
  return kios::fcl_own::continuousCollide(o1, motion1, o2, motion2, request, result);
}

double continuousCollide(const CollisionGeometry<double>* o1, const Transform3<double>& tf1_beg,
                         const Transform3<double>& tf1_end, const CollisionGeometry<double>* o2,
                         const Transform3<double>& tf2_beg, const Transform3<double>& tf2_end,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result) {
  if (kios::anyModel(o1, o2)) {
    return kios::firstContact(*o1, tf1_beg, tf1_end, *o2, tf2_beg, tf2_end, request, result);
  }
  return kios::fcl_own::continuousCollide(o1, tf1_beg, tf1_end, o2, tf2_beg, tf2_end, request,
                                          result);
}

double continuousCollide(const CollisionObject<double>* o1, const Transform3<double>& tf1_end,
                         const CollisionObject<double>* o2, const Transform3<double>& tf2_end,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result) {
  kios::detail::requireObjects(o1, o2);
  return continuousCollide(o1->collisionGeometry().get(), o1->getTransform(), tf1_end,
                           o2->collisionGeometry().get(), o2->getTransform(), tf2_end, request,
                           result);
}

double collide(const ContinuousCollisionObject<double>* o1,
               const ContinuousCollisionObject<double>* o2,
               const ContinuousCollisionRequest<double>& request,
               ContinuousCollisionResult<double>& result) {
  kios::detail::requireObjects(o1, o2);
  return continuousCollide(o1->collisionGeometry().get(), o1->getMotion(),
                           o2->collisionGeometry().get(), o2->getMotion(), request, result);
}

}  // namespace kios_overloads
}  // namespace fcl
