// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/relative_motion.h"

#include "bv/rounding.h"

namespace kios::continuous {

using Eigen::Vector3d;

RelativeVelocities::RelativeVelocities(const Motion& a, const Motion& b, double t, double window,
                                       double pad)
    : X_WA_(a.pose(t)),
      X_WB_(b.pose(t)),
      X_AB_(X_WA_, X_WB_),
      a_(a.velocities(t, X_WA_, window)),
      b_(b.velocities(t, X_WB_, window)) {
  origins_speed_ =
      (a_.linear - b_.linear).norm() + window * (a_.origin_acceleration + b_.origin_acceleration);
  for (VelocityField* field : {&a_, &b_}) {
    field->linear = X_WA_.linear().transpose() * field->linear;
    field->angular = X_WA_.linear().transpose() * field->angular;
    field->origin = X_WA_.linear().transpose() * (field->origin - X_WA_.translation());
  }
  // Rotations are orthonormal to 16 u, so that is what the change of frame takes off.
  pad_ = pad + 64 * kUlpDouble * X_AB_.T_norm1 + 0x1p-480;
}

// Spheres of a body keep their radius, so that a ball bounds the same points at every time.
RelativeVelocities::Speeds RelativeVelocities::speeds(const Ball& a, const Ball& b) const {
  return {(a_.at(a.center) - b_.at(b.center)).norm() + a.radius * a_.angular.norm() +
              b.radius * b_.angular.norm(),
          origins_speed_ + a_.turnSpeed(a.center, a.radius) + b_.turnSpeed(b.center, b.radius),
          a_.acceleration(a.center, a.radius) + b_.acceleration(b.center, b.radius)};
}

double RelativeVelocities::approach(const Ball& a, const Ball& b, double duration) const {
  const Speeds speed = speeds(a, b);
  return duration * std::min(speed.most, speed.now + 0.5 * duration * speed.change) + pad_;
}

double RelativeVelocities::apartTime(const Ball& a, const Ball& b, double gap) const {
  const Speeds speed = speeds(a, b);
  return std::max(closingTime(gap - pad_, speed.now, speed.change),
                  closingTime(gap - pad_, speed.most, 0));
}

bool RelativeVelocities::apartAlong(const Vector3d& n, const Ball& a, const Ball& b, double gap,
                                    double duration) const {
  const double speed = n.dot(a_.at(a.center) - b_.at(b.center)) +
                       a.radius * n.cross(a_.angular).norm() +
                       b.radius * n.cross(b_.angular).norm();
  const double acceleration =
      a_.accelerationAlong(n, a.center, a.radius) + b_.accelerationAlong(n, b.center, b.radius);
  // A gap that shrinks by a parabola is least at an end of the interval: it is concave in time.
  return gap - pad_ > 0 && gap - pad_ - duration * (speed + 0.5 * duration * acceleration) > 0;
}

}  // namespace kios::continuous
