// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include <fcl/common/types.h>
#include <fcl/math/motion/motion_base.h>
#include <fcl/narrowphase/continuous_collision_request.h>
#include "continuous/velocity_field.h"
#include "fcl_kios/detail/fcl_own.h"

namespace kios::continuous {

/// Holds a motion that is computed elsewhere: that of a link, by the joints that carry it.
class KnownMotion {
 public:
  virtual ~KnownMotion() = default;
  virtual fcl::Transform3d pose(double t) const = 0;
  /// Returns those at t, where the pose is X, and bounds over [t, t + window].
  virtual VelocityField velocities(double t, const fcl::Transform3d& X, double window) const = 0;
  /// Tells whether bounds are the same for every window.
  virtual bool steady() const = 0;
  /// Bounds the rounding of velocities times a time of at most 1, of points within `reach` of the
  /// body's origin.
  virtual double rounding(double reach) const = 0;
};

/// Returns the rotation itself if it is orthonormal to rounding (16 u, the Frobenius norm of R^T R
/// - I), else that of its quaternion. Throws std::invalid_argument, naming `what`, if it isn't
/// rigid.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R, const char* what);

/// Holds a rigid motion X(t) of a body in the world, t in [0, 1]: a plain value, read by any number
/// of threads. Rotations that are not orthonormal to rounding are replaced by the nearest
/// quaternion's.
class Motion {
 public:
  using Points = std::array<Eigen::Vector3d, 4>;

  /// Constant velocities, all in the world: R(t) = rot(axis, angle t) R(0), and the point that is
  /// at X_0.translation() - arm at first moves on a line: with `velocity`. Angle in radians.
  static Motion twist(const fcl::Transform3d& X_0, const Eigen::Vector3d& velocity,
                      const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& arm);
  /// Returns cubic B-splines of the translation and of the rotation vector, by their de Boor
  /// points: fcl::SplineMotion.
  static Motion spline(const Points& translations, const Points& rotations);

  /// One that something above knows; `rounding` is that of all places, and adds to what its
  /// velocities round by.
  static Motion known(std::shared_ptr<const KnownMotion> motion, double rounding);

  /// Returns the motion with more rounding: what is proven of it holds of a body that is wider by
  /// so much.
  Motion widened(double by) const {
    Motion m = *this;
    m.rounding_ += by;
    return m;
  }

  // Motions from pose to pose, as FCL's of these names: both poses rigid and finite.
  static Motion translation(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1);
  static Motion linear(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1);
  static Motion screw(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1);
  static Motion spline(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1);

  fcl::Transform3d pose(double t) const;

  /// Velocities at t in the world, X = pose(t), and their bounds over [t, t + window].
  VelocityField velocities(double t, const fcl::Transform3d& X, double window) const;

  /// Returns true if bounds are the same for every window.
  bool steady() const;
  /// Returns true if the body stands still. Bodies of linkages never do, as their poses are
  /// rounded.
  bool still() const;
  /// Bounds the rounding error of the place of a point within `reach` of the body's origin, at any
  /// time, plus that of its velocity times a time of at most 1.
  double rounding(double reach) const;
  /// Returns the part of it that a unit of `reach` adds.
  double turnRounding() const;

 private:
  enum class Kind { kTwist, kSpline, kKnown };
  Motion() = default;
  void check() const;

  Kind kind_ = Kind::kTwist;
  // kTwist: T(t) = T0 + velocity t + (rot(axis, angle t) - 1) arm.
  Eigen::Matrix3d R0_;
  Eigen::Vector3d T0_, velocity_, axis_, arm_;
  double angle_ = 0;
  // kSpline; axis_ as well, if all rotation vectors are along it.
  Points Td_, Rd_;
  bool fixed_axis_ = true;
  std::shared_ptr<const KnownMotion> known_;  // kKnown
  double rounding_ = 0;                       // that is added to its own
};

/// Returns the motion that an FCL motion describes by its pose after integrate(t). The object is
/// only read, so that many threads may share it. Throws std::invalid_argument, naming the type, if
/// it isn't one of FCL's four (a derived class may integrate otherwise), null, or not finite.
Motion motionOf(const fcl::MotionBase<double>* motion);

/// Returns the motion from pose to pose that a request asks for.
Motion motionBetween(const fcl::Transform3d& X_0, const fcl::Transform3d& X_1,
                     fcl::CCDMotionType type);

}  // namespace kios::continuous
