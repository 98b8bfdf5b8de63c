// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "continuous/motion.h"
#include "linkage/configuration.h"

namespace kios::articulated {

/// The motion of a body of a linkage along a path, seen from the link that carries another body
/// too: the last one that the first `shared` joints carry, the world if there is none. Serves one
/// thread.
class Chain : public continuous::KnownMotion {
 public:
  Chain(const Path& path, int body, int shared);

  fcl::Transform3d pose(double s) const override;
  /// At s, and bounds over [s, s + window].
  continuous::VelocityField velocities(double s, const fcl::Transform3d& X,
                                       double window) const override;
  /// True if bounds are the same for every window.
  bool steady() const override { return turning_ == 0 || (turning_ == 1 && !slides_after_); }
  /// Bounds the rounding of velocities times a time of at most 1, of points within `reach` of the
  /// body's origin.
  double rounding(double reach) const override;

 private:
  const Configuration& at(double s) const {
    if (at_.s() != s) at_.set(at_.path(), s);
    return at_;
  }

  mutable Configuration at_;
  const int body_, shared_;
  int base_ = -1;     // the link that it is seen from
  int turning_ = 0;   // joints that turn
  double rates_ = 0;  // their sum, and that of the slides
  double slides_ = 0;
  bool slides_after_ = false;
};

}  // namespace kios::articulated
