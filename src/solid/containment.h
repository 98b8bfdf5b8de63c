// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fcl_kios/model/model.h"
#include "fcl_kios/search/counts.h"
#include "search/mesh_pair.h"

namespace kios {

/// Returns a point of a's or b's surface, in a's frame, that lies in the other solid; none if no
/// component of either lies in the other. Both must be solids, and their surfaces disjoint in the
/// common frame: then it is exact in that frame, since a component is in the other solid with all
/// of its points or with none.
template <typename S>
std::optional<fcl::Vector3d> containedPoint(const Model<S>& a, const Model<S>& b,
                                            const MeshPair& frame, SearchCounts& counts);

/// A bound of |y - x| for the point x of b that the common frame's exact pose, entries as they are
/// stored, takes to a point p, |p|_1 <= norm1, and y = R^T (p - T) as double computes it.
double inverseError(const RelativePose<double>& X_AB, double norm1);

/// Returns R^T (p - T), in double.
fcl::Vector3d toB(const RelativePose<double>& X_AB, const fcl::Vector3d& p);

}  // namespace kios
