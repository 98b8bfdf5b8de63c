// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solid/ball_pairs.h"
#include "solid/solid_pair.h"

namespace kios {

/// Holds a translation of b in the world after which the solids are proven apart.
struct Exit {
  fcl::Vector3d translation = fcl::Vector3d::Zero();
  double length = 0;
  fcl::Vector3d on_a = fcl::Vector3d::Zero();  ///< a's point nearest to b then, in the world
};

/// b goes `length` along n (in the world, unit), which suffices to leave a, and a little farther
/// for rounding. Nearest points are looked for up to `reach`. Throws std::logic_error if that isn't
/// proven, which can't be.
template <typename S>
Exit goAlong(SolidPair<S>& pair, const fcl::Vector3d& n, double length, double reach);

/// b's root volume leaves a's: longer than from hull to hull, but found at once.
template <typename S>
Exit leaveRoots(SolidPair<S>& pair, const fcl::Vector3d& direction);

/// Shortens an exit by small steps along `directions` (in the world, unit), and by steps into the
/// gap that is left, towards the origin as far as the planes between nearest points allow that were
/// met on the way. Ends once the pair's tests number `last_test`.
template <typename S>
Exit leaveNearby(SolidPair<S>& pair, const Exit& exit, const std::vector<fcl::Vector3d>& directions,
                 const BallPairs& balls, long long last_test);

/// Searches likewise from where the solids' inner balls part.
template <typename S>
Exit leaveAnywhere(SolidPair<S>& pair, const Exit& exit,
                   const std::vector<fcl::Vector3d>& directions,
                   const std::vector<BallPairs::Way>& ways, const BallPairs& balls,
                   long long last_test);

}  // namespace kios
