// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/narrowphase/collision_object.h>

// Queries as a file makes them that knows FCL's headers alone.

namespace fcl_only {

void collide(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);
void collideGeometries(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);
void distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);
void collide(fcl::BroadPhaseCollisionManagerd& manager);
void distance(fcl::BroadPhaseCollisionManagerd& manager);
/// Nothing but the geometry's type.
bool isMesh(const fcl::CollisionObjectd& object);

}  // namespace fcl_only
