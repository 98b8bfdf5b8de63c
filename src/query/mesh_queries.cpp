// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_queries.h"

#include <iostream>
#include <limits>
#include <vector>

#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include "fcl_kios/query/mesh_nodes.h"
#include "query/mesh_pair.h"
#include "query/pair_search.h"

namespace kios {
template <typename S>
std::size_t collideMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1,
                          const Model<S>& model2, const fcl::Transform3<S>& tf2,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts) {
  const PairFrame<S> frame(model1, tf1, model2, tf2);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  if (request.isSatisfied(result) || frame.rootBound(0) > 0) return result.numContacts();
  SearchCounts unused;
  SearchCounts& count = counts ? *counts : unused;
  const bool occupied = model1.isOccupied() && model2.isOccupied();
  if (occupied && !request.enable_cost) {
    const std::size_t room = request.num_max_contacts - result.numContacts();
    std::vector<engine::TrianglePairIds> found;
    if (searchContacts(frame, room, found, count)) {
      for (const auto& ids : found) {
        addContacts(model1, ids.a, frame.triangleA(ids.a), model2, ids.b, frame.triangleB(ids.b),
                    tf1, request, result);
      }
      return result.numContacts();
    }
  }
  ++count.tree_searches;
  MeshCollisionTraversalNode<S> node;
  initialize(node, model1, tf1, model2, tf2, request, result);
  fcl::detail::collide(&node);
  return result.numContacts();
}

template <typename S>
S distanceMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1, const Model<S>& model2,
                 const fcl::Transform3<S>& tf2, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result, SearchCounts* counts) {
  requireErrorBounds(request);
  const PairFrame<S> frame(model1, tf1, model2, tf2);
  if (request.isSatisfied(result)) return result.min_distance;
  engine::PairQuery query;
  query.rel_err = request.rel_err;
  query.abs_err = request.abs_err;
  if (result.min_distance < std::numeric_limits<S>::max()) {  // as if a pair so far were found
    query.far_enough = query.pruneAt(result.min_distance);
    if (frame.rootBound(query.far_enough) >= query.far_enough) return result.min_distance;
  }
  SearchCounts unused;
  const engine::PairAnswer<S> answer = searchNearest(frame, query, counts ? *counts : unused);
  const TriangleDistance<S>& nearest = answer.nearest;
  if (!answer.found() || !(nearest.distance < result.min_distance)) return result.min_distance;
  if (request.enable_nearest_points) {
    result.update(nearest.distance, &model1, &model2, answer.ids.a, answer.ids.b,
                  detail::transform<S>(tf1, nearest.point_a),
                  detail::transform<S>(tf1, nearest.point_b));
  } else {
    result.update(nearest.distance, &model1, &model2, answer.ids.a, answer.ids.b);
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
