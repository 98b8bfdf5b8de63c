// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

namespace kios {

template <typename... F>
struct Overloaded : F... {
  using F::operator()...;
};

/// Calls the one of `visits` that takes it with a geometry as the shape of FCL that its node type
/// names, a triangle included. False, without a call, for other geometries.
template <typename S, typename... Visits>
bool visitShape(const fcl::CollisionGeometry<S>& geometry, const Visits&... visits) {
  const Overloaded<Visits...> visit = {visits...};
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
      return visit(static_cast<const fcl::Box<S>&>(geometry)), true;
    case fcl::GEOM_SPHERE:
      return visit(static_cast<const fcl::Sphere<S>&>(geometry)), true;
    case fcl::GEOM_ELLIPSOID:
      return visit(static_cast<const fcl::Ellipsoid<S>&>(geometry)), true;
    case fcl::GEOM_CAPSULE:
      return visit(static_cast<const fcl::Capsule<S>&>(geometry)), true;
    case fcl::GEOM_CONE:
      return visit(static_cast<const fcl::Cone<S>&>(geometry)), true;
    case fcl::GEOM_CYLINDER:
      return visit(static_cast<const fcl::Cylinder<S>&>(geometry)), true;
    case fcl::GEOM_CONVEX:
      return visit(static_cast<const fcl::Convex<S>&>(geometry)), true;
    case fcl::GEOM_PLANE:
      return visit(static_cast<const fcl::Plane<S>&>(geometry)), true;
    case fcl::GEOM_HALFSPACE:
      return visit(static_cast<const fcl::Halfspace<S>&>(geometry)), true;
    case fcl::GEOM_TRIANGLE:
      return visit(static_cast<const fcl::TriangleP<S>&>(geometry)), true;
    default:
      return false;
  }
}

}  // namespace kios
