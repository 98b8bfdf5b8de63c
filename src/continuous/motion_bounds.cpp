// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/model/motion_bounds.h"

#include <fcl/math/motion/motion_base.h>
#include "continuous/fcl_motion.h"

namespace kios {

// FCL's motions tell no time, but for splines: the bound is that from 0 on. Points of a body turn
// with at most angular speed times their distance from a fixed axis, and across it.
double detail::speedAlong(const kIOS<double>& bv, const fcl::Vector3d& n,
                          const fcl::MotionBase<double>& motion) {
  const continuous::Motion m = continuous::motionOf(&motion);
  const fcl::Transform3d X = m.pose(0);
  const continuous::VelocityField v = m.velocities(0, X, 1);
  const fcl::Vector3d center = X * bv.center0;
  const double rounding = m.rounding(bv.center0.norm() + bv.radius0);
  const double turn = v.turnSpeed(center, bv.radius0);
  return n.dot(v.linear) + n.norm() * v.originAcceleration() +
         (v.fixed_axis ? n.cross(v.axis).norm() : n.norm()) * turn + rounding;
}

}  // namespace kios
