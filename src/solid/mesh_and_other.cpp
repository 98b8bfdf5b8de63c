// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/mesh_and_other.h"

#include <optional>

#include "fcl_kios/solid/penetration.h"
#include "solid/containment.h"
#include "solid/shape_exit.h"

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

/// Returns a point of a surface that lies in the other solid, in the world. The surfaces must not
/// meet.
template <typename S>
std::optional<fcl::Vector3<S>> containedIn(const MeshAndOther<S>& o) {
  if (!o.other_mesh) return shapePointIn(o);
  const MeshPair<S> frame(o.mesh, o.X_WM, *o.other_mesh, o.X_WO);
  SearchCounts unused;
  if (frame.rootBound(0) > 0) return std::nullopt;
  const auto point = containedPoint(frame, unused);
  if (!point) return std::nullopt;
  return detail::transform<S>(o.X_WM, point->template cast<S>());
}

template <typename S>
WayOut<S> wayOut(const MeshAndOther<S>& o) {
  return WayOut<S>(o.other_mesh ? penetration(o.mesh, o.X_WM, *o.other_mesh, o.X_WO)
                                : shapeExit(o));
}

}  // namespace

template <typename S>
std::size_t MeshAndOther<S>::collideSolids(const fcl::CollisionRequest<S>& request,
                                           fcl::CollisionResult<S>& result) const {
  const std::size_t before = result.numContacts();
  collideSurfaces(request, result);
  if (result.numContacts() > before || before >= request.num_max_contacts) {
    return result.numContacts();
  }
  if (!mesh.isOccupied() || !other.isOccupied()) return result.numContacts();
  const std::optional<fcl::Vector3<S>> point = containedIn(*this);
  if (!point) return result.numContacts();
  fcl::Contact<S> contact(&mesh, &other, kNone, kNone, *point, fcl::Vector3<S>::Zero(), S(0));
  if (request.enable_contact) {
    const WayOut<S> way = wayOut(*this);
    if (way.length > 0) {
      contact.normal = way.translation / way.length;
      contact.penetration_depth = way.length;
    }
  }
  result.addContact(contact);
  return result.numContacts();
}

template <typename S>
S MeshAndOther<S>::distanceSolids(const fcl::DistanceRequest<S>& request,
                                  fcl::DistanceResult<S>& result) const {
  if (request.isSatisfied(result)) {
    distanceSurfaces(request, result);  // checks the arguments, and does nothing else
    return result.min_distance;
  }
  fcl::DistanceResult<S> found(result.min_distance);
  distanceSurfaces(request, found);
  const bool meet = found.min_distance <= 0;
  const std::optional<fcl::Vector3<S>> point = meet ? std::nullopt : containedIn(*this);
  if (!meet && !point) {
    result.update(found);
    return result.min_distance;
  }
  if (request.enable_signed_distance) {
    const WayOut<S> way = wayOut(*this);
    if (way.length > 0) {
      result.update(-way.length, &mesh, &other, meet ? found.b1 : kNone, meet ? found.b2 : kNone,
                    way.point, way.point - way.translation);
      return result.min_distance;
    }
  }
  if (meet) {
    result.update(found);
  } else if (request.enable_nearest_points) {
    result.update(S(0), &mesh, &other, kNone, kNone, *point, *point);
  } else {
    result.update(S(0), &mesh, &other, kNone, kNone);
  }
  return result.min_distance;
}

template struct MeshAndOther<double>;
template struct MeshAndOther<float>;

}  // namespace kios
