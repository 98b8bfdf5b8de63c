// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/shape_solid.h"

#include <cmath>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using shape::Kind;
using shape::Solid;

template <typename S>
double size(const char* shape, const char* name, S value) {
  if (value >= 0 && double{value} <= kMaxCoordinate<S>) return value;
  refuse("the fcl::", shape, " has ", name, " ", value, ", which must be finite and not negative.");
}

/// Half-space or plane {n x <= or = d}, whatever the length of n.
template <typename S, typename Shape>
void setPlane(const char* name, const Shape& plane, Solid& solid) {
  const Point<double> n = plane.n.template cast<double>();
  const double length = n.stableNorm();
  if (!(length > 0 && length <= kMaxCoordinate<S>)) {
    refuse("the fcl::", name, " has a normal of no direction.");
  }
  solid.normal = n / length;
  solid.offset = plane.d / length;
  if (!(std::abs(solid.offset) <= kMaxCoordinate<S>)) {
    refuse("the fcl::", name, " has an offset that is not finite.");
  }
}

template <typename Shape>
void setRound(const char* name, const Shape& shape, Solid& solid) {
  solid.radius = size(name, "radius", shape.radius);
  solid.half_length = size(name, "length", shape.lz) / 2;
}

template <typename S>
void setConvex(const fcl::Convex<S>& convex, Solid& solid) {
  if (convex.getVertices().empty()) refuse("the fcl::Convex has no vertices.");
  solid.points.reserve(convex.getVertices().size());
  for (const fcl::Vector3<S>& p : convex.getVertices()) {
    if (!(double{p.template lpNorm<Eigen::Infinity>()} <= kMaxCoordinate<S>) || p.hasNaN()) {
      refuse("the fcl::Convex has a vertex that is not finite.");
    }
    solid.points.push_back(p.template cast<double>());
  }
  solid.faces = convex.getFaces().data();
  solid.num_faces = convex.getFaceCount();
}

}  // namespace

template <typename S>
bool isShape(const fcl::CollisionGeometry<S>& geometry) {
  if (geometry.getObjectType() != fcl::OT_GEOM) return false;
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX:
    case fcl::GEOM_SPHERE:
    case fcl::GEOM_ELLIPSOID:
    case fcl::GEOM_CAPSULE:
    case fcl::GEOM_CONE:
    case fcl::GEOM_CYLINDER:
    case fcl::GEOM_CONVEX:
    case fcl::GEOM_HALFSPACE:
    case fcl::GEOM_PLANE:
      return true;
    default:
      return false;
  }
}

template <typename S>
Solid toSolid(const fcl::CollisionGeometry<S>& geometry) {
  Solid solid;
  switch (geometry.getNodeType()) {
    case fcl::GEOM_BOX: {
      solid.kind = Kind::kBox;
      const auto& side = static_cast<const fcl::Box<S>&>(geometry).side;
      for (int c = 0; c < 3; ++c) solid.half[c] = size("Box", "side", side[c]) / 2;
      break;
    }
    case fcl::GEOM_SPHERE:
      solid.kind = Kind::kSphere;
      solid.radius = size("Sphere", "radius", static_cast<const fcl::Sphere<S>&>(geometry).radius);
      break;
    case fcl::GEOM_ELLIPSOID: {
      solid.kind = Kind::kEllipsoid;
      const auto& radii = static_cast<const fcl::Ellipsoid<S>&>(geometry).radii;
      for (int c = 0; c < 3; ++c) solid.half[c] = size("Ellipsoid", "radius", radii[c]);
      break;
    }
    case fcl::GEOM_CAPSULE:
      solid.kind = Kind::kCapsule;
      setRound("Capsule", static_cast<const fcl::Capsule<S>&>(geometry), solid);
      break;
    case fcl::GEOM_CONE:
      solid.kind = Kind::kCone;
      setRound("Cone", static_cast<const fcl::Cone<S>&>(geometry), solid);
      break;
    case fcl::GEOM_CYLINDER:
      solid.kind = Kind::kCylinder;
      setRound("Cylinder", static_cast<const fcl::Cylinder<S>&>(geometry), solid);
      break;
    case fcl::GEOM_CONVEX:
      solid.kind = Kind::kConvex;
      setConvex(static_cast<const fcl::Convex<S>&>(geometry), solid);
      break;
    case fcl::GEOM_HALFSPACE:
      solid.kind = Kind::kHalfspace;
      setPlane<S>("Halfspace", static_cast<const fcl::Halfspace<S>&>(geometry), solid);
      break;
    case fcl::GEOM_PLANE:
      solid.kind = Kind::kPlane;
      setPlane<S>("Plane", static_cast<const fcl::Plane<S>&>(geometry), solid);
      break;
    default:
      refuse("the geometry is none of FCL's nine shapes.");
  }
  return solid;
}

KIOS_INSTANTIATE_FUNCTION(isShape);
KIOS_INSTANTIATE_FUNCTION(toSolid);

}  // namespace kios
