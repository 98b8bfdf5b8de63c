// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "continuous/motion.h"
#include "fcl_kios/volume.h"
#include "volume/rounding.h"

namespace kios::continuous {

/// A ball that is fixed to a body: whatever of the body it contains, it contains always.
struct MovingBall {
  Eigen::Vector3d center;
  double radius;
  Eigen::Vector3d velocity;  ///< of the centre
  double acceleration;       ///< bound of the centre's over the window
};

/// Holds four balls that are fixed to a body, a lane each, as MovingBall.
struct FourBalls {
  Eigen::Array4d center[3], radius, velocity[3], acceleration;
};

/// Returns balls of a body, given in the frame of its velocities.
inline MovingBall movingBall(const VelocityField& body, const Eigen::Vector3d& center,
                             double radius) {
  return {center, radius, body.at(center), body.acceleration(center)};
}
FourBalls movingBalls(const VelocityField& body, const Eigen::Array4d* center,
                      const Eigen::Array4d& radius);

/// The relative motion of two bodies A and B at a time t and, by bounds, until t + window.
/// Everything is in frame A: the axes and origin of body A at t, standing still from then on.
class RelativeVelocities {
 public:
  RelativeVelocities(const Motion& a, const Motion& b, double t, double window, double pad);

  /// True if two balls, and so what they contain, are proven apart for `duration`, at most the
  /// window.
  bool apart(const MovingBall& a, const MovingBall& b, double duration) const;
  /// True if that holds for one of four; the ball is of one body, the four of the other one.
  bool anyApart(const MovingBall& ball, const FourBalls& four, double duration) const;
  /// Returns the time for which the contents of two balls are proven apart that are `gap` apart at
  /// t.
  double apartTime(const MovingBall& a, const MovingBall& b, double gap) const;
  /// Returns the time for which no point of a solid of A reaches a point of B's triangle, by the
  /// slab between them across n (of any length near 1); 0 if none is between them. The solid lies
  /// within `reach` of `center`, support(m) is the largest m . x in it, and `pad` is taken off the
  /// gap.
  template <typename Support, typename Vertices>
  double slabTime(const Eigen::Vector3d& n, const Support& support, const Eigen::Vector3d& center,
                  double reach, const Vertices& b, double pad) const;

  /// Holds the motion of the points of a ball of B as seen from body A, which may turn, within
  /// `duration`: their speed at t, the largest speed, and the largest change of the former in a
  /// unit of time. If `n` isn't null, only the direction n counts, and `speed` is along -n.
  struct Drift {
    double speed, most, change;
  };
  Drift driftFromA(const Eigen::Vector3d& center, double radius, double duration,
                   const Eigen::Vector3d* n = nullptr) const;
  const VelocityField& a() const { return a_; }
  const VelocityField& b() const { return b_; }
  /// Returns the velocity of A's point at x less that of B's.
  Eigen::Vector3d velocityAt(const Eigen::Vector3d& x) const { return a_.at(x) - b_.at(x); }

  double pad() const { return pad_; }
  /// Returns a bound of the sum of both angular speeds.
  double turn() const { return a_.angular_speed + b_.angular_speed; }
  const RelativePose<double>& pose() const { return X_AB_; }
  double stretch() const { return detail::boundsOf(X_AB_).stretch; }  ///< of pose()

 private:
  /// Returns the rounding error, per length, of the centres of balls, which may be farther off than
  /// the bodies reach: 32 u of positions, and of velocities times the duration.
  double rounding(double duration) const { return 0x1p-48 * (1 + duration * turn()); }

  fcl::Transform3d X_WA_, X_WB_;
  RelativePose<double> X_AB_;
  VelocityField a_, b_;
  double origins_speed_;  ///< bound over the window of the speed of b's origin relative to a's
  double pad_;            ///< rounding takes at most this off any gap
};

/// Holds the relative motion of two bodies whose points are within reach_a and reach_b of their
/// origins.
class RelativeMotion {
 public:
  RelativeMotion(const Motion& a, const Motion& b, double reach_a, double reach_b)
      : a_(a), b_(b), pad_(a.rounding(reach_a) + b.rounding(reach_b)) {}

  RelativeVelocities at(double t, double window) const { return {a_, b_, t, window, pad_}; }
  const Motion& a() const { return a_; }
  const Motion& b() const { return b_; }
  /// Bounds the rounding of places, for a unit of the distance from the bodies' origins.
  double turnRounding() const { return a_.turnRounding() + b_.turnRounding(); }
  bool steady() const { return a_.steady() && b_.steady(); }
  bool still() const { return a_.still() && b_.still(); }

 private:
  const Motion &a_, &b_;
  double pad_;
};

template <typename Support, typename Vertices>
double RelativeVelocities::slabTime(const Eigen::Vector3d& n, const Support& support,
                                    const Eigen::Vector3d& center, double reach, const Vertices& b,
                                    double pad) const {
  const Eigen::Vector3d turn_a = n.cross(a_.angular), turn_b = n.cross(b_.angular);
  double low_b = kInfinity, speed_b = low_b, acceleration_b = 0;
  for (const Eigen::Vector3d& x : b) {
    low_b = std::min(low_b, n.dot(x));
    speed_b = std::min(speed_b, turn_b.dot(x - b_.origin));
    acceleration_b = std::max(acceleration_b, b_.accelerationAlong(n, x, 0));
  }
  const double speed_a = support(turn_a) - turn_a.dot(a_.origin);
  return closingTime(low_b - support(n) - pad, n.dot(a_.linear - b_.linear) + (speed_a - speed_b),
                     a_.accelerationAlong(n, center, reach) + acceleration_b);
}

}  // namespace kios::continuous
