// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/shape_solid.h"

#include <cmath>

#include "shape/visit_shape.h"
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

template <typename S>
Point<double> sizes(const char* shape, const char* name, const fcl::Vector3<S>& v) {
  return {size(shape, name, v[0]), size(shape, name, v[1]), size(shape, name, v[2])};
}

template <typename Round>
void setRound(const char* name, const Round& round, Solid& solid) {
  solid.radius = size(name, "radius", round.radius);
  solid.half_length = size(name, "length", round.lz) / 2;
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
  static_assert(fcl::GEOM_HALFSPACE == fcl::GEOM_BOX + 8 &&
                fcl::GEOM_TRIANGLE > fcl::GEOM_HALFSPACE);
  const fcl::NODE_TYPE type = geometry.getNodeType();
  return geometry.getObjectType() == fcl::OT_GEOM && type >= fcl::GEOM_BOX &&
         type <= fcl::GEOM_HALFSPACE;
}

template <typename S>
Solid toSolid(const fcl::CollisionGeometry<S>& geometry) {
  if (!isShape(geometry)) refuse("the geometry is none of FCL's nine shapes.");
  Solid solid;
  const auto set = [&](Kind kind) -> Solid& {
    solid.kind = kind;
    return solid;
  };
  visitShape(
      geometry,
      [&](const fcl::Box<S>& s) { set(Kind::kBox).half = sizes("Box", "side", s.side) / 2; },
      [&](const fcl::Sphere<S>& s) {
        set(Kind::kSphere).radius = size("Sphere", "radius", s.radius);
      },
      [&](const fcl::Ellipsoid<S>& s) {
        set(Kind::kEllipsoid).half = sizes("Ellipsoid", "radius", s.radii);
      },
      [&](const fcl::Capsule<S>& s) { setRound("Capsule", s, set(Kind::kCapsule)); },
      [&](const fcl::Cone<S>& s) { setRound("Cone", s, set(Kind::kCone)); },
      [&](const fcl::Cylinder<S>& s) { setRound("Cylinder", s, set(Kind::kCylinder)); },
      [&](const fcl::Convex<S>& s) { setConvex(s, set(Kind::kConvex)); },
      [&](const fcl::Halfspace<S>& s) { setPlane<S>("Halfspace", s, set(Kind::kHalfspace)); },
      [&](const fcl::Plane<S>& s) { setPlane<S>("Plane", s, set(Kind::kPlane)); },
      [](const fcl::TriangleP<S>&) {});  // was refused
  return solid;
}

KIOS_INSTANTIATE_FUNCTION(isShape);
KIOS_INSTANTIATE_FUNCTION(toSolid);

}  // namespace kios
