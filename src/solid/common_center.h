// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solid/solid_pair.h"

namespace kios {

/// Returns a lower bound of the length of any translation that parts the solids: if balls of radii
/// r and s about one point lie in a and in b, their interiors part only where |t| >= r + s. The
/// point is sought on the way by which b leaves, from `on_a` against `translation` (in the world):
/// at its ends, where solids touch that overlap by little. If `fully`, it is sought between them
/// and from `common` (in a's frame), and from there uphill, until the bound reaches `required` or
/// little more can be hoped for. 0 if no common point was found.
template <typename S>
double depthOfBalls(SolidPair<S>& pair, const fcl::Vector3d& on_a, const fcl::Vector3d& translation,
                    double required, bool fully, const std::optional<fcl::Vector3d>& common);

}  // namespace kios
