// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkage/body_queries.h"

namespace kios::articulated {

/// Tries to prove a whole path of two bodies by what turns about a line or a point leave as it is:
/// a shaft in its bearing, a ball in its socket. The points of either body have distances r from
/// the line and heights z along it, in which the bodies are compared as if they were flat; or
/// distances from the point alone. Slabs between triangles (linkage/local_slabs.h) take 200
/// times as long for a shaft that turns by 3 rad at a clearance of a hundredth of its radius, and
/// 1,000 times at a thousandth.
///
/// Both maps bring no two points farther apart. So the bodies stay apart by more than
/// `min_separation` if their images do, with the pivot's slack. An image is bounded by intervals of
/// r, z, r + z and r - z, node by node of FCL's trees, from the triangles up:
///
///    r |  ###########  bearing         r of a triangle is convex, so that r, r + z and r - z are
///      |  -----------  gap             largest at a corner; and r(x) >= n x for any unit n across
///      |.=============. shaft          the axis, so that they are at least the least of n x, n x +
///      z
///      +---------------> z             and n x - z at the corners.
///
/// One of the bodies is a mesh, `at` is best in the middle of the path, where they are at most
/// `apart` from each other: a pivot of more slack proves nothing. `cost` is what was spent, in
/// tests of volumes.
bool orbitsApart(const Path& path, const Pair& pair, const Configuration& at, double apart,
                 double min_separation, long long& cost);

}  // namespace kios::articulated
