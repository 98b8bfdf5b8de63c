// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "fcl_kios/volume.h"
#include "search/mesh.h"

namespace kios {

/// Balls in a solid, in its frame: none is nearer to the surface than its radius, and all centres
/// are inside. Proven.
struct InnerBalls {
  struct Ball {
    fcl::Vector3d center;
    double radius;
  };
  std::vector<Ball> balls;
  double gap = 0;  ///< about the mean distance of the surface from them
};

/// Returns balls that touch the surface, each where the ones before it leave most out.
InnerBalls innerBalls(const Mesh& mesh);

/// The translations after which an inner ball of b meets one of a: balls about the differences of
/// centres, of radii that add up. A cheap picture of the pair, to look for ways out; nothing is
/// proven by it. All in a's frame.
class BallPairs {
 public:
  BallPairs(const InnerBalls& a, const InnerBalls& b, const RelativePose<double>& X_AB);

  /// Finds a translation near `from` at which all balls, grown by about what they leave out of the
  /// solids, are left: it is moved out of the ball in which it is deepest, again and again.
  fcl::Vector3d escape(const fcl::Vector3d& from) const;
  /// Returns true if balls meet after a translation, and with them the solids.
  bool meet(const fcl::Vector3d& translation) const;
  /// The point that is deepest in a ball of each; none if no two meet.
  const std::optional<fcl::Vector3d>& common() const { return common_; }
  /// How far b must go at least for the two balls that meet most deeply to part.
  double depth() const { return depth_; }

 private:
  struct Pair {
    fcl::Vector3d center;
    double radius;
  };
  std::vector<Pair> pairs_;
  double gap_;  ///< by which they are grown
  std::optional<fcl::Vector3d> common_;
  double depth_ = 0;
};

}  // namespace kios
