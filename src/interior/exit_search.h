// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "interior/minkowski_hull.h"
#include "interior/solid_pair.h"

namespace kios {

/// A translation of b in the world after which the solids are proven apart.
struct Exit {
  fcl::Vector3d translation = fcl::Vector3d::Zero();
  double length = 0;
  fcl::Vector3d on_a = fcl::Vector3d::Zero();  ///< a's point nearest to b then, in the world
};

/// b leaves a's hull along `direction` (in the world, unit): the length that suffices, and a little
/// more for rounding. Nearest points are looked for up to `reach`. Throws std::logic_error if that
/// isn't proven, which can't be.
template <typename S>
Exit leaveHull(SolidPair<S>& pair, const Differences<S>& differences,
               const fcl::Vector3d& direction, double reach);

/// Shortens an exit: along `directions` (in the world, unit), and then by steps into the gap that
/// is left, towards the origin as far as the planes between nearest points allow that were met on
/// the way. `tests` bounds its tests.
template <typename S>
Exit shorten(SolidPair<S>& pair, const Exit& exit, const std::vector<fcl::Vector3d>& directions,
             int tests);

}  // namespace kios
