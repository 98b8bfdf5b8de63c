// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include "fcl_kios/model/model.h"

namespace kios {

/// FCL's approximate costs of a model and an octree: one source for each unknown cell that the root
/// volume's box touches, where the cell's and the box's boxes in the world overlap. FCL tests cells
/// down to the unknown ones, each anew; here only those that may be among the dearest sources are
/// looked at, with the box placed once among them.
template <typename S>
void addApproximateCost(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                        const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                        const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
