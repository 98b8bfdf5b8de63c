// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>
#include "fcl_kios/model.h"
#include "fcl_kios/volume.h"

// Oriented traversal nodes for two meshes over k-IOS, for FCL's own recursion (front lists and
// self-collision included). Models are neither copied nor moved; all tests are in A's frame.

namespace kios {

/// Finds contacts and cost sources of two meshes; contacts are in the world frame, normals from A
/// to B.
template <typename S>
class MeshCollisionTraversalNode : public fcl::detail::MeshCollisionTraversalNode<kIOS<S>> {
 public:
  bool BVTesting(int b1, int b2) const override;
  void leafTesting(int b1, int b2) const override;

  std::optional<RelativePosed> X_AB;  ///< set by initialize()
};
using MeshCollisionTraversalNoded = MeshCollisionTraversalNode<double>;
using MeshCollisionTraversalNodef = MeshCollisionTraversalNode<float>;

/// Finds the distance of two meshes. `rel_err` and `abs_err` (initialize() takes them from the
/// request) are honoured, either sufficing: d - d_exact <= max(rel_err * d_exact, abs_err). A
/// finite result->min_distance on entry is an upper bound that the query need not beat. The result
/// is updated once, in postprocess(), if a nearer pair was found.
template <typename S>
class MeshDistanceTraversalNode : public fcl::detail::MeshDistanceTraversalNode<kIOS<S>> {
 public:
  void preprocess() override;
  void postprocess() override;
  /// Returns a signed lower bound: negative values order overlapping volumes, deepest first.
  S BVTesting(int b1, int b2) const override;
  void leafTesting(int b1, int b2) const override;
  bool canStop(S bound) const override;

  std::optional<RelativePosed> X_AB;  ///< set by initialize()

 private:
  void lowerTo(S distance) const;

  mutable S best_;                                 ///< distance to beat
  mutable S prune_at_;                             ///< a node pair at least this far can't matter
  mutable int triangle_a_ = -1, triangle_b_ = -1;  ///< -1 while nothing nearer was found
  mutable fcl::Vector3d point_a_, point_b_;        ///< nearest points in A's frame
};
using MeshDistanceTraversalNoded = MeshDistanceTraversalNode<double>;
using MeshDistanceTraversalNodef = MeshDistanceTraversalNode<float>;

/// Prepares a node by FCL's signature, found by argument-dependent lookup. Throws
/// std::invalid_argument if a model is not a finished mesh, a pose is not rigid, or an error bound
/// is negative or NaN. Returns true.
template <typename S>
bool initialize(MeshCollisionTraversalNode<S>& node, const Model<S>& a,
                const fcl::Transform3<S>& X_WA, const Model<S>& b, const fcl::Transform3<S>& X_WB,
                const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);
template <typename S>
bool initialize(MeshDistanceTraversalNode<S>& node, const Model<S>& a,
                const fcl::Transform3<S>& X_WA, const Model<S>& b, const fcl::Transform3<S>& X_WB,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result);

// Arguments that aren't const would make FCL's generic initialize(), which moves the models' own
// vertices, an equal match.
template <typename S>
bool initialize(MeshCollisionTraversalNode<S>& node, Model<S>& a, fcl::Transform3<S>& X_WA,
                Model<S>& b, fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                fcl::CollisionResult<S>& result) {
  const Model<S>&m1 = a, &m2 = b;
  const fcl::Transform3<S>&x1 = X_WA, &x2 = X_WB;
  return initialize(node, m1, x1, m2, x2, request, result);
}
template <typename S>
bool initialize(MeshDistanceTraversalNode<S>& node, Model<S>& a, fcl::Transform3<S>& X_WA,
                Model<S>& b, fcl::Transform3<S>& X_WB, const fcl::DistanceRequest<S>& request,
                fcl::DistanceResult<S>& result) {
  const Model<S>&m1 = a, &m2 = b;
  const fcl::Transform3<S>&x1 = X_WA, &x2 = X_WB;
  return initialize(node, m1, x1, m2, x2, request, result);
}

}  // namespace kios

namespace fcl {
namespace detail {
using kios::initialize;  // FCL's own would take a qualified call, and move the models' vertices
}  // namespace detail
}  // namespace fcl
