// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "continuous/relative_motion.h"
#include "continuous/tuning.h"
#include "volume/rounding.h"

namespace kios::continuous {

/// The relative motion of two bodies A and B from t to t + h, in frame A of RelativeVelocities, by
/// their places at the ends of equal parts of that time.
///
/// Within a part of length d a point moves on the chord between its places, but for at most d^2 / 8
/// times its largest acceleration: the error of linear interpolation. Beside a tangent it would be
/// d^2 / 2. Places as computed are off by Motion::rounding() of the distance from the body's
/// origin, at either end and so all along the chord, and by 64 u of the lengths in the change of
/// frame.
class Chords {
 public:
  static constexpr int kParts = tuning::kChords;

  void set(const RelativeMotion& motion, double t, double h);
  double duration() const { return duration_; }  ///< -1 if it isn't set
  void forget() { duration_ = -1; }

  /// Holds a body's frame, in frame A, as computed.
  struct Place {
    Eigen::Matrix3d R;
    Eigen::Vector3d T;
  };
  const Place& ofA(int end) const { return of_a_[end]; }
  const Place& ofB(int end) const { return of_b_[end]; }

  /// Returns how far a path leaves its chord, rounding included: of a point with at most this
  /// acceleration and at most so far from its body's origin.
  double sagitta(double acceleration, double distance) const {
    return sagitta_ * acceleration + rounding_ * distance + 0.5 * pad_;
  }
  /// Returns a ball during a part: as if it moved on the chord within a time of 1.
  static MovingBall alongChord(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                               double radius, double sagitta) {
    return {from, radius, to - from, 2 * sagitta};
  }

 private:
  double duration_ = -1;
  Place of_a_[kParts + 1], of_b_[kParts + 1];  // at the ends of the parts
  double sagitta_ = 0;   ///< a path leaves its chord by at most so much of its acceleration
  double rounding_ = 0;  ///< of a place, for a unit of the distance from the body's origin
  double pad_ = 0;       ///< of two places, beside that and RelativeVelocities::pad()
};

}  // namespace kios::continuous
