// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "continuous/motion.h"
#include "linkage/configuration.h"

namespace kios::articulated {

/// The motion of a body of a linkage along a path, seen from the link that carries another body
/// too.
class Chain : public continuous::KnownMotion {
 public:
  /// By the joints after the first `shared` that carry the body.
  Chain(const Path& path, int body, int shared);

  /// In the frame of the last link that the first `shared` joints carry; the world if there is
  /// none.
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
  struct Place {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
  };
  /// Moves a place from a link's parent to the link.
  void advance(Place& place, int link, double s) const;

  const Path& path_;
  const int body_;
  std::vector<int> links_;  // on the way to the body
  int turning_ = 0;         // joints that turn
  bool slides_after_ = false;
};

}  // namespace kios::articulated
