// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fcl/narrowphase/continuous_collision.h>
#include "fcl/dispatch.h"
#include "fcl_kios/continuous/continuous.h"
#include "fcl_kios/overloads.h"

namespace fcl {
inline namespace kios_overloads {

namespace {

/// Both are looked at: null geometries are refused there.
bool anyModel(const CollisionGeometry<double>* o1, const CollisionGeometry<double>* o2) {
  const bool first = kios::holdsModel(o1), second = kios::holdsModel(o2);
  return first || second;
}

}  // namespace

KIOS_OVERLOADS(double)

double continuousCollide(const CollisionGeometry<double>* o1, const MotionBase<double>* motion1,
                         const CollisionGeometry<double>* o2, const MotionBase<double>* motion2,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result) {
  if (anyModel(o1, o2)) {
    return kios::firstContact(*o1, motion1, *o2, motion2, request, result);
  }
  return kios::fcl_own::continuousCollide(o1, motion1, o2, motion2, request, result);
}

double continuousCollide(const CollisionGeometry<double>* o1, const Transform3<double>& tf1_beg,
                         const Transform3<double>& tf1_end, const CollisionGeometry<double>* o2,
                         const Transform3<double>& tf2_beg, const Transform3<double>& tf2_end,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result) {
  if (anyModel(o1, o2)) {
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
