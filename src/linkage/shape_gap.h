// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkage/link_tree.h"

namespace kios::articulated {

/// A proven lower bound of the distance of two shapes, of which one is bounded at least: GJK, our
/// own for balls and capsules, else FCL's, proposes a direction, and the slab across it, as wide as
/// the shapes' supports leave it, is the bound, whatever GJK got wrong. Negative if no slab was
/// found. Off by rounding alone, which is below 2^-46 of the lengths from the world's origin.
/// `direction`, if given, is set to the slab's, from a to b in the world, if both are bounded.
double shapeGap(const BodyData& a, const fcl::Transform3d& X_WA, const BodyData& b,
                const fcl::Transform3d& X_WB, fcl::Vector3d* direction = nullptr);

/// FCL's own verdict: are they in contact, or at most `within` > 0 apart? Half-spaces and planes
/// are judged by their gap, which is exact but for rounding: FCL finds cylinders in planes that
/// they don't meet, unless it is asked for contacts.
bool shapesMeet(const BodyData& a, const fcl::Transform3d& X_WA, const BodyData& b,
                const fcl::Transform3d& X_WB, double within);

}  // namespace kios::articulated
