// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include "shape/solid.h"

namespace kios {

/// The cube of an octree's root, about the origin.
template <typename S>
shape::Solid rootCube(const fcl::OcTree<S>& octree) {
  shape::Solid cube;
  cube.kind = shape::Kind::kBox;
  cube.half = octree.getRootBV().max_.template cast<double>();
  return cube;
}

/// collideOctree() but for costs by approximation. Returns false if the request was satisfied.
/// Contacts come in an order that the model, the octree and the poses determine, and whether the
/// model was prepared.
template <typename S>
bool addOctreeContacts(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO,
                       const Model<S>& model, const fcl::Transform3<S>& X_WM,
                       const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                       SearchCounts& counts);

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
