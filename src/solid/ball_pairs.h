// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

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

  /// Holds a direction, unit, and the length by which b seems to leave a along it: all balls, grown
  /// by gap(), are left.
  struct Way {
    fcl::Vector3d direction;
    double reach;
  };
  /// Returns ways along the axes, the diagonals and these directions, the shortest first.
  std::vector<Way> ways(const std::vector<fcl::Vector3d>& directions) const;
  /// Returns the length by which all balls, grown by so much, are left along n.
  double reach(const fcl::Vector3d& n, double grown) const;
  /// Finds a translation near `from` at which they are: it is moved out of the ball in which it is
  /// deepest, again and again.
  fcl::Vector3d escape(const fcl::Vector3d& from, double grown) const;
  /// Returns true if balls meet after a translation, and with them the solids.
  bool meet(const fcl::Vector3d& translation) const;
  /// Returns the point that is deepest in a ball of each; none if no two meet.
  std::optional<fcl::Vector3d> common() const;
  /// Returns about what the balls leave out of the solids.
  double gap() const { return gap_; }

 private:
  std::vector<InnerBalls::Ball> a_, b_;
  double gap_, unit_;  ///< floats are in units of the solids' size: none over- or underflows
  Eigen::ArrayXf x_, y_, z_, radius_, square_, inner_square_;
  // Scratch.
  mutable Eigen::ArrayXf middle_, half_;
  mutable std::vector<std::pair<float, float>> chords_;
};

}  // namespace kios
