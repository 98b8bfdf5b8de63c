// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "mesh_set.h"

namespace kios::bench {

/// What Traits of a MeshSet need for queries by FCL's recursion over the volume's own traversal
/// nodes, in the models as they are: no dispatch, no engine.
template <typename DistanceNode, typename CollisionNode>
struct NodeQueries : CountedByNodes<DistanceNode, CollisionNode> {
  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    DistanceNode node;
    initialize(node, modelOf<DistanceNode>(*a), a->getTransform(), modelOf<DistanceNode>(*b),
               b->getTransform(), request, result);
    fcl::detail::distance(&node);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    CollisionNode node;
    initialize(node, modelOf<CollisionNode>(*a), a->getTransform(), modelOf<CollisionNode>(*b),
               b->getTransform(), request, result);
    fcl::detail::collide(&node);
  }
  static std::optional<std::string> simdTarget() { return std::nullopt; }

 private:
  template <typename Node>
  static const auto& modelOf(const fcl::CollisionObjectd& object) {
    using Model = std::remove_pointer_t<decltype(Node::model1)>;  // const
    return static_cast<Model&>(*object.collisionGeometry());
  }
};

}  // namespace kios::bench
