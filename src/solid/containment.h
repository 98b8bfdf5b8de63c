// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"

namespace kios {

/// Returns true if the surfaces have a point in common: exact in the common frame.
template <typename S>
bool surfacesMeet(const MeshPair<S>& frame, SearchCounts& counts);

/// Returns a point of a's or b's surface, in a's frame, that lies in the other solid; none if no
/// component of either lies in the other. Both must be solids, and their surfaces disjoint in the
/// common frame: then it is exact in that frame, since a component is in the other solid with all
/// of its points or with none.
template <typename S>
std::optional<fcl::Vector3d> containedPoint(const MeshPair<S>& frame, SearchCounts& counts);

/// A bound of |y - x| for the point x of b that the common frame's exact pose, entries as they are
/// stored, takes to a point p, |p|_1 <= norm1, and y = R^T (p - T) as double computes it.
template <typename S>
double inverseError(const RelativePose<S>& X_AB, double norm1);

/// Returns R^T (p - T), in double.
template <typename S>
fcl::Vector3d toB(const RelativePose<S>& X_AB, const fcl::Vector3d& p);

}  // namespace kios
