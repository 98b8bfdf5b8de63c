// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>
#include "solid/solid_pair.h"

namespace kios {

/// Holds the translations after which an inner ball of b meets one of a: balls about the
/// differences of centres, of radii that add up. A cheap picture of the pair, to look for ways out;
/// nothing is proven by it. All in a's frame.
class BallPairs {
 public:
  template <typename S>
  explicit BallPairs(const SolidPair<S>& pair);

  /// Finds a translation near `from` at which all balls, grown by about what they leave out of the
  /// solids, are left: it is moved out of the ball in which it is deepest, again and again.
  fcl::Vector3d escape(const fcl::Vector3d& from) const;
  /// Returns true if balls meet after a translation, and with them the solids.
  bool meet(const fcl::Vector3d& translation) const;
  /// Returns the point that is deepest in a ball of each; none if no two meet.
  const std::optional<fcl::Vector3d>& common() const { return common_; }
  /// Returns how far b must go at least for the two balls that meet most deeply to part.
  double depth() const { return depth_; }

 private:
  std::optional<fcl::Vector3d> common_;
  double depth_ = 0;
  double unit_;  ///< floats are in units of the solids' size: none over- or underflows
  Eigen::ArrayXf x_, y_, z_, inner_square_, grown_square_;
  mutable Eigen::ArrayXf depth_in_;  ///< scratch
};

}  // namespace kios
