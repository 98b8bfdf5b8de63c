// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/shape_values.h"

#include <cmath>
#include <cstddef>
#include <typeinfo>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Calls take(v) with every value, in one order.
template <typename S, typename Take>
void takeValues(const fcl::CollisionGeometry<S>& geometry, const Take& take) {
  const auto takeAll = [&](const fcl::Vector3<S>& v) {
    for (int i = 0; i < 3; ++i) take(v[i]);
  };
  const auto takePlane = [&](const auto& plane) {
    takeAll(plane.n);
    take(plane.d);
  };
  const auto takeRound = [&](const auto& round) {
    take(round.radius);
    take(round.lz);
  };
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      takeAll(static_cast<const fcl::Box<S>&>(geometry).side);
      break;
    case fcl::GEOM_SPHERE:
      take(static_cast<const fcl::Sphere<S>&>(geometry).radius);
      break;
    case fcl::GEOM_ELLIPSOID:
      takeAll(static_cast<const fcl::Ellipsoid<S>&>(geometry).radii);
      break;
    case fcl::GEOM_CAPSULE:
      takeRound(static_cast<const fcl::Capsule<S>&>(geometry));
      break;
    case fcl::GEOM_CONE:
      takeRound(static_cast<const fcl::Cone<S>&>(geometry));
      break;
    case fcl::GEOM_CYLINDER:
      takeRound(static_cast<const fcl::Cylinder<S>&>(geometry));
      break;
    case fcl::GEOM_CONVEX: {
      const auto& convex = static_cast<const fcl::Convex<S>&>(geometry);
      take(roundedTo<S>(convex.getFaceCount()));
      for (const fcl::Vector3<S>& v : convex.getVertices()) takeAll(v);
      for (const int i : convex.getFaces()) take(roundedTo<S>(i));
      takeAll(convex.getInteriorPoint());
      break;
    }
    case fcl::GEOM_PLANE:
      takePlane(static_cast<const fcl::Plane<S>&>(geometry));
      break;
    case fcl::GEOM_HALFSPACE:
      takePlane(static_cast<const fcl::Halfspace<S>&>(geometry));
      break;
    case fcl::GEOM_TRIANGLE:
      takeAll(static_cast<const fcl::TriangleP<S>&>(geometry).a);
      takeAll(static_cast<const fcl::TriangleP<S>&>(geometry).b);
      takeAll(static_cast<const fcl::TriangleP<S>&>(geometry).c);
      break;
    default:
      break;
  }
}

}  // namespace

template <typename S>
bool isShapeOfFcl(const fcl::CollisionGeometry<S>& geometry) {
  const std::type_info& type = typeid(geometry);
  return type == typeid(fcl::Box<S>) || type == typeid(fcl::Sphere<S>) ||
         type == typeid(fcl::Ellipsoid<S>) || type == typeid(fcl::Capsule<S>) ||
         type == typeid(fcl::Cone<S>) || type == typeid(fcl::Cylinder<S>) ||
         type == typeid(fcl::Convex<S>) || type == typeid(fcl::Plane<S>) ||
         type == typeid(fcl::Halfspace<S>) || type == typeid(fcl::TriangleP<S>);
}

template <typename S>
std::vector<S> shapeValues(const fcl::CollisionGeometry<S>& geometry) {
  std::vector<S> values;
  takeValues(geometry, [&values](S value) { values.push_back(value); });
  return values;
}

template <typename S>
bool hasShapeValues(const fcl::CollisionGeometry<S>& geometry, const std::vector<S>& values) {
  std::size_t next = 0;
  bool same = true;
  takeValues(geometry, [&](S value) {
    same = same && next < values.size() &&
           (values[next] == value || (std::isnan(values[next]) && std::isnan(value)));
    ++next;
  });
  return same && next == values.size();
}

KIOS_INSTANTIATE_FUNCTION(isShapeOfFcl);
KIOS_INSTANTIATE_FUNCTION(shapeValues);
KIOS_INSTANTIATE_FUNCTION(hasShapeValues);

}  // namespace kios
