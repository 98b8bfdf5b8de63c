// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>

namespace kios::bench {

/// Holds FCL's own functions. They are called with explicit template arguments, ahead of our
/// overloads: the rows of FCL's volumes must not pay for our dispatch.
struct FclCalls {
  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    fcl::distance<double>(a, b, request, result);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    fcl::collide<double>(a, b, request, result);
  }
  static void continuousCollide(const fcl::CollisionGeometryd* a, const fcl::MotionBased* motion_a,
                                const fcl::CollisionGeometryd* b, const fcl::MotionBased* motion_b,
                                const fcl::ContinuousCollisionRequestd& request,
                                fcl::ContinuousCollisionResultd& result) {
    fcl::continuousCollide<double>(a, motion_a, b, motion_b, request, result);
  }
};

}  // namespace kios::bench

#include "fcl_kios/overloads.h"

namespace kios::bench {

/// The calls as a user writes them, which bind to our overloads.
struct KiosCalls {
  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    fcl::distance(a, b, request, result);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    fcl::collide(a, b, request, result);
  }
};

}  // namespace kios::bench
