// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model.h"

#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/narrowphase/collision_object.h>

namespace kios {

template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   const std::vector<fcl::CollisionObject<S>*>& objects) {
  geometry.computeLocalAABB();
  for (fcl::CollisionObject<S>* object : objects) {
    if (object->collisionGeometry().get() == &geometry) object->computeAABB();
  }
}

template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   fcl::BroadPhaseCollisionManager<S>& manager) {
  std::vector<fcl::CollisionObject<S>*> objects;
  manager.getObjects(objects);
  refreshBounds(geometry, objects);
  // SaP's update() takes boxes to move without changing size: it would lose pairs, and its lists.
  if (dynamic_cast<fcl::SaPCollisionManager<S>*>(&manager)) {
    manager.clear();
    manager.registerObjects(objects);
    manager.setup();
  } else {
    manager.update();
  }
}

template void refreshBounds(fcl::CollisionGeometryd&, const std::vector<fcl::CollisionObjectd*>&);
template void refreshBounds(fcl::CollisionGeometryf&, const std::vector<fcl::CollisionObjectf*>&);
template void refreshBounds(fcl::CollisionGeometryd&, fcl::BroadPhaseCollisionManagerd&);
template void refreshBounds(fcl::CollisionGeometryf&, fcl::BroadPhaseCollisionManagerf&);

}  // namespace kios
