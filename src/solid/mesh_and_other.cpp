// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/mesh_and_other.h"

#include <optional>

#include "fcl_kios/solid/penetration.h"
#include "solid/containment.h"
#include "solid/shape_exit.h"
#include "volume/rounding.h"

namespace kios {
namespace {

constexpr int kNone = -1;

/// Returns a point of a surface that lies in the other solid, in the world. The surfaces must not
/// meet.
template <typename S>
std::optional<fcl::Vector3<S>> containedIn(const MeshAndOther<S>& o) {
  if (!o.other_mesh) return shapePointIn(o);
  const MeshPair frame(meshOf(o.mesh), o.X_WM, meshOf(*o.other_mesh), o.X_WO);
  SearchCounts unused;
  if (frame.rootBound(0) > 0) return std::nullopt;
  const auto point = containedPoint(o.mesh, *o.other_mesh, frame, unused);
  if (!point) return std::nullopt;
  return toWorld<S>(o.X_WM, *point);
}

template <typename S>
Penetration wayOut(const MeshAndOther<S>& o) {
  return o.other_mesh ? penetration(o.mesh, o.X_WM, *o.other_mesh, o.X_WO) : shapeExit(o);
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
    const Penetration way = wayOut(*this);
    if (way.upper > 0) {
      contact.normal = roundedTo<S>(way.translation / way.upper);
      contact.penetration_depth = roundedTo<S>(way.upper);
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
    const Penetration way = wayOut(*this);
    if (roundedTo<S>(way.upper) > 0) {
      const fcl::Vector3<S> end = roundedTo<S>(way.point);
      result.update(-roundedTo<S>(way.upper), &mesh, &other, meet ? found.b1 : kNone,
                    meet ? found.b2 : kNone, end, end - roundedTo<S>(way.translation));
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
