// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_queries.h"

#include <algorithm>
#include <iostream>
#include <limits>

#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include "fcl_kios/query/mesh_nodes.h"
#include "model/kios_model.h"
#include "query/few_triangles.h"
#include "query/mesh_contacts.h"
#include "query/pair_search.h"
#include "query/smaller_off_box.h"
#include "query/unprepared.h"
#include "volume/far_apart.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// By FCL's traversal, for models that the engine can't serve.
template <typename S>
[[gnu::noinline]] void collideByFCL(const MeshPair<S>& frame, const fcl::Transform3<S>& X_WA,
                                    const fcl::Transform3<S>& X_WB,
                                    const fcl::CollisionRequest<S>& request,
                                    fcl::CollisionResult<S>& result, SearchCounts& counts) {
  ++counts.tree_searches;
  MeshCollisionTraversalNode<S> node;
  initialize(node, frame.a, X_WA, frame.b, X_WB, request, result);
  fcl::detail::collide(&node);
}

/// collideMeshes() of models that may touch, for all that their roots tell at once.
template <typename S>
[[gnu::noinline, gnu::hot]] void collideNear(const MeshPair<S>& frame,
                                             const fcl::Transform3<S>& X_WA,
                                             const fcl::Transform3<S>& X_WB,
                                             const fcl::CollisionRequest<S>& request,
                                             fcl::CollisionResult<S>& result,
                                             SearchCounts& counts) {
  const Model<S>&a = frame.a, &b = frame.b;
  const Reports<S> reports(a, b, request);
  if (!reports.contacts && !reports.costs) return;
  const std::size_t room =
      request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  const std::size_t limit = reports.costs ? std::numeric_limits<std::size_t>::max() : room;
  if (limit == 0) return;
  const bool verdict = request.num_max_contacts == 1 && !request.enable_contact && !reports.costs;
  const auto found = intersectingPairs(frame, limit, verdict, counts);
  if (!found) return collideByFCL(frame, X_WA, X_WB, request, result, counts);
  for (const auto& ids : *found) {
    addReports(reports, a, ids.a, frame.triangleA(ids.a), X_WA, b, ids.b, frame.triangleB(ids.b),
               X_WB, request, result);
  }
}

/// The answer of distanceMeshes() to pairs that may be nearer than query.far_enough.
template <typename S>
[[gnu::hot]] engine::PairAnswer<S> nearestOf(const MeshPair<S>& frame,
                                             const engine::PairQuery& query, SearchCounts& counts) {
  // Almost any triangles are near enough where the error that is allowed is as large as a mesh, as
  // the nearest are no nearer than the root volumes.
  const bool single = frame.a.num_tris == 1 && frame.b.num_tris == 1;
  if (single || query.abs_err > std::min<double>(frame.rootA().radius0, frame.rootB().radius0)) {
    engine::PairAnswer<S> answer;
    answer.ids = {0, 0};
    answer.nearest = frame.distanceOf(answer.ids);
    ++counts.leaf_pairs;
    ++counts.exact;
    const double distance = double{answer.nearest.distance};
    if (single || distance <= query.abs_err) return answer;
    if (distance <= query.abs_err + frame.rootBound(distance)) return answer;
  }
  if (query.isExact() && arePairByPair(frame.a, frame.b)) {
    return searchNearest(frame, query, counts);
  }
  if (query.isExact() && !arePrepared(frame) && engineServes(frame)) {
    if (areVeryFew(frame.a, frame.b) && !treesPay(frame)) {
      constexpr long long kTests = 6;  // take as long as a pair of triangles
      const long long before = counts.exact;
      const auto touching = touchingOfFew(frame, query, counts);
      if (touching && touching->found()) {
        charge(frame, kTests);
        return *touching;
      }
      engine::PairAnswer<S> answer = nearestOfFew(frame, query, counts);
      charge(frame, kTests * (counts.exact - before));
      return answer;
    }
    const auto answer = nearestUnprepared(frame, query, counts);
    if (answer) return *answer;
  }
  return searchNearest(frame, query, counts);
}

}  // namespace

template <typename S>
[[gnu::hot]] std::size_t collideMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                       const Model<S>& b, const fcl::Transform3<S>& X_WB,
                                       const fcl::CollisionRequest<S>& request,
                                       fcl::CollisionResult<S>& result, SearchCounts* counts) {
  requireFinished(a);
  requireFinished(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  const bool done = request.num_max_contacts == 0 || request.isSatisfied(result);
  const CentralWay way(a.getBV(0).bv, X_WA, b.getBV(0).bv, X_WB);
  if (done || !(farApart<S>(way, squared_errors, 0) ||
                smallerOffBox(a, X_WA, b, X_WB, way, squared_errors, 0))) {
    const MeshPair<S> frame(a, X_WA, b, X_WB, squared_errors);  // throws where they can't tell
    if (request.num_max_contacts == 0) {                        // FCL's warning and answer
      std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
      return 0;
    }
    SearchCounts unused;
    if (!done) collideNear(frame, X_WA, X_WB, request, result, counts ? *counts : unused);
  }
  return result.numContacts();
}

template <typename S>
[[gnu::hot]] S distanceMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                              const fcl::Transform3<S>& X_WB,
                              const fcl::DistanceRequest<S>& request,
                              fcl::DistanceResult<S>& result, SearchCounts* counts) {
  requireErrorBounds(request);
  requireFinished(a);
  requireFinished(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  engine::PairQuery query;
  query.rel_err = request.rel_err;
  query.abs_err = request.abs_err;
  query.any_touching = !request.enable_nearest_points;
  const bool bounded = result.min_distance < std::numeric_limits<S>::max();
  if (bounded) {  // as if a pair so far were found
    query.far_enough = query.cullDistance(result.min_distance);
    const CentralWay way(a.getBV(0).bv, X_WA, b.getBV(0).bv, X_WB);
    if (farApart<S>(way, squared_errors, query.far_enough) ||
        smallerOffBox(a, X_WA, b, X_WB, way, squared_errors, query.far_enough)) {
      return result.min_distance;
    }
  }
  const MeshPair<S> frame(a, X_WA, b, X_WB, squared_errors);
  if (request.isSatisfied(result)) return result.min_distance;
  const bool fewest = query.isExact() && areFewest(a, b);
  const bool far = bounded && !fewest &&
                   (frame.rootBound(query.far_enough) >= query.far_enough ||
                    (!arePrepared(frame) && verticesApart(frame, query.far_enough)));
  if (far) return result.min_distance;
  SearchCounts unused;
  const engine::PairAnswer<S> answer = nearestOf(frame, query, counts ? *counts : unused);
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

KIOS_INSTANTIATE_FUNCTION(collideMeshes);
KIOS_INSTANTIATE_FUNCTION(distanceMeshes);

}  // namespace kios
