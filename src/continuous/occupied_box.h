// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/config.h>

#if FCL_HAVE_OCTOMAP

#include <fcl/geometry/octree/octree.h>
#include "volume/rounding.h"

namespace kios::continuous {

/// A box around an octree's occupied cells, in its frame; low > high if there are none.
struct OccupiedBox {
  fcl::Vector3d low = fcl::Vector3d::Constant(kInfinity);
  fcl::Vector3d high = -low;

  bool empty() const { return !(low.x() <= high.x()); }
  /// True if the other box lies within this one; an empty one does.
  bool holds(const OccupiedBox& other) const {
    return other.empty() ||
           ((low.array() <= other.low.array()).all() && (high.array() >= other.high.array()).all());
  }
};

/// The least such box, but for rounding. Occupied as in FCL's collision: every cell down to a leaf
/// is. Looks at few cells of most octrees: a branch and bound along each axis, so that a call can
/// afford it, as octrees change in place and octomap counts no changes.
OccupiedBox occupiedBox(const fcl::OcTreed& octree);

}  // namespace kios::continuous
#endif  // FCL_HAVE_OCTOMAP
