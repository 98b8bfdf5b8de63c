// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl/fcl_only.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace fcl_only {

void collide(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  fcl::CollisionResultd result;
  fcl::collide(&a, &b, fcl::CollisionRequestd(), result);
}

void collideGeometries(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  fcl::CollisionResultd result;
  fcl::collide(a.collisionGeometry().get(), a.getTransform(), b.collisionGeometry().get(),
               b.getTransform(), fcl::CollisionRequestd(), result);
}

void distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  fcl::DistanceResultd result;
  fcl::distance(&a, &b, fcl::DistanceRequestd(), result);
}

// Callbacks of its own: FCL's default ones would be one with those of files that see our header.
void collide(fcl::BroadPhaseCollisionManagerd& manager) {
  manager.collide(nullptr, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void*) {
    collide(*a, *b);
    return false;
  });
}

void distance(fcl::BroadPhaseCollisionManagerd& manager) {
  manager.distance(nullptr, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void*, double&) {
    distance(*a, *b);
    return false;
  });
}

bool isMesh(const fcl::CollisionObjectd& object) {
  return object.getObjectType() == fcl::OT_BVH && object.getNodeType() == fcl::BV_UNKNOWN &&
         object.collisionGeometry()->getObjectType() == fcl::OT_BVH;
}

}  // namespace fcl_only
