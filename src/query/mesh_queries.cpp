// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_queries.h"

#include <iostream>
#include <limits>

#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include "fcl_kios/query/mesh_nodes.h"
#include "query/engine_pair.h"
#include "query/mesh_pair.h"

namespace kios {
template <typename S>
std::size_t collideMeshes(const Model<S>& model1, const fcl::Transform3<S>& tf1,
                          const Model<S>& model2, const fcl::Transform3<S>& tf2,
                          const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                          SearchCounts* counts) {
  requireFinished(model1);
  requireFinished(model2);
  const RelativePose<S> X_12(tf1, tf2);
  if (request.num_max_contacts == 0) {  // FCL's warning and answer
    std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
    return 0;
  }
  if (request.isSatisfied(result)) return result.numContacts();
  if (separation(model1.getBV(0).bv, model2.getBV(0).bv, X_12, 0.0) > 0) {
    return result.numContacts();
  }
  SearchCounts unused;
  SearchCounts& count = counts ? *counts : unused;
  const bool occupied = model1.isOccupied() && model2.isOccupied();
  if (occupied && !request.enable_cost) {
    if (const EnginePair<S> engine(model1, model2, X_12); engine) {
      const std::size_t room = request.num_max_contacts - result.numContacts();
      for (const auto& ids : engine::intersectingTriangles(engine.pair(), room, count)) {
        addContacts(model1, ids.a, cornersOf(model1, ids.a), model2, ids.b,
                    transformed(cornersOf(model2, ids.b), X_12), tf1, request, result);
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
  requireFinished(model1);
  requireFinished(model2);
  const RelativePose<S> X_12(tf1, tf2);
  if (request.isSatisfied(result)) return result.min_distance;
  const engine::DistanceBounds<S> bounds = {result.min_distance, request.rel_err, request.abs_err};
  if (bounds.at_most < std::numeric_limits<S>::max()) {  // a bound that the roots may exceed
    const double enough = pruneAt(bounds.at_most, bounds.rel_err, bounds.abs_err);
    if (separation(model1.getBV(0).bv, model2.getBV(0).bv, X_12, enough) >= enough) {
      return result.min_distance;
    }
  }
  SearchCounts unused;
  SearchCounts& count = counts ? *counts : unused;
  if (const EnginePair<S> engine(model1, model2, X_12); engine) {
    TriangleDistance<S> nearest;
    const auto ids = engine::nearestTriangles(engine.pair(), bounds, nearest, count);
    if (ids.a < 0) return result.min_distance;
    if (request.enable_nearest_points) {
      result.update(nearest.distance, &model1, &model2, ids.a, ids.b,
                    transform<S>(tf1, nearest.point_a), transform<S>(tf1, nearest.point_b));
    } else {
      result.update(nearest.distance, &model1, &model2, ids.a, ids.b);
    }
    return result.min_distance;
  }
  ++count.tree_searches;
  MeshDistanceTraversalNode<S> node;
  initialize(node, model1, tf1, model2, tf2, request, result);
  fcl::detail::distance(&node);
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
