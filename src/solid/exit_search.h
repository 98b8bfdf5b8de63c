// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "solid/inner_balls.h"
#include "solid/minkowski_hull.h"
#include "solid/solid_pair.h"

namespace kios {

/// A translation of b in the world after which the solids are proven apart.
struct Exit {
  fcl::Vector3d translation = fcl::Vector3d::Zero();
  double length = kInfinity;
  Separation after;
};

/// Directions in a's frame, unit, along which b may leave a: the mean normals of what meets, or the
/// way to the nearest wall.
std::vector<fcl::Vector3d> meanDirections(SolidPair& pair);

/// Search for a short exit, by tests of the pair.
class ExitSearch {
 public:
  explicit ExitSearch(SolidPair& pair) : pair_(pair) {}

  const Exit& best() const { return best_; }

  /// b leaves a's hull along the one of these directions in a's frame that takes it out soonest.
  /// Throws std::logic_error if that isn't proven, which can't be.
  void leaveHulls(const Differences& differences, const std::vector<fcl::Vector3d>& directions);

  /// Looks for a shorter exit past what meets. Two triangles part beyond a plane of one's face, on
  /// either side, or of an edge of each. The translations that are nearest to the origin beyond
  /// such planes are tried, one plane for each two triangles and the nearest first, until nothing
  /// meets. Ends after tuning::kCorners translations, and once the pair's tests number `last_test`.
  /// Returns false if it ended too soon to tell.
  bool leaveByPlanes(long long last_test);

  /// Likewise for what overlaps by more than triangles measure: b leaves to where inner balls part.
  /// From there steps lead into the gap that is left, towards the origin as far as the planes
  /// between nearest points allow that were met on the way.
  void leaveByBalls(const BallPairs& balls, long long last_test);

 private:
  bool exhausted() const { return pair_.tests() >= last_test_; }
  bool goAlong(const fcl::Vector3d& n, double length, int tries);
  void tryStarts(const BallPairs& balls);
  void descend(const BallPairs& balls);

  SolidPair& pair_;
  long long last_test_ = 0;
  Exit best_;
};

}  // namespace kios
