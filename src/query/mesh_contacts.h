// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iostream>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include "fcl_kios/model.h"
#include "model/prepared.h"
#include "search/mesh_pair.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {

/// Throws std::invalid_argument if an error bound is negative or NaN.
template <typename S>
void requireErrorBounds(const fcl::DistanceRequest<S>& request) {
  require(request.rel_err >= 0, "DistanceRequest::rel_err", request.rel_err, ">= 0");
  require(request.abs_err >= 0, "DistanceRequest::abs_err", request.abs_err, ">= 0");
}

/// FCL's warning and answer: true if a request wants no contact at all.
inline bool wantsNothing(std::size_t num_max_contacts) {
  if (num_max_contacts == 0) std::cerr << "Warning: should stop early as num_max_contact is 0 !\n";
  return num_max_contacts == 0;
}

/// Adds FCL's approximate cost sources of a model and a shape or an octree: those that FCL finds
/// for the box of the root volume in the model's place.
template <typename S>
void addApproximateCosts(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result);

/// The contact that FCL reports for two triangles that intersect, in their common frame.
struct TriangleContact {
  Pointd points[2];
  std::size_t num_points;  ///< 1 or 2
  Pointd normal;           ///< unit, from the first triangle to the second as FCL orients it
  double depth;
};

/// The deepest vertices of one triangle below the other's plane, that plane's normal and their
/// depth, as FCL's routine gives them; where it gives none, or a triangle has no normal, a point of
/// the intersection, the other triangle's normal (x if neither has one) and depth 0. The triangles
/// must intersect.
TriangleContact triangleContact(const TriangleVerticesd& a, const TriangleVerticesd& b);

/// Reports two triangles that intersect, p and q in A's frame, as FCL does: up to two
/// contacts, as many as the request leaves room for.
template <typename S>
[[gnu::hot]] void addContacts(const Model<S>& a, int id_a, const TriangleVerticesd& p,
                              const Model<S>& b, int id_b, const TriangleVerticesd& q,
                              const fcl::Transform3<S>& X_WA,
                              const fcl::CollisionRequest<S>& request,
                              fcl::CollisionResult<S>& result) {
  const std::size_t room =
      request.num_max_contacts - std::min(request.num_max_contacts, result.numContacts());
  if (!request.enable_contact) {
    const fcl::Vector3<S> unset = fcl::Vector3<S>::Zero();  // FCL leaves it uninitialised
    if (room > 0) {
      result.addContact(fcl::Contact<S>(&a, &b, id_a, id_b, unset, unset, S(0)));
    }
    return;
  }
  const TriangleContact contact = triangleContact(p, q);
  const fcl::Vector3<S> normal =
      roundedTo<S>(detail::rotate<double>(X_WA.linear().template cast<double>(), contact.normal));
  for (std::size_t i = 0; i < std::min(room, contact.num_points); ++i) {
    result.addContact(fcl::Contact<S>(&a, &b, id_a, id_b, toWorld<S>(X_WA, contact.points[i]),
                                      normal, roundedTo<S>(contact.depth)));
  }
}

/// Tells what two meshes report for triangles that intersect: contacts if both are occupied, cost
/// sources if the request asks for them and neither is free.
template <typename S>
struct Reports {
  Reports(const Model<S>& a, const Model<S>& b, const fcl::CollisionRequest<S>& request)
      : contacts(a.isOccupied() && b.isOccupied()),
        costs(request.enable_cost && !a.isFree() && !b.isFree()) {}
  bool contacts, costs;
};

/// The box of a triangle in the world, placed in double and rounded once.
template <typename S>
fcl::AABB<S> boxInWorld(const Model<S>& model, int id, const fcl::Transform3<S>& X) {
  const TriangleVerticesd t =
      transformed(cornersInDouble(model, id), fcl::Transform3d(X.template cast<double>()));
  return {roundedTo<S>(t[0]), roundedTo<S>(t[1]), roundedTo<S>(t[2])};
}

/// Reports two triangles that intersect as addContacts() does, and as a cost source: the part that
/// their boxes in the world have in common.
template <typename S>
void addReports(const Reports<S>& reports, const Model<S>& a, int id_a, const TriangleVerticesd& p,
                const fcl::Transform3<S>& X_WA, const Model<S>& b, int id_b,
                const TriangleVerticesd& q, const fcl::Transform3<S>& X_WB,
                const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  if (reports.contacts) addContacts(a, id_a, p, b, id_b, q, X_WA, request, result);
  if (!reports.costs) return;
  fcl::AABB<S> shared;
  boxInWorld(a, id_a, X_WA).overlap(boxInWorld(b, id_b, X_WB), shared);
  result.addCostSource(fcl::CostSource<S>(shared, a.cost_density * b.cost_density),
                       request.num_max_cost_sources);
}

}  // namespace kios
