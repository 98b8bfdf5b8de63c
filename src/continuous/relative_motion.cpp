// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/relative_motion.h"

#include <algorithm>

#include "volume/rounding.h"

namespace kios::continuous {

using Eigen::Vector3d;

namespace {

// Norms lose most to gradual underflow: less than 2^-535, as squares round by up to 2^-1075. A gap
// loses a few times that, and as much times a turn's speed, its square and its acceleration.
constexpr double kSubnormal = 0x1p-530;

}  // namespace

RelativeVelocities::RelativeVelocities(const Motion& a, const Motion& b, double t, double window,
                                       double pad)
    : X_WA_(a.pose(t)),
      X_WB_(b.pose(t)),
      X_AB_(X_WA_, X_WB_),
      a_(a.velocities(t, X_WA_, window)),
      b_(b.velocities(t, X_WB_, window)) {
  origins_speed_ =
      (a_.linear - b_.linear).norm() + window * (a_.originAcceleration() + b_.originAcceleration());
  for (VelocityField* field : {&a_, &b_}) {
    field->linear = X_WA_.linear().transpose() * field->linear;
    field->angular = X_WA_.linear().transpose() * field->angular;
    field->axis = X_WA_.linear().transpose() * field->axis;
    for (Vector3d& acceleration : field->acceleration_at) {
      acceleration = X_WA_.linear().transpose() * acceleration;
    }
    field->origin = X_WA_.linear().transpose() * (field->origin - X_WA_.translation());
  }
  // Rotations are orthonormal to 16 u, so that is what the change of frame takes off.
  pad_ = pad + 64 * kUlpDouble * detail::boundsOf(X_AB_).T_norm1 +
         kSubnormal * ((1 + turn()) * (1 + turn()) + a_.turn_acceleration + b_.turn_acceleration);
}

// The centres' difference moves on a line, but for the accelerations; the nearest point of that
// line is found up to a few u of the lengths. The square of a speed below 2^-534 may be off by any
// factor, and the point by the whole way, which is less than the pad. A ball that turns stays where
// it is.
bool RelativeVelocities::apart(const MovingBall& a, const MovingBall& b, double duration) const {
  const Vector3d between = b.center - a.center, velocity = b.velocity - a.velocity;
  const double approach = -between.dot(velocity), square = velocity.squaredNorm();
  const double s = approach > 0 && square > 0 ? std::min(duration, approach / square) : 0;
  const double length = between.lpNorm<1>() + duration * velocity.lpNorm<1>();
  const double reach =
      a.radius + b.radius + 0.5 * duration * duration * (a.acceleration + b.acceleration) + pad_;
  const double least = reach + rounding(duration) * (length + reach);
  return (between + s * velocity).squaredNorm() > least * least;
}

// As apart(), without branches.
bool RelativeVelocities::anyApart(const MovingBall& ball, const FourBalls& four,
                                  double duration) const {
  using Eigen::Array4d;
  Array4d between[3], velocity[3];
  for (int c = 0; c < 3; ++c) {
    between[c] = four.center[c] - ball.center[c];
    velocity[c] = four.velocity[c] - ball.velocity[c];
  }
  const Array4d approach =
      -(between[0] * velocity[0] + between[1] * velocity[1] + between[2] * velocity[2]);
  const Array4d squared = velocity[0].square() + velocity[1].square() + velocity[2].square();
  const Array4d square = (squared > 0).select(squared, 1.0);
  const Array4d s = (approach / square).max(0.0).min(duration);
  const Array4d length = between[0].abs() + between[1].abs() + between[2].abs() +
                         duration * (velocity[0].abs() + velocity[1].abs() + velocity[2].abs());
  const Array4d reach = four.radius + (ball.radius + pad_) +
                        0.5 * duration * duration * (four.acceleration + ball.acceleration);
  const Array4d least = reach + rounding(duration) * (length + reach);
  const Array4d nearest = (between[0] + s * velocity[0]).square() +
                          (between[1] + s * velocity[1]).square() +
                          (between[2] + s * velocity[2]).square();
  return (nearest > least.square()).any();
}

FourBalls movingBalls(const VelocityField& body, const Eigen::Array4d* center,
                      const Eigen::Array4d& radius) {
  FourBalls four;
  four.radius = radius;
  Eigen::Array4d arm[3];
  for (int c = 0; c < 3; ++c) {
    four.center[c] = center[c];
    arm[c] = center[c] - body.origin[c];
  }
  Eigen::Array4d squared = Eigen::Array4d::Zero();
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    four.velocity[c] = body.linear[c] + body.angular[d] * arm[e] - body.angular[e] * arm[d];
    squared += body.fixed_axis ? (body.axis[d] * arm[e] - body.axis[e] * arm[d]).square().eval()
                               : arm[c].square().eval();
  }
  four.acceleration = body.originAcceleration() + body.turn_acceleration * squared.sqrt();
  return four;
}

double RelativeVelocities::apartTime(const MovingBall& a, const MovingBall& b, double gap) const {
  const double turn = a_.angular.norm() * a.radius + b_.angular.norm() * b.radius;
  const double speed = (a.velocity - b.velocity).norm() + turn;
  const double change = a_.acceleration(a.center, a.radius) + b_.acceleration(b.center, b.radius);
  const double most =
      origins_speed_ + a_.turnSpeed(a.center, a.radius) + b_.turnSpeed(b.center, b.radius);
  return std::max(closingTime(gap - pad_, speed, change), closingTime(gap - pad_, most, 0));
}

// In A's frame a point x of B has the acceleration x'' - (that of A's point there) - 2 w_A x its
// velocity in that frame. Seen from A's origin it gets farther by at most `farther`.
RelativeVelocities::Drift RelativeVelocities::driftFromA(const Vector3d& center, double radius,
                                                         double duration, const Vector3d* n) const {
  const double farther = duration * (origins_speed_ + b_.turnSpeed(center, radius));
  const double around = radius + farther;
  const Vector3d velocity = b_.at(center) - a_.at(center);
  const double spin = radius * (b_.angular - a_.angular).norm();
  Drift drift;
  drift.most = origins_speed_ + b_.turnSpeed(center, radius) + a_.turnSpeed(center, around);
  if (n) {
    // n turns with A, and so gets out of the directions in which it is spared.
    const bool turns = a_.angular_speed > 0;
    drift.speed = spin - n->dot(velocity);
    drift.change = 2 * a_.turnOf(*n) * drift.most;
    drift.change +=
        turns ? b_.acceleration(center, radius) + a_.acceleration(center, around)
              : b_.accelerationAlong(*n, center, radius) + a_.accelerationAlong(*n, center, around);
  } else {
    drift.speed = spin + velocity.norm();
    drift.change = b_.acceleration(center, radius) + a_.acceleration(center, around) +
                   2 * a_.angular_speed * drift.most;
  }
  return drift;
}

}  // namespace kios::continuous
