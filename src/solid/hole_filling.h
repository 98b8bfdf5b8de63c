// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <fcl/common/types.h>

namespace kios {

/// Returns the triangles of least area that fill a hole, over its vertices and in their order
/// (Barequet and Sharir, Filling gaps in the boundary of a polyhedron, 1995). Diagonals of which
/// `avoid` is true are taken only where nothing else is left. O(k^3) in at least 3 corners. Returns
/// places among the corners.
std::vector<std::array<int, 3>> fillHole(const std::vector<fcl::Vector3d>& corners,
                                         const std::function<bool(int, int)>& avoid);

/// Returns the length of the way round.
double perimeterOf(const std::vector<fcl::Vector3d>& corners);

}  // namespace kios
