// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/motion.h"

#include <algorithm>
#include <utility>

#include "volume/errors.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios::continuous {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fcl::Transform3d;

Matrix3d orthonormal(const Matrix3d& R) { return continuous::orthonormal(R, "pose of a motion"); }

/// Returns the axis and angle in [0, pi] that take R0 to R1.
Eigen::AngleAxisd turn(const Matrix3d& R0, const Matrix3d& R1) {
  return Eigen::AngleAxisd(Eigen::Quaterniond(R1 * R0.transpose()).normalized());
}

/// Returns the weights of the de Boor points, and those of the first and second derivative.
std::array<double, 4> weights(double t) {
  const double s = 1 - t, tt = t * t;
  return {s * s * s / 6, (4 - 6 * tt + 3 * tt * t) / 6, (1 + 3 * t + 3 * tt - 3 * tt * t) / 6,
          tt * t / 6};
}
std::array<double, 4> weights1(double t) {
  const double s = 1 - t;
  return {-s * s / 2, t * (3 * t - 4) / 2, (1 + t * (2 - 3 * t)) / 2, t * t / 2};
}
std::array<double, 4> weights2(double t) { return {1 - t, 3 * t - 2, 1 - 3 * t, t}; }

Vector3d combine(const Motion::Points& p, const std::array<double, 4>& w) {
  return p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + p[3] * w[3];
}

double largest(const Motion::Points& p) {
  return std::max({p[0].norm(), p[1].norm(), p[2].norm(), p[3].norm()});
}

/// Bound of |p'| over [t, t + window]: a quadratic lies in the hull of its Bezier points.
double speedBound(const Motion::Points& p, double t, double window) {
  const Vector3d first = combine(p, weights1(t)), last = combine(p, weights1(t + window));
  const Vector3d middle = first + 0.5 * window * combine(p, weights2(t));
  return std::max({first.norm(), middle.norm(), last.norm()});
}
/// Returns a bound of |p''|, which is linear in t.
double accelerationBound(const Motion::Points& p, double t, double window) {
  return std::max(combine(p, weights2(t)).norm(), combine(p, weights2(t + window)).norm());
}

Matrix3d rotation(const Vector3d& w) {
  const double angle = w.norm();
  if (!(angle > 0)) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

/// Returns the angular velocity of exp(w(t)): the left Jacobian of SO(3) at w times w'. Both
/// factors are evaluated without cancellation that matters: the second one multiplies |w|^2.
Vector3d angularVelocity(const Vector3d& w, const Vector3d& dw) {
  const double angle = w.norm();
  if (angle < 1e-4) return dw + 0.5 * w.cross(dw) + w.cross(w.cross(dw)) / 6;
  const double half = std::sin(0.5 * angle) / angle;
  const double c = (1 - std::sin(angle) / angle) / (angle * angle);
  return dw + 2 * half * half * w.cross(dw) + c * w.cross(w.cross(dw));
}

}  // namespace

Matrix3d orthonormal(const Matrix3d& R, const char* what) {
  constexpr double kRounded = 16 * kUlpDouble;
  const double square = squaredRotationError(R);
  requireRotation<double>(square, determinant(R), what);
  if (square <= kRounded * kRounded) return R;
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

Motion Motion::twist(const Transform3d& X_0, const Vector3d& velocity, const Vector3d& axis,
                     double angle, const Vector3d& arm) {
  Motion m;
  m.R0_ = orthonormal(X_0.linear());
  m.T0_ = X_0.translation();
  m.velocity_ = velocity;
  m.angle_ = angle;
  m.axis_ = angle != 0 ? axis.normalized() : Vector3d(Vector3d::UnitX());
  m.arm_ = angle != 0 ? arm : Vector3d(Vector3d::Zero());
  m.check();
  return m;
}

Motion Motion::spline(const Points& translations, const Points& rotations) {
  Motion m;
  m.kind_ = Kind::kSpline;
  m.Td_ = translations;
  m.Rd_ = rotations;
  m.axis_ = Vector3d::UnitX();
  for (const Vector3d& w : rotations) {
    if (w.norm() > 0) m.axis_ = w.normalized();
  }
  m.fixed_axis_ = true;
  for (const Vector3d& w : rotations) m.fixed_axis_ &= w.cross(m.axis_).isZero(0);
  m.check();
  return m;
}

Motion Motion::known(std::shared_ptr<const KnownMotion> motion, double rounding) {
  Motion m;
  m.kind_ = Kind::kKnown;
  m.known_ = std::move(motion);
  m.rounding_ = rounding;
  return m;
}

Motion Motion::translation(const Transform3d& X_0, const Transform3d& X_1) {
  orthonormal(X_1.linear());
  return twist(X_0, X_1.translation() - X_0.translation(), Vector3d::UnitX(), 0, Vector3d::Zero());
}

Motion Motion::linear(const Transform3d& X_0, const Transform3d& X_1) {
  const auto R = turn(orthonormal(X_0.linear()), orthonormal(X_1.linear()));
  return twist(X_0, X_1.translation() - X_0.translation(), R.axis(), R.angle(), Vector3d::Zero());
}

// The arm from the axis to the body's origin follows from the chord of the arc, relatively exact
// for every angle: no point of the axis, which may be far, is subtracted.
Motion Motion::screw(const Transform3d& X_0, const Transform3d& X_1) {
  const auto R = turn(orthonormal(X_0.linear()), orthonormal(X_1.linear()));
  const Vector3d way = X_1.translation() - X_0.translation();
  const Vector3d& a = R.axis();
  if (!(R.angle() > 1e-100)) return twist(X_0, way, a, 0, Vector3d::Zero());
  const Vector3d along = a * a.dot(way), across = way - along;
  const Vector3d arm = -0.5 * (across + a.cross(across) / std::tan(0.5 * R.angle()));
  return twist(X_0, along, a, R.angle(), arm);
}

// De Boor points in equal steps give a uniform motion of both vectors.
Motion Motion::spline(const Transform3d& X_0, const Transform3d& X_1) {
  const auto rotationVector = [](const Matrix3d& R) {
    const Eigen::AngleAxisd aa(Eigen::Quaterniond(orthonormal(R)).normalized());
    return Vector3d(aa.angle() * aa.axis());
  };
  const Vector3d w0 = rotationVector(X_0.linear());
  Vector3d w1 = rotationVector(X_1.linear());
  if (w1.norm() > 0) {  // the nearest of the vectors that mean this rotation
    constexpr double kTurn = 6.283185307179586;
    const Vector3d other = w1 - kTurn * w1.normalized();
    if ((other - w0).norm() < (w1 - w0).norm()) w1 = other;
  }
  Points T, R;
  for (int i = 0; i < 4; ++i) {
    T[i] = X_0.translation() + (i - 1) * (X_1.translation() - X_0.translation());
    R[i] = w0 + (i - 1) * (w1 - w0);
  }
  return spline(T, R);
}

Transform3d Motion::pose(double t) const {
  if (kind_ == Kind::kKnown) return known_->pose(t);
  Transform3d X = Transform3d::Identity();
  if (kind_ == Kind::kSpline) {
    X.linear() = rotation(combine(Rd_, weights(t)));
    X.translation() = combine(Td_, weights(t));
    return X;
  }
  X.translation() = T0_ + velocity_ * t;
  if (angle_ == 0) {
    X.linear() = R0_;
    return X;
  }
  // (rot - 1) arm by half angles: no cancellation when the angle is small and the arm long.
  const double s = std::sin(0.5 * angle_ * t), c = std::cos(0.5 * angle_ * t);
  const Vector3d across = axis_.cross(arm_);
  X.linear() = Eigen::AngleAxisd(angle_ * t, axis_).toRotationMatrix() * R0_;
  X.translation() += 2 * s * (c * across + s * axis_.cross(across));
  return X;
}

VelocityField Motion::velocities(double t, const Transform3d& X, double window) const {
  if (kind_ == Kind::kKnown) return known_->velocities(t, X, window);
  VelocityField v;
  if (kind_ == Kind::kTwist) {
    const double s = std::sin(angle_ * t), c = std::cos(angle_ * t);
    const Vector3d across = axis_.cross(arm_), inward = axis_.cross(across);
    v.linear = velocity_;
    v.angular = axis_ * angle_;
    v.origin = X.translation() - (arm_ + s * across + (1 - c) * inward);
    v.acceleration_at[0] = v.acceleration_at[1] = Vector3d::Zero();
    v.fixed_axis = true;
    v.axis = axis_;
    v.angular_speed = std::abs(angle_);
    v.turn_acceleration = angle_ * angle_;
    return v;
  }
  // Rotation vectors w(t): |angular| <= |w'|, as the Jacobian is a mean of rotations; its
  // derivative is at most |w'| / 2, so that |angular'| <= |w''| + |w'|^2 / 2. Points of the body
  // get |angular'| + |angular|^2 of acceleration per length. About a fixed axis, angular = w'.
  const double speed = speedBound(Rd_, t, window);
  v.linear = combine(Td_, weights1(t));
  v.angular = angularVelocity(combine(Rd_, weights(t)), combine(Rd_, weights1(t)));
  v.origin = X.translation();
  v.acceleration_at[0] = combine(Td_, weights2(t));
  v.acceleration_at[1] = combine(Td_, weights2(t + window));
  v.fixed_axis = fixed_axis_;
  v.axis = axis_;
  v.angular_speed = speed;
  v.turn_acceleration =
      accelerationBound(Rd_, t, window) + (fixed_axis_ ? 1.0 : 1.5) * speed * speed;
  return v;
}

bool Motion::steady() const {
  return kind_ == Kind::kTwist || (kind_ == Kind::kKnown && known_->steady());
}

bool Motion::still() const {
  if (kind_ == Kind::kKnown) return false;
  if (kind_ == Kind::kTwist) return angle_ == 0 && velocity_.isZero(0);
  for (int i = 1; i < 4; ++i) {
    if (Td_[i] != Td_[0] || Rd_[i] != Rd_[0]) return false;
  }
  return true;
}

// Translations: three roundings of terms that sum to |T0| + |velocity|, a coordinate, at both ends
// of a step; their velocities have fewer. Rotations: ten roundings an entry, and an angle that is
// known to u angle; arms are turned likewise.
double Motion::rounding(double reach) const {
  if (kind_ == Kind::kKnown) return rounding_ + known_->rounding(reach);
  const double turned = turnRounding() * reach + rounding_;
  if (kind_ == Kind::kSpline) return 64 * kUlpDouble * largest(Td_) + turned;
  return kUlpDouble * (16 * (T0_.norm() + velocity_.norm()) + 64 * std::abs(angle_) * arm_.norm()) +
         turned;
}

double Motion::turnRounding() const {
  return 64 * kUlpDouble * (2 + (kind_ == Kind::kSpline ? 8 * largest(Rd_) : std::abs(angle_)));
}

void Motion::check() const {
  double size = 0;
  if (kind_ == Kind::kSpline) {
    size = largest(Td_) + largest(Rd_);
    for (int i = 0; i < 4; ++i) size += Td_[i].sum() - Td_[i].sum() + Rd_[i].sum() - Rd_[i].sum();
  } else {
    size = T0_.norm() + velocity_.norm() + std::abs(angle_) * (1 + arm_.norm()) + axis_.norm();
  }
  if (size <= 0x1p400) return;  // so that no product overflows; NaN fails
  refuse(
      "a motion is not finite or too large to be bounded; FCL 0.7 leaves members of "
      "InterpMotion(tf1, tf2, O) and SplineMotion(tf1, tf2) uninitialised, use another constructor "
      "or the form with two poses.");
}

}  // namespace kios::continuous
