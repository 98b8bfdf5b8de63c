// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/config.h>

#if FCL_HAVE_OCTOMAP

#include <fcl/geometry/octree/octree.h>

namespace kios::continuous {

/// The least box around an octree's occupied cells, in its frame, but for rounding; empty if there
/// are none. Occupied as in FCL's collision: every cell down to a leaf is. Looks at few cells of
/// most octrees: a branch and bound along each axis, so that a call can afford it, as octrees
/// change in place and octomap counts no changes.
Eigen::AlignedBox3d occupiedBox(const fcl::OcTreed& octree);

}  // namespace kios::continuous
#endif  // FCL_HAVE_OCTOMAP
