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

/// Holds a marked mesh and another one, or a shape.
template <typename S>
struct SolidAndOther {
  const Model<S>& a;
  const fcl::Transform3<S>& X_WA;
  const fcl::CollisionGeometry<S>& b;
  const fcl::Transform3<S>& X_WB;
  const Model<S>* mesh_b = asModel(&b);

  void collideSurfaces(const fcl::CollisionRequest<S>& request,
                       fcl::CollisionResult<S>& result) const {
    if (mesh_b) {
      collideMeshes(a, X_WA, *mesh_b, X_WB, request, result);
    } else {
      collideShape(a, X_WA, b, X_WB, request, result);
    }
  }
  void distanceOfSurfaces(const fcl::DistanceRequest<S>& request,
                          fcl::DistanceResult<S>& result) const {
    if (mesh_b) {
      distanceMeshes(a, X_WA, *mesh_b, X_WB, request, result);
    } else {
      distanceShape(a, X_WA, b, X_WB, request, result);
    }
  }
  /// Returns a point of a surface that lies in the other solid, in the world. The surfaces must not
  /// meet.
  std::optional<fcl::Vector3<S>> contained() const {
    if (!mesh_b) return shapePointIn(a, X_WA, b, X_WB);
    const MeshPair<S> frame(a, X_WA, *mesh_b, X_WB);
    SearchCounts unused;
    if (frame.rootBound(0) > 0) return std::nullopt;
    const auto point = containedPoint(frame, unused);
    if (!point) return std::nullopt;
    return detail::transform<S>(X_WA, point->template cast<S>());
  }
  WayOut<S> wayOut() const {
    return WayOut<S>(mesh_b ? penetration(a, X_WA, *mesh_b, X_WB) : shapeExit(a, X_WA, b, X_WB));
  }
};

}  // namespace

template <typename S>
std::size_t collideSolid(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                         const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                         const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  const SolidAndOther<S> objects = {model, X_WM, other, X_WO};
  const std::size_t before = result.numContacts();
  objects.collideSurfaces(request, result);
  if (result.numContacts() > before || before >= request.num_max_contacts) {
    return result.numContacts();
  }
  if (!model.isOccupied() || !other.isOccupied()) return result.numContacts();
  const std::optional<fcl::Vector3<S>> point = objects.contained();
  if (!point) return result.numContacts();
  fcl::Contact<S> contact(&model, &other, kNone, kNone, *point, fcl::Vector3<S>::Zero(), S(0));
  if (request.enable_contact) {
    const WayOut<S> way = objects.wayOut();
    if (way.length > 0) {
      contact.normal = way.translation / way.length;
      contact.penetration_depth = way.length;
    }
  }
  result.addContact(contact);
  return result.numContacts();
}

template <typename S>
S distanceSolid(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& other, const fcl::Transform3<S>& X_WO,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  const SolidAndOther<S> objects = {model, X_WM, other, X_WO};
  if (request.isSatisfied(result)) {
    objects.distanceOfSurfaces(request, result);  // checks the arguments, and does nothing else
    return result.min_distance;
  }
  fcl::DistanceResult<S> found(result.min_distance);
  objects.distanceOfSurfaces(request, found);
  const bool meet = found.min_distance <= 0;
  const std::optional<fcl::Vector3<S>> point = meet ? std::nullopt : objects.contained();
  if (!meet && !point) {
    result.update(found);
    return result.min_distance;
  }
  if (request.enable_signed_distance) {
    const WayOut<S> way = objects.wayOut();
    if (way.length > 0) {
      result.update(-way.length, &model, &other, meet ? found.b1 : kNone, meet ? found.b2 : kNone,
                    way.point, way.point - way.translation);
      return result.min_distance;
    }
  }
  if (meet) {
    result.update(found);
  } else if (request.enable_nearest_points) {
    result.update(S(0), &model, &other, kNone, kNone, *point, *point);
  } else {
    result.update(S(0), &model, &other, kNone, kNone);
  }
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(collideSolid);
KIOS_INSTANTIATE_FUNCTION(distanceSolid);

}  // namespace kios
