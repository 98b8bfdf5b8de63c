// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A file of a planner that has never heard of kIOS: FCL's headers only, objects from elsewhere.
// It is right because it is compiled with `-include fcl_kios/overloads.h`.
#include "generic.h"

#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace generic {

bool collides(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, request, result) > 0 && result.isCollision();
}

double distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  fcl::distance(&a, &b, request, result);
  return result.min_distance;
}

bool collides(const fcl::BroadPhaseCollisionManagerd& manager) {
  fcl::DefaultCollisionData<double> data;
  manager.collide(&data, fcl::DefaultCollisionFunction<double>);
  return data.result.isCollision();
}

double distance(const fcl::BroadPhaseCollisionManagerd& manager) {
  fcl::DefaultDistanceData<double> data;
  manager.distance(&data, fcl::DefaultDistanceFunction<double>);
  return data.result.min_distance;
}

}  // namespace generic
