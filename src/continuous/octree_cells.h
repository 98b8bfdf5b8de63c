// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/config.h>

#if FCL_HAVE_OCTOMAP
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include "continuous/mesh_and_solids.h"

namespace kios::continuous {

/// Returns the occupied cells of an octree that the moving mesh may come near to, as a tree of
/// boxes in the octree's frame. Occupied as in FCL's collision: every cell down to a leaf is.
std::vector<ShapeNode> cellsNear(const fcl::OcTree<double>& octree, const Motion& octree_motion,
                                 const Modeld& mesh, const Motion& mesh_motion);

}  // namespace kios::continuous
#endif  // FCL_HAVE_OCTOMAP
