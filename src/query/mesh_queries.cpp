// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/contact.h"

#include <algorithm>
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

/// True only if the balls of finished models' roots are proven farther apart than `margin`.
template <typename S>
bool ballsApart(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                const fcl::Transform3<S>& X_WB, double squared_errors, double margin) {
  const kIOS<S>&root_a = a.getBV(0).bv, &root_b = b.getBV(0).bv;
  return engine::ballsApart(root_a.center0, X_WA, root_b.center0, X_WB,
                            double{root_a.radius0} + double{root_b.radius0}, squared_errors,
                            margin);
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
  if (request.num_max_contacts != 0 && ballsApart(a, X_WA, b, X_WB, squared_errors, 0)) {
    return result.numContacts();
  }
  const MeshPair frame(meshOf(a), X_WA, meshOf(b), X_WB, squared_errors);  // may throw
  if (wantsNothing(request.num_max_contacts)) return 0;
  const Reports<S> reports(a, b, request);
  const std::size_t room =
      request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  const std::size_t limit = reports.costs ? std::numeric_limits<std::size_t>::max() : room;
  if (request.isSatisfied(result) || limit == 0 || !(reports.contacts || reports.costs)) {
    return result.numContacts();
  }
  SearchCounts unused;
  for (const auto& ids : searchContacts(frame, limit, counts ? *counts : unused)) {
    addReports(reports, a, ids.a, frame.triangleA(ids.a), X_WA, b, ids.b, frame.triangleB(ids.b),
               X_WB, request, result);
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
    if (ballsApart(a, X_WA, b, X_WB, squared_errors, query.far_enough)) return result.min_distance;
  }
  const MeshPair frame(meshOf(a), X_WA, meshOf(b), X_WB, squared_errors);
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
