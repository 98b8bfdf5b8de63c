// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl/mesh_queries.h"

#include <iostream>
#include <limits>

#include "fcl/narrowphase/detail/traversal/collision_node.h"
#include "fcl_kios/fcl/mesh_nodes.h"

namespace kios {

template <typename S>
std::size_t collideMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1,
                          const Model<S>& model2, const fcl::Transform3<S>& tf2,
                          const fcl::CollisionRequest<S>& request,
                          fcl::CollisionResult<S>& result) {
  MeshCollisionTraversalNode<S> node;
  initialize(node, model1, tf1, model2, tf2, request, result);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  if (!request.isSatisfied(result)) fcl::detail::collide(&node);
  return result.numContacts();
}

template <typename S>
S distanceMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1, const Model<S>& model2,
                 const fcl::Transform3<S>& tf2, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result) {
  MeshDistanceTraversalNode<S> node;
  initialize(node, model1, tf1, model2, tf2, request, result);
  if (request.isSatisfied(result)) return result.min_distance;
  if (result.min_distance < std::numeric_limits<S>::max()) {  // a bound that the roots may exceed
    node.preprocess();
    if (node.canStop(node.BVTesting(0, 0))) return result.min_distance;
  }
  fcl::detail::distance(&node);
  return result.min_distance;
}

#define KIOS_INSTANTIATE(S)                                                                       \
  template std::size_t collideMeshes(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&, \
                                     const fcl::Transform3<S>&, const fcl::CollisionRequest<S>&,  \
                                     fcl::CollisionResult<S>&);                                   \
  template S distanceMeshes(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&,          \
                            const fcl::Transform3<S>&, const fcl::DistanceRequest<S>&,            \
                            fcl::DistanceResult<S>&);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
