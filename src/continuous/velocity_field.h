// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include "volume/rounding.h"

namespace kios::continuous {

/// Velocities of a rigid body's points at one time, and bounds of their changes until a later
/// one (the window), in a frame that stands still: u(x) = linear + angular x (x - origin).
/// `origin` is a point of the body, also when it turns later.
struct VelocityField {
  Eigen::Vector3d linear, angular, origin;
  // Over the window:
  Eigen::Vector3d acceleration_at[2];  ///< the origin's at both ends; between them it is linear
  double origin_acceleration = 0;      ///< more of it, in any direction
  bool fixed_axis;                     ///< the body turns about `axis` alone
  Eigen::Vector3d axis;                ///< of unit length, if fixed
  double angular_speed;                ///< bound
  double turn_acceleration;            ///< bound of |x'' - origin''| per length of x - origin

  Eigen::Vector3d at(const Eigen::Vector3d& x) const { return linear + angular.cross(x - origin); }

  /// Returns a bound of |n . x''| over the window, for points x within `radius` of the point `x0`
  /// of the body. About a fixed axis, points keep their distance from it, and accelerate across it.
  double accelerationAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& x0,
                           double radius) const {
    const double turn = turn_acceleration * distance(x0, radius);
    return std::max(std::abs(n.dot(acceleration_at[0])), std::abs(n.dot(acceleration_at[1]))) +
           n.norm() * origin_acceleration +
           (fixed_axis ? n.cross(axis).norm() * turn : n.norm() * turn);
  }
  /// Does as accelerationAlong() for every unit vector n.
  double acceleration(const Eigen::Vector3d& x0, double radius = 0) const {
    return originAcceleration() + turn_acceleration * distance(x0, radius);
  }
  double originAcceleration() const {
    return origin_acceleration +
           std::sqrt(std::max(acceleration_at[0].squaredNorm(), acceleration_at[1].squaredNorm()));
  }
  /// Returns a bound over the window of the speed relative to the origin.
  double turnSpeed(const Eigen::Vector3d& x0, double radius) const {
    return angular_speed * distance(x0, radius);
  }
  /// Returns a bound over the window of how fast a unit vector n that is fixed to the body turns.
  double turnOf(const Eigen::Vector3d& n) const {
    return angular_speed * (fixed_axis ? n.cross(axis).norm() : 1.0);
  }

 private:
  /// Bounds the distance of points from the axis, or from the origin.
  double distance(const Eigen::Vector3d& x0, double radius) const {
    const Eigen::Vector3d arm = x0 - origin;
    return (fixed_axis ? axis.cross(arm).norm() : arm.norm()) + radius;
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
    return kInfinity;
  }
  return s * (1 - 0x1p-49);
}

}  // namespace kios::continuous
