// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/narrowphase/collision_object.h>

namespace generic {

bool collides(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);
double distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b);

// Any pair within the manager, by FCL's default callbacks.
bool collides(const fcl::BroadPhaseCollisionManagerd& manager);
double distance(const fcl::BroadPhaseCollisionManagerd& manager);

}  // namespace generic
