// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>
#include "preload/calls.h"
#include "preload/fcl_mesh.h"

// FCL's own search of two of its meshes: its nodes, tests and order, as fcl::collide and
// fcl::distance make them, but for an end after so much work. What ends by itself is FCL's answer
// to the bit.

namespace kios::preload {

/// Estimates of FCL's tests, in nanoseconds.
struct Price {
  double volumes, triangles;
};
constexpr Price kCollidePrice = {55, 220}, kDistancePrice = {115, 330};

/// Says how a search ended, and what it cost by the prices above.
struct Search {
  bool done;
  double nanoseconds;
};

template <typename BV>
struct FclNodes;
template <>
struct FclNodes<fcl::OBBd> {
  using Collide = fcl::detail::MeshCollisionTraversalNodeOBB<double>;
};
template <>
struct FclNodes<fcl::kIOSd> {
  using Collide = fcl::detail::MeshCollisionTraversalNodekIOS<double>;
  using Distance = fcl::detail::MeshDistanceTraversalNodekIOS<double>;
};
template <>
struct FclNodes<fcl::RSSd> {
  using Distance = fcl::detail::MeshDistanceTraversalNodeRSS<double>;
};
template <>
struct FclNodes<fcl::OBBRSSd> {
  using Collide = fcl::detail::MeshCollisionTraversalNodeOBBRSS<double>;
  using Distance = fcl::detail::MeshDistanceTraversalNodeOBBRSS<double>;
};

/// Gives one of FCL's nodes an end.
template <typename Node>
class LimitedNode : public Node {
 public:
  LimitedNode(const Price& price, double limit) : price_(price), limit_(limit) {
    this->enable_statistics = true;
  }
  double spent() const {
    return price_.volumes * this->num_bv_tests + price_.triangles * this->num_leaf_tests;
  }
  bool hasEnded() const { return spent() >= limit_; }

 private:
  const Price price_;
  const double limit_;
};

/// Ends before it is done only while it has found nothing.
template <typename Node>
class LimitedCollision final : public LimitedNode<Node> {
 public:
  LimitedCollision(double limit, std::size_t contacts_before)
      : LimitedNode<Node>(kCollidePrice, limit), contacts_before_(contacts_before) {}

  bool foundNothing() const { return this->result->numContacts() == contacts_before_; }
  bool canStop() const override {
    return foundNothing() ? this->hasEnded() : this->request.isSatisfied(*this->result);
  }

 private:
  const std::size_t contacts_before_;
};

template <typename Node>
class LimitedDistance final : public LimitedNode<Node> {
 public:
  explicit LimitedDistance(double limit) : LimitedNode<Node>(kDistancePrice, limit) {}

  /// Finds FCL's own rule, whose errors are never set.
  bool canStop(double bound) const override {
    if (bound >= this->result->min_distance) return true;
    ended_ = ended_ || this->hasEnded();
    return ended_;
  }
  bool ended() const { return ended_; }

 private:
  mutable bool ended_ = false;
};

/// Finds FCL's first test, of the volumes of the whole models.
template <typename BV>
bool rootsOverlap(const fcl::BVHModel<BV>& a, const Pose& X_WA, const fcl::BVHModel<BV>& b,
                  const Pose& X_WB) {
  fcl::Matrix3d R;
  fcl::Vector3d T;
  fcl::relativeTransform(X_WA.linear(), X_WA.translation(), X_WB.linear(), X_WB.translation(), R,
                         T);
  return overlap(R, T, a.getBV(0).bv, b.getBV(0).bv);
}

/// Returns the rest of FCL's search of models whose roots overlap. Adds to the result; nothing if
/// it ends before it is done.
template <typename BV>
Search collideByFcl(const fcl::BVHModel<BV>& a, const Pose& X_WA, const fcl::BVHModel<BV>& b,
                    const Pose& X_WB, const CollisionRequest& request, CollisionResult& result,
                    double limit) {
  LimitedCollision<typename FclNodes<BV>::Collide> node(limit, result.numContacts());
  fcl::detail::initialize(node, a, X_WA, b, X_WB, request, result);
  const bool leaf_a = node.isFirstNodeLeaf(0), leaf_b = node.isSecondNodeLeaf(0);
  if (leaf_a && leaf_b) {
    node.leafTesting(0, 0);
  } else {
    const bool first = node.firstOverSecond(0, 0);
    const int left = first ? node.getFirstLeftChild(0) : node.getSecondLeftChild(0);
    const int right = first ? node.getFirstRightChild(0) : node.getSecondRightChild(0);
    for (const int child : {left, right}) {
      if (child == right && node.canStop()) break;
      fcl::detail::CollisionTraversalNodeBase<double>* const base = &node;
      fcl::detail::collisionRecurse(base, first ? child : 0, first ? 0 : child,
                                    static_cast<fcl::detail::BVHFrontList*>(nullptr));
    }
  }
  return {!(node.foundNothing() && node.hasEnded()), node.spent()};
}

/// Returns FCL's search for the distance. Lowers the result if it is done, else leaves it.
template <typename BV>
Search distanceByFcl(const fcl::BVHModel<BV>& a, const Pose& X_WA, const fcl::BVHModel<BV>& b,
                     const Pose& X_WB, const DistanceRequest& request, DistanceResult& result,
                     double limit) {
  LimitedDistance<typename FclNodes<BV>::Distance> node(limit);
  DistanceResult found = result;
  fcl::detail::initialize(node, a, X_WA, b, X_WB, request, found);
  fcl::detail::DistanceTraversalNodeBase<double>* const base = &node;
  fcl::detail::distance(base);
  if (!node.ended()) result = found;
  return {!node.ended(), node.spent()};
}

}  // namespace kios::preload
