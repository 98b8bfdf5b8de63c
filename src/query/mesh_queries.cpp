// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/query/mesh_queries.h"

#include <algorithm>
#include <iostream>
#include <limits>

#include "model/prepared.h"
#include "query/mesh_contacts.h"
#include "query/pair_search.h"
#include "search/root_body.h"
#include "volume/instantiate.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// True only if the balls of the roots are proven farther apart than `margin`.
template <typename S>
bool ballsApart(const Mesh& a, const fcl::Transform3<S>& X_WA, const Mesh& b,
                const fcl::Transform3<S>& X_WB, double squared_errors, double margin) {
  return engine::ballsApart(a.center(), X_WA, b.center(), X_WB, a.radius() + b.radius(),
                            squared_errors, margin);
}

/// collideMeshes() of models that may touch, for all that their roots tell at once.
template <typename S>
[[gnu::noinline, gnu::hot]] void collideNear(const MeshPair& frame, const Model<S>& a,
                                             const fcl::Transform3<S>& X_WA, const Model<S>& b,
                                             const fcl::Transform3<S>& X_WB,
                                             const fcl::CollisionRequest<S>& request,
                                             fcl::CollisionResult<S>& result,
                                             SearchCounts& counts) {
  const Reports<S> reports(a, b, request);
  if (!reports.contacts && !reports.costs) return;
  const std::size_t room =
      request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  const std::size_t limit = reports.costs ? std::numeric_limits<std::size_t>::max() : room;
  if (limit == 0) return;
  for (const auto& ids : searchContacts(frame, limit, counts)) {
    addReports(reports, a, ids.a, frame.triangleA(ids.a), X_WA, b, ids.b, frame.triangleB(ids.b),
               X_WB, request, result);
  }
}

}  // namespace

template <typename S>
[[gnu::hot]] std::size_t collideMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                       const Model<S>& b, const fcl::Transform3<S>& X_WB,
                                       const fcl::CollisionRequest<S>& request,
                                       fcl::CollisionResult<S>& result, SearchCounts* counts) {
  const Mesh mesh_a = meshOf(a), mesh_b = meshOf(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  const bool done = request.num_max_contacts == 0 || request.isSatisfied(result);
  if (done || !ballsApart(mesh_a, X_WA, mesh_b, X_WB, squared_errors, 0)) {
    const MeshPair frame(mesh_a, X_WA, mesh_b, X_WB,
                         squared_errors);  // throws where they can't tell
    if (request.num_max_contacts == 0) {   // FCL's warning and answer
      std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
      return 0;
    }
    SearchCounts unused;
    if (!done) collideNear(frame, a, X_WA, b, X_WB, request, result, counts ? *counts : unused);
  }
  return result.numContacts();
}

template <typename S>
[[gnu::hot]] S distanceMeshes(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                              const fcl::Transform3<S>& X_WB,
                              const fcl::DistanceRequest<S>& request,
                              fcl::DistanceResult<S>& result, SearchCounts* counts) {
  requireErrorBounds(request);
  const Mesh mesh_a = meshOf(a), mesh_b = meshOf(b);
  const double squared_errors = squaredRotationErrors(X_WA, X_WB);
  engine::PairQuery query;
  query.rel_err = request.rel_err;
  query.abs_err = request.abs_err;
  query.any_touching = !request.enable_nearest_points;
  const bool bounded = result.min_distance < std::numeric_limits<S>::max();
  if (bounded) {  // as if a pair so far were found
    query.far_enough = query.cullDistance(result.min_distance);
    if (ballsApart(mesh_a, X_WA, mesh_b, X_WB, squared_errors, query.far_enough))
      return result.min_distance;
  }
  const MeshPair frame(mesh_a, X_WA, mesh_b, X_WB, squared_errors);
  if (request.isSatisfied(result)) return result.min_distance;
  SearchCounts unused;
  const engine::PairAnswer answer = searchNearest(frame, query, counts ? *counts : unused);
  const S distance = roundedLength<S>(answer.nearest.distance);
  if (!answer.found() || !(distance < result.min_distance)) return result.min_distance;
  if (request.enable_nearest_points) {
    result.update(distance, &a, &b, answer.ids.a, answer.ids.b,
                  toWorld<S>(X_WA, answer.nearest.point_a),
                  toWorld<S>(X_WA, answer.nearest.point_b));
  } else {
    result.update(distance, &a, &b, answer.ids.a, answer.ids.b);
  }
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(collideMeshes);
KIOS_INSTANTIATE_FUNCTION(distanceMeshes);

}  // namespace kios
