// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/contact.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/prepared.h"
#include "query/mesh_contacts.h"
#include "query/shape_search.h"
#include "shape/shape_solid.h"
#include "volume/instantiate.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// The box of a bounded shape along the world's axes. Half-spaces and planes, as in FCL, fill the
/// world but for axes that their normal is parallel to.
template <typename S>
fcl::AABB<S> worldBox(const shape::Solid& solid, const fcl::Transform3<S>& tf) {
  const Eigen::Matrix3d R = tf.linear().template cast<double>();
  fcl::AABB<S> box;
  for (int c = 0; c < 3; ++c) {
    const shape::Vec n = R.row(c).transpose();
    const double high = shape::extentAlong(solid, n), low = -shape::extentAlong(solid, -n);
    const double most = std::numeric_limits<S>::max(), at = tf.translation()[c];
    box.min_[c] = roundedTo<S>(std::max(-most, low + at));
    box.max_[c] = roundedTo<S>(std::min(most, high + at));
  }
  return box;
}

}  // namespace

template <typename S>
std::size_t collideShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result,
                         SearchCounts* counts) {
  SearchCounts unused;
  SearchCounts& counted = counts ? *counts : unused;
  const Mesh mesh = meshOf(model);
  if (wantsNothing(request.num_max_contacts)) return 0;
  const double squared_errors = squaredRotationErrors(X_WS, X_WM);
  shape::Solid solid = toSolid(shape);
  const bool done = request.isSatisfied(result);  // never if costs are wanted
  const bool approximate = request.enable_cost && request.use_approximate_cost;
  const auto finish = [&] {
    if (approximate) addApproximateCosts(model, X_WM, shape, X_WS, request, result);
    return result.numContacts();
  };
  if (!done) {
    ++counted.volume_tests;
    if (provenApart(mesh, X_WM, solid, X_WS, squared_errors, 0)) return finish();
  }
  const bool occupied = model.isOccupied() && shape.isOccupied();
  const bool costs = request.enable_cost && !approximate && !model.isFree() && !shape.isFree();
  const auto shape_box = costs ? worldBox(solid, X_WS) : fcl::AABB<S>();
  const PosedSolid posed(std::move(solid), X_WM, X_WS, mesh, squared_errors);
  if (done || !(occupied || costs)) return finish();
  const auto room = [&] {
    return request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  };
  TouchingTriangles touching(mesh, posed, costs ? std::numeric_limits<std::size_t>::max() : room(),
                             counted);
  for (const int id : touching.run()) {
    if (occupied && room() > 0) {
      fcl::Contact<S> contact(&model, &shape, id, fcl::Contact<S>::NONE, fcl::Vector3<S>::Zero(),
                              fcl::Vector3<S>::Zero(), S(0));
      if (request.enable_contact) {
        const shape::TriangleShapeContact c = touching.contactOf(id);
        contact.pos = roundedTo<S>(posed.toWorld(c.position));
        contact.normal = roundedTo<S>(posed.directionToWorld(-c.normal));  // to the shape
        contact.penetration_depth = roundedLength<S>(posed.fromUnits(c.depth));
      }
      result.addContact(contact);
    }
    if (!costs) continue;
    fcl::AABB<S> shared;
    boxInWorld(model, id, X_WM).overlap(shape_box, shared);
    result.addCostSource(fcl::CostSource<S>(shared, model.cost_density * shape.cost_density),
                         request.num_max_cost_sources);
  }
  return finish();
}

template <typename S>
S distanceShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3<S>& X_WS,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                SearchCounts* counts) {
  requireErrorBounds(request);
  const Mesh mesh = meshOf(model);
  const double squared_errors = squaredRotationErrors(X_WS, X_WM);
  shape::Solid solid = toSolid(geometry);
  const bool done = request.isSatisfied(result);
  const bool limited = result.min_distance < std::numeric_limits<S>::max();
  if (limited && !done &&
      provenApart(mesh, X_WM, solid, X_WS, squared_errors, result.min_distance)) {
    if (counts) ++counts->volume_tests;
    return result.min_distance;
  }
  const PosedSolid posed(std::move(solid), X_WM, X_WS, mesh, squared_errors);
  if (done) return result.min_distance;
  SearchCounts unused;
  NearestTriangle search(mesh, posed, request.rel_err, posed.toUnits(request.abs_err),
                         limited ? posed.toUnits(result.min_distance) : kInfinity,
                         counts ? *counts : unused);
  search.run();
  if (search.id() < 0) return result.min_distance;
  constexpr int kNone = fcl::DistanceResult<S>::NONE;
  const shape::TriangleShapeDistance& nearest = search.nearest();
  const S distance = roundedLength<S>(posed.fromUnits(nearest.distance));
  if (request.enable_nearest_points) {
    result.update(distance, &model, &geometry, search.id(), kNone,
                  roundedTo<S>(posed.toWorld(nearest.on_triangle)),
                  roundedTo<S>(posed.toWorld(nearest.on_shape)));
  } else {
    result.update(distance, &model, &geometry, search.id(), kNone);
  }
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(collideShape);
KIOS_INSTANTIATE_FUNCTION(distanceShape);

}  // namespace kios
