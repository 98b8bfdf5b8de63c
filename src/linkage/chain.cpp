// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/chain.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kios::articulated {

using Eigen::Vector3d;

Chain::Chain(const Path& path, int body, int shared) : at_(path, 0), body_(body), shared_(shared) {
  const Linkage::Impl& linkage = path.linkage();
  const int own = linkage.bodies[body].link;
  if (own >= 0 && shared > 0) base_ = linkage.links[own].moving[shared - 1];
  for (const MovingJoint& joint : at_.jointsOf(body, shared)) {
    slides_after_ |= !joint.turns && turning_ > 0;
    turning_ += joint.turns ? 1 : 0;
    (joint.turns ? rates_ : slides_) += std::abs(joint.rate);
  }
}

// The frame that a link gives rounds as the bodies do that it carries: a path's pad leaves room.
fcl::Transform3d Chain::pose(double s) const {
  const fcl::Transform3d& X = at(s).pose(body_);
  return base_ < 0 ? X : at_.linkPose(base_).inverse() * X;
}

// The origin is the last axis that turns the body, unless that slides along it: then the body's.
// With one axis that is all, the origin moves on a line. Else, with w_i the rate of joint i,
//   |origin''| <= sum_i |w_i| rho_i (|w_i| + 2 sum_(j < i) |w_j|)
// as in configuration.h, rho_i grown by what the joints after i move the origin by. Relative to the
// origin a point at the distance r has an acceleration of at most (|w'| + |w|^2) r, w the sum of
// all w_i along their axes, and |w'| <= sum_i sum_(j < i) |w_i| |w_j|.
continuous::VelocityField Chain::velocities(double s, const fcl::Transform3d& X,
                                            double window) const {
  continuous::VelocityField v;
  v.linear = v.angular = v.acceleration_at[0] = v.acceleration_at[1] = Vector3d::Zero();
  v.origin = X.translation();
  v.axis = Vector3d::UnitX();
  v.fixed_axis = turning_ <= 1;
  v.angular_speed = v.turn_acceleration = 0;

  std::vector<MovingJoint> moving = at(s).jointsOf(body_, shared_);
  for (MovingJoint& joint : moving) {
    if (base_ >= 0) {
      const fcl::Transform3d X_LW = at_.linkPose(base_).inverse();
      joint.axis = X_LW.linear() * joint.axis;
      joint.origin = X_LW * joint.origin;
    }
    if (!joint.turns) continue;
    v.axis = joint.axis;
    if (!slides_after_) v.origin = joint.origin;
  }
  double after = 0, acceleration = 0, before = 0;  // sums of |w_j| before a joint
  for (const MovingJoint& joint : moving) {
    if (joint.turns) {
      const double rate = std::abs(joint.rate);
      v.turn_acceleration += rate * before;
      before += rate;
    }
  }
  v.angular_speed = before;
  v.turn_acceleration += before * before;
  for (std::size_t i = moving.size(); i-- > 0;) {
    const MovingJoint& joint = moving[i];
    const double rate = std::abs(joint.rate);
    if (!joint.turns) {
      v.linear += joint.rate * joint.axis;
      acceleration += 2 * rate * before;
      after += rate;
      continue;
    }
    before = std::max(0.0, before - rate);
    const Vector3d arm = joint.axis.cross(v.origin - joint.origin);
    v.linear += joint.rate * arm;
    v.angular += joint.rate * joint.axis;
    const double far = arm.norm() + window * after;
    acceleration += rate * far * (rate + 2 * before);
    after += rate * far;
  }
  constexpr double kSums = 1 + 0x1p-30;
  v.angular_speed *= kSums;
  v.turn_acceleration *= kSums;
  // Exactly on the axis, the origin is only moved by joints that slide before it.
  v.origin_acceleration = steady() ? 0 : acceleration * kSums;
  return v;
}

double Chain::rounding(double reach) const {
  return 0x1p-40 * (rates_ * (at_.path().length(body_) + reach) + slides_);
}

}  // namespace kios::articulated
