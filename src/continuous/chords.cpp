// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/chords.h"

#include "volume/rounding.h"

namespace kios::continuous {

void Chords::set(const RelativeMotion& motion, double t, double h) {
  duration_ = h;
  const fcl::Transform3d X_WA = motion.a().pose(t);
  const Eigen::Matrix3d inverse = X_WA.linear().transpose();
  double lengths = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double at = i == kParts ? h : h * i / kParts;
    const auto place = [&](const Motion& body, Place& to) {
      const fcl::Transform3d X = body.pose(std::min(1.0, t + at + (i == kParts ? 0x1p-52 : 0)));
      to.R = inverse * X.linear();
      to.T = inverse * (X.translation() - X_WA.translation());
      lengths = std::max(lengths, to.T.lpNorm<1>());
    };
    place(motion.a(), of_a_[i]);
    place(motion.b(), of_b_[i]);
  }
  // The last place is not before t + h. Times round by u, and so parts of the time by a few u of 1,
  // which velocities multiply: that is below the rounding of places.
  const double part = h / kParts + 0x1p-50;
  sagitta_ = 0.125 * part * part * (1 + 0x1p-40);
  rounding_ = motion.turnRounding() + 128 * kUlpDouble;
  pad_ = 256 * kUlpDouble * lengths;
}

}  // namespace kios::continuous
