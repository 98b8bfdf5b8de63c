// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/math/motion/tbv_motion_bound_visitor.h>
#include "fcl_kios/volume.h"

// Bounds the motion of a k-IOS for FCL's generic conservative advancement, whose own answer for a
// foreign volume is 0, which bounds nothing. Double only: FCL 0.7's motions don't compile for
// float.

namespace kios::detail {

/// Returns an upper bound of the speed of bv's content along n, until time 1. It holds from the
/// motion's current time, n in the world, bv in the body's frame. May be negative: all of it
/// recedes.
double speedAlong(const kIOS<double>& bv, const fcl::Vector3d& n,
                  const fcl::MotionBase<double>& motion);

}  // namespace kios::detail

namespace fcl {

template <typename Motion>
struct TBVMotionBoundVisitorVisitImpl<double, kios::kIOS<double>, Motion> {
  static double run(const TBVMotionBoundVisitor<kios::kIOS<double>>& visitor,
                    const Motion& motion) {
    return kios::detail::speedAlong(visitor.bv, visitor.n, motion);
  }
};

}  // namespace fcl
