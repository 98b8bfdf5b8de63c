// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace kios::continuous {

/// Velocities of a rigid body's points at one time, and bounds of what becomes of them until a
/// later one (the window), in a frame that stands still: u(x) = linear + angular x (x - origin).
/// `origin` is a point of the body, also when it turns later.
struct VelocityField {
  Eigen::Vector3d linear, angular, origin;
  bool steady;  ///< constant angular velocity, and an origin without acceleration
  // Bounds over the window; used only if not steady.
  double origin_acceleration;  ///< of the origin
  double turn_acceleration;    ///< of x - origin, per length of it
  double angular_speed;

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return linear + angular.cross(x - origin); }

  /// Bound of |n . x''| over the window, for points x within `radius` of the point `x0` of the
  /// body. Steady: x'' = -w^2 (part of x - origin across the axis), whose length stays.
  double accelerationAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& x0,
                           double radius) const {
    if (steady) {
      return n.cross(angular).norm() *
             (angular.cross(x0 - origin).norm() + radius * angular.norm());
    }
    return origin_acceleration + turn_acceleration * ((x0 - origin).norm() + radius);
  }
  /// As accelerationAlong() for every unit vector n.
  double acceleration(const Eigen::Vector3d& x0, double radius = 0) const {
    if (steady) {
      const double w = angular.norm();
      return w * (angular.cross(x0 - origin).norm() + radius * w);
    }
    return origin_acceleration + turn_acceleration * ((x0 - origin).norm() + radius);
  }
  /// Bound over the window of the speed relative to the origin.
  double turnSpeed(const Eigen::Vector3d& x0, double radius) const {
    if (steady) return angular.cross(x0 - origin).norm() + radius * angular.norm();
    return angular_speed * ((x0 - origin).norm() + radius);
  }
};

/// Largest s with gap - speed s - acceleration s^2 / 2 >= 0, rounded down; gap and acceleration are
/// >= 0, speed may be negative (opening). Infinite if the gap never closes. hypot() neither
/// overflows nor underflows: the root is off by 3 ulp, and s by 8.
inline double closingTime(double gap, double speed, double acceleration) {
  if (!(gap > 0)) return 0;
  const double root = std::hypot(speed, std::sqrt(2 * acceleration) * std::sqrt(gap));
  double s;
  if (speed > 0) {
    s = 2 * gap / (speed + root);
  } else if (acceleration > 0) {
    s = (root - speed) / acceleration;
  } else {
    return std::numeric_limits<double>::infinity();
  }
  return s * (1 - 0x1p-49);
}

}  // namespace kios::continuous
