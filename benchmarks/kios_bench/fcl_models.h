// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include "calls.h"

namespace kios::bench {

/// Prepares FCL's recursion over the volume's own traversal node, in the models as they are: no
/// dispatch, no engine. fcl::detail::distance(&node) or collide(&node) runs it.
template <typename Node, typename BV, typename Request, typename Result>
void start(Node& node, const fcl::BVHModel<BV>& a, const fcl::Transform3d& X_WA,
           const fcl::BVHModel<BV>& b, const fcl::Transform3d& X_WB, const Request& request,
           Result& result) {
  if (!initialize(node, a, X_WA, b, X_WB, request, result)) {
    throw std::runtime_error("the traversal refused the models");
  }
}

/// Returns bytes of nodes, primitive indices, vertices and triangles.
template <typename BV>
std::size_t bytesOf(const fcl::BVHModel<BV>& model) {
  const std::size_t nodes = model.getNumBVs();
  return nodes * (sizeof(fcl::BVNode<BV>) + sizeof(unsigned int)) +
         model.num_vertices * sizeof(fcl::Vector3d) + model.num_tris * sizeof(fcl::Triangle);
}

/// The calls of a user, as FclCalls, by nodes.
template <typename BV, typename DistanceNode, typename CollisionNode>
struct NodeCalls {
  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    DistanceNode node;
    start(node, modelOf(a), a->getTransform(), modelOf(b), b->getTransform(), request, result);
    fcl::detail::distance(&node);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    CollisionNode node;
    start(node, modelOf(a), a->getTransform(), modelOf(b), b->getTransform(), request, result);
    fcl::detail::collide(&node);
  }

 private:
  static const fcl::BVHModel<BV>& modelOf(const fcl::CollisionObjectd* object) {
    return static_cast<const fcl::BVHModel<BV>&>(*object->collisionGeometry());
  }
};

}  // namespace kios::bench
