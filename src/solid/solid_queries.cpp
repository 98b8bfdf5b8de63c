// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_queries.h"

#include <optional>

#include "fcl_kios/query/mesh_queries.h"
#include "fcl_kios/query/shape_queries.h"
#include "fcl_kios/solid/penetration.h"
#include "solid/containment.h"
#include "solid/shape_exit.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

constexpr int kNone = -1;

/// Holds a way out of an overlap: of object 2 in the world.
template <typename S>
struct WayOut {
  fcl::Vector3<S> point, translation;
  S length;

  explicit WayOut(const Penetration& p)
      : point(p.point.template cast<S>()),
        translation(p.translation.template cast<S>()),
        length(static_cast<S>(p.upper)) {}
};

/// The rest of a collision once the surfaces were asked: `contained` finds a point of a surface in
/// the other solid, in the world, and `wayOut` how to leave.
template <typename S, typename Contained, typename GetWayOut>
std::size_t addContained(const fcl::CollisionGeometry<S>& o1, const fcl::CollisionGeometry<S>& o2,
                         std::size_t before, const fcl::CollisionRequest<S>& request,
                         fcl::CollisionResult<S>& result, const Contained& contained,
                         const GetWayOut& wayOut) {
  if (result.numContacts() > before || before >= request.num_max_contacts) {
    return result.numContacts();
  }
  if (!o1.isOccupied() || !o2.isOccupied()) return result.numContacts();
  const std::optional<fcl::Vector3<S>> point = contained();
  if (!point) return result.numContacts();
  fcl::Contact<S> contact(&o1, &o2, kNone, kNone, *point, fcl::Vector3<S>::Zero(), S(0));
  if (request.enable_contact) {
    const WayOut<S> way(wayOut());
    if (way.length > 0) {
      contact.normal = way.translation / way.length;
      contact.penetration_depth = way.length;
    }
  }
  result.addContact(contact);
  return result.numContacts();
}

/// The rest of a distance: `surfaces` asks for that of the surfaces.
template <typename S, typename Surfaces, typename Contained, typename GetWayOut>
S signedDistance(const fcl::CollisionGeometry<S>& o1, const fcl::CollisionGeometry<S>& o2,
                 const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                 const Surfaces& surfaces, const Contained& contained, const GetWayOut& wayOut) {
  if (request.isSatisfied(result)) {
    surfaces(result);  // which checks the arguments, and does nothing else
    return result.min_distance;
  }
  fcl::DistanceResult<S> found(result.min_distance);
  surfaces(found);
  const bool meet = found.min_distance <= 0;
  const std::optional<fcl::Vector3<S>> point = meet ? std::nullopt : contained();
  if (!meet && !point) {
    result.update(found);
    return result.min_distance;
  }
  if (request.enable_signed_distance) {
    const WayOut<S> way(wayOut());
    if (way.length > 0) {
      result.update(-way.length, &o1, &o2, meet ? found.b1 : kNone, meet ? found.b2 : kNone,
                    way.point, way.point - way.translation);
      return result.min_distance;
    }
  }
  if (meet) {
    result.update(found);
  } else if (request.enable_nearest_points) {
    result.update(S(0), &o1, &o2, kNone, kNone, *point, *point);
  } else {
    result.update(S(0), &o1, &o2, kNone, kNone);
  }
  return result.min_distance;
}

template <typename S>
std::optional<fcl::Vector3<S>> containedInWorld(const Model<S>& a, const fcl::Transform3<S>& X_WA,
                                                const Model<S>& b, const fcl::Transform3<S>& X_WB) {
  const MeshPair<S> frame(a, X_WA, b, X_WB);
  SearchCounts unused;
  if (frame.rootBound(0) > 0) return std::nullopt;
  const auto point = containedPoint(frame, unused);
  if (!point) return std::nullopt;
  return detail::transform<S>(X_WA, point->template cast<S>());
}

}  // namespace

template <typename S>
std::size_t collideSolids(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                          const fcl::Transform3<S>& X_WB, const fcl::CollisionRequest<S>& request,
                          fcl::CollisionResult<S>& result) {
  const std::size_t before = result.numContacts();
  collideMeshes(a, X_WA, b, X_WB, request, result);
  return addContained<S>(
      a, b, before, request, result, [&] { return containedInWorld(a, X_WA, b, X_WB); },
      [&] { return penetration(a, X_WA, b, X_WB); });
}

template <typename S>
S distanceSolids(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                 const fcl::Transform3<S>& X_WB, const fcl::DistanceRequest<S>& request,
                 fcl::DistanceResult<S>& result) {
  return signedDistance<S>(
      a, b, request, result,
      [&](fcl::DistanceResult<S>& r) { distanceMeshes(a, X_WA, b, X_WB, request, r); },
      [&] { return containedInWorld(a, X_WA, b, X_WB); },
      [&] { return penetration(a, X_WA, b, X_WB); });
}

template <typename S>
std::size_t collideSolidShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                              const fcl::CollisionGeometry<S>& shape,
                              const fcl::Transform3<S>& X_WS,
                              const fcl::CollisionRequest<S>& request,
                              fcl::CollisionResult<S>& result) {
  const std::size_t before = result.numContacts();
  collideShape(model, X_WM, shape, X_WS, request, result);
  return addContained<S>(
      model, shape, before, request, result, [&] { return shapePointIn(model, X_WM, shape, X_WS); },
      [&] { return shapeExit(model, X_WM, shape, X_WS); });
}

template <typename S>
S distanceSolidShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                     const fcl::CollisionGeometry<S>& shape, const fcl::Transform3<S>& X_WS,
                     const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  return signedDistance<S>(
      model, shape, request, result,
      [&](fcl::DistanceResult<S>& r) { distanceShape(model, X_WM, shape, X_WS, request, r); },
      [&] { return shapePointIn(model, X_WM, shape, X_WS); },
      [&] { return shapeExit(model, X_WM, shape, X_WS); });
}

KIOS_INSTANTIATE_FUNCTION(collideSolids);
KIOS_INSTANTIATE_FUNCTION(distanceSolids);
KIOS_INSTANTIATE_FUNCTION(collideSolidShape);
KIOS_INSTANTIATE_FUNCTION(distanceSolidShape);

}  // namespace kios
