// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_queries.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <vector>

#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include "fcl_kios/query/mesh_nodes.h"
#include "model/prepared.h"
#include "query/mesh_pair.h"
#include "query/pair_search.h"
#include "volume/far_apart.h"

namespace kios {
namespace {

/// FCL's trees, searched until a pair is found or so many tests are made.
template <typename S>
class LimitedNode final : public MeshCollisionTraversalNode<S> {
 public:
  explicit LimitedNode(long long limit) : limit_(limit) { this->enable_statistics = true; }

  bool canStop() const override {
    return MeshCollisionTraversalNode<S>::canStop() || tests() >= limit_;
  }
  /// Of volumes; a test of triangles takes as long as four.
  long long tests() const { return this->num_bv_tests + 4LL * this->num_leaf_tests; }
  bool gaveUp() const { return tests() >= limit_; }

 private:
  const long long limit_;
};

/// Decides by FCL's trees whether two models touch, as long as it hasn't paid to prepare both of
/// them. Returns false if the engine is to decide.
template <typename S>
bool touchUnprepared(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                     const fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                     fcl::CollisionResult<S>& result, SearchCounts& counts) {
  engine::TreeCache *const trees_a = treesOf(a), *const trees_b = treesOf(b);
  if (!trees_a || !trees_b) return false;
  const long long limit = std::max(trees_a->testsToSpare(static_cast<std::size_t>(a.num_tris)),
                                   trees_b->testsToSpare(static_cast<std::size_t>(b.num_tris)));
  if (limit == 0) return false;
  LimitedNode<S> node(limit);
  initialize(node, a, X_WA, b, X_WB, request, result);
  fcl::detail::collide(&node);
  trees_a->spend(node.tests());
  if (trees_b != trees_a) trees_b->spend(node.tests());
  counts.volume_tests += node.num_bv_tests;
  counts.leaf_pairs += node.num_leaf_tests;
  if (node.gaveUp() && !request.isSatisfied(result)) return false;
  ++counts.tree_searches;
  return true;
}

/// collideMeshes() of models that may touch, for all that farApart() can tell.
template <typename S>
[[gnu::noinline]] void collideNear(const PairFrame<S>& frame, const fcl::Transform3<S>& X_WA,
                                   const fcl::Transform3<S>& X_WB,
                                   const fcl::CollisionRequest<S>& request,
                                   fcl::CollisionResult<S>& result, SearchCounts& counts) {
  if (frame.rootBound(0) > 0) return;
  const Model<S>&a = frame.a, &b = frame.b;
  const bool occupied = a.isOccupied() && b.isOccupied();
  if (occupied && !request.enable_cost) {
    const bool verdict = request.num_max_contacts == 1 && !request.enable_contact;
    if (verdict && touchUnprepared(a, X_WA, b, X_WB, request, result, counts)) return;
    const std::size_t room = request.num_max_contacts - result.numContacts();
    std::vector<engine::TrianglePairIds> found;
    if (searchContacts(frame, room, found, counts)) {
      for (const auto& ids : found) {
        addContacts(a, ids.a, frame.triangleA(ids.a), b, ids.b, frame.triangleB(ids.b), X_WA,
                    request, result);
      }
      return;
    }
  }
  ++counts.tree_searches;
  MeshCollisionTraversalNode<S> node;
  initialize(node, a, X_WA, b, X_WB, request, result);
  fcl::detail::collide(&node);
}

}  // namespace

template <typename S>
std::size_t collideMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                          const fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                          fcl::CollisionResult<S>& result, SearchCounts* counts) {
  requireFinished(a);
  requireFinished(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  const bool done = request.num_max_contacts == 0 || request.isSatisfied(result);
  if (done || !farApart(a.getBV(0).bv, X_WA, b.getBV(0).bv, X_WB, squared_errors, 0)) {
    const PairFrame<S> frame(a, X_WA, b, X_WB, squared_errors);  // throws where farApart() can't
    if (request.num_max_contacts == 0) {                         // FCL's warning and answer
      std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
      return 0;
    }
    SearchCounts unused;
    if (!done) collideNear(frame, X_WA, X_WB, request, result, counts ? *counts : unused);
  }
  return result.numContacts();
}

template <typename S>
S distanceMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                 const fcl::Transform3<S>& X_WB, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result, SearchCounts* counts) {
  requireErrorBounds(request);
  requireFinished(a);
  requireFinished(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  engine::PairQuery query;
  query.rel_err = request.rel_err;
  query.abs_err = request.abs_err;
  const bool bounded = result.min_distance < std::numeric_limits<S>::max();
  if (bounded) {  // as if a pair so far were found
    query.far_enough = query.pruneAt(result.min_distance);
    if (farApart(a.getBV(0).bv, X_WA, b.getBV(0).bv, X_WB, squared_errors, query.far_enough)) {
      return result.min_distance;
    }
  }
  const PairFrame<S> frame(a, X_WA, b, X_WB, squared_errors);
  const bool far = bounded && frame.rootBound(query.far_enough) >= query.far_enough;
  if (far || request.isSatisfied(result)) return result.min_distance;
  SearchCounts unused;
  const engine::PairAnswer<S> answer = searchNearest(frame, query, counts ? *counts : unused);
  const TriangleDistance<S>& nearest = answer.nearest;
  if (!answer.found() || !(nearest.distance < result.min_distance)) return result.min_distance;
  if (request.enable_nearest_points) {
    result.update(nearest.distance, &a, &b, answer.ids.a, answer.ids.b,
                  detail::transform<S>(X_WA, nearest.point_a),
                  detail::transform<S>(X_WA, nearest.point_b));
  } else {
    result.update(nearest.distance, &a, &b, answer.ids.a, answer.ids.b);
  }
  return result.min_distance;
}

#define KIOS_INSTANTIATE(S)                                                                       \
  template std::size_t collideMeshes(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&, \
                                     const fcl::Transform3<S>&, const fcl::CollisionRequest<S>&,  \
                                     fcl::CollisionResult<S>&, SearchCounts*);                    \
  template S distanceMeshes(const Model<S>&, const fcl::Transform3<S>&, const Model<S>&,          \
                            const fcl::Transform3<S>&, const fcl::DistanceRequest<S>&,            \
                            fcl::DistanceResult<S>&, SearchCounts*);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
