// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/fcl/motion_bounds.h"

#include "continuous/fcl_motion.h"
#include "fcl/math/motion/motion_base.h"

namespace kios {

// The speed now, the acceleration, and at most the rest of the time. FCL's motions tell no time,
// but for splines: what is steady is bounded from 0 on, by its largest speed.
double speedAlong(const kIOS<double>& bv, const fcl::Vector3d& n,
                  const fcl::MotionBase<double>& motion) {
  const continuous::Motion m = continuous::motionOf(&motion);
  const fcl::Transform3d X = m.pose(0);
  const continuous::VelocityField v = m.velocities(0, X, 1);
  const fcl::Vector3d center = X * bv.center0;
  const double rounding = m.rounding(bv.center0.norm() + bv.radius0);
  if (v.steady) {  // n . (w x r) = (n x w) . r, and r keeps its part across the axis
    const double w = v.angular.norm();
    const double across = w > 0 ? v.angular.cross(center - v.origin).norm() / w + bv.radius0 : 0.0;
    return n.dot(v.linear) + n.cross(v.angular).norm() * across + rounding;
  }
  return n.dot(v.linear) + n.norm() * (v.origin_acceleration + v.turnSpeed(center, bv.radius0)) +
         rounding;
}

}  // namespace kios
