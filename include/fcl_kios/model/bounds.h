// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <fcl/common/types.h>

// Axis-aligned boxes after a model was deformed. FCL's endReplaceModel() and endUpdateModel()
// refresh the tree of volumes, but neither the model's AABB nor those of the objects that hold it,
// by which every broadphase manager prunes: without these calls a manager misses pairs. They write
// to the model and the objects, so no query may run on them meanwhile.

namespace fcl {
template <typename S>
class CollisionGeometry;
template <typename S>
class CollisionObject;
template <typename S>
class BroadPhaseCollisionManager;
}  // namespace fcl

namespace kios {

/// Recomputes a geometry's AABB, centre and radius, and the world AABBs of the `objects` that hold
/// it. Each manager they are in needs update() afterwards; FCL's SaPCollisionManager::update() is
/// wrong for boxes that change their size, and crashes: there clear() and register the objects
/// anew.
template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   const std::vector<fcl::CollisionObject<S>*>& objects);

/// Refreshes all objects of a manager, which is updated, too (SaP: filled anew). For a geometry
/// whose objects are in several managers, call it once for each.
template <typename S>
void refreshBounds(fcl::CollisionGeometry<S>& geometry,
                   fcl::BroadPhaseCollisionManager<S>& manager);

}  // namespace kios
