// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "continuous/relative_motion.h"
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
  static constexpr int kParts = 4;

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

  /// Two polygons, their vertices at the ends of the parts.
  struct Triangles {
    Triangles(const Chords& chords, const std::array<Eigen::Vector3d, 3>& a,
              const std::array<Eigen::Vector3d, 3>& b) {
      for (int i = 0; i <= kParts; ++i) {
        for (int k = 0; k < 3; ++k) {
          of_a[i][k] = chords.of_a_[i].R * a[k] + chords.of_a_[i].T;
          of_b[i][k] = chords.of_b_[i].R * b[k] + chords.of_b_[i].T;
        }
      }
    }
    std::array<Eigen::Vector3d, 3> of_a[kParts + 1], of_b[kParts + 1];
  };
  /// Returns true if a slab across n, |n| = 1, stays between two triangles in a part of the time.
  /// Along the chords the gap is concave, so that it is least at an end.
  bool slabStays(const RelativeVelocities& v, const Triangles& triangles, int part,
                 const Eigen::Vector3d& n) const {
    double gap = kInfinity, length = 0, change_a = 0, change_b = 0;
    for (int i = part; i <= part + 1; ++i) {
      double high = -kInfinity, low = kInfinity;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d &x = triangles.of_a[i][k], &y = triangles.of_b[i][k];
        high = std::max(high, n.dot(x));
        low = std::min(low, n.dot(y));
        length = std::max(length, x.lpNorm<1>() + y.lpNorm<1>());
      }
      gap = std::min(gap, low - high);
    }
    if (!(gap > 0)) return false;
    for (int k = 0; k < 3; ++k) {
      change_a = std::max(change_a, v.a().accelerationAlong(n, triangles.of_a[0][k], 0));
      change_b = std::max(change_b, v.b().accelerationAlong(n, triangles.of_b[0][k], 0));
    }
    return gap >
           (sagitta_ * (change_a + change_b) + rounding_ * length + pad_ + v.pad()) * (1 + 0x1p-48);
  }

 private:
  double duration_ = -1;
  Place of_a_[kParts + 1], of_b_[kParts + 1];  // at the ends of the parts
  double sagitta_ = 0;   ///< a path leaves its chord by at most so much of its acceleration
  double rounding_ = 0;  ///< of a place, for a unit of the distance from the body's origin
  double pad_ = 0;       ///< of two places, beside that and RelativeVelocities::pad()
};

}  // namespace kios::continuous
