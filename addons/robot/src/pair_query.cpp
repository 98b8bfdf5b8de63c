// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pair_query.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include "convex.h"
#include "fcl_kios/fcl_kios.h"
#include "text_file.h"
#include "volume/rounding.h"

namespace kios::robot {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

void swap(Nearness& near) {
  std::swap(near.point_a, near.point_b);
  std::swap(near.id_a, near.id_b);
}

/// The error of the distance of a mesh from a shape or an octree (docs/shapes.md), L the extent.
double errorOf(const Body& other, double length) {
  if (other.kind == BodyKind::kPlane) return 0x1p-40 * length;
  const auto type = other.geometry->getNodeType();
  if (type == fcl::GEOM_CONVEX) return 0x1p-28 * length;
  double error = 0x1p-40 * length;
  if (type == fcl::GEOM_ELLIPSOID) {
    const double least = other.half.minCoeff();
    if (least < length) error *= length / std::max(least, 0x1p-500);
  }
  return error;
}

bool collide(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
             const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
  return fcl::collide(a.geometry.get(), X_WA, b.geometry.get(), X_WB, request, result) > 0;
}

/// Returns true if one of two shapes is so much larger that libccd's search for a contact has no
/// end.
bool areUnlike(const Body& a, const Body& b) {
  constexpr double kMuch = 0x1p26;
  return a.radius > kMuch * b.radius || b.radius > kMuch * a.radius;
}

Nearness ofShapes(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB) {
  const bool plane_a = a.kind == BodyKind::kPlane, plane_b = b.kind == BodyKind::kPlane;
  ConvexDistance answer;
  if (plane_a && plane_b) refuse("the clearance of two planes or half-spaces isn't served.");
  if (plane_a || plane_b) {
    const Body& plane = plane_a ? a : b;
    const Transform3d& X = plane_a ? X_WA : X_WB;
    Vector3d n;
    double offset = 0;
    const bool thin = plane.geometry->getNodeType() == fcl::GEOM_PLANE;
    if (thin) {
      const auto& p = static_cast<const fcl::Planed&>(*plane.geometry);
      n = p.n;
      offset = p.d;
    } else {
      const auto& p = static_cast<const fcl::Halfspaced&>(*plane.geometry);
      n = p.n;
      offset = p.d;
    }
    n = X.linear() * n;
    offset += n.dot(X.translation());
    const Convex convex(plane_a ? *b.geometry : *a.geometry, plane_a ? X_WB : X_WA);
    answer = planeDistance(n, offset, thin, convex);
    if (plane_b) std::swap(answer.point_a, answer.point_b);
  } else {
    answer = convexDistance(Convex(*a.geometry, X_WA), Convex(*b.geometry, X_WB));
  }
  Nearness near;
  near.distance = answer.distance;
  near.lower = std::min(answer.lower, answer.distance);
  near.point_a = answer.point_a;
  near.point_b = answer.point_b;
  return near;
}

/// Returns true if two meshes whose surfaces are apart are in contact, as marked solids are where
/// one lies in the other; kios::distanceBracket and closerThan know surfaces only. Sets a common
/// point.
bool isContained(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
                 Nearness& near) {
  if (!isSolid(*a.mesh) || !isSolid(*b.mesh)) return false;
  fcl::CollisionResultd result;
  if (!collide(a, X_WA, b, X_WB, fcl::CollisionRequestd(), result)) return false;
  near = {};
  near.point_a = near.point_b = result.getContact(0).pos;
  return true;
}

Nearness ofMeshes(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
                  double rel_err, double abs_err, double far_enough) {
  DistanceBracketRequestd options;
  options.rel_err = rel_err;
  options.abs_err = abs_err;
  options.far_enough = far_enough;
  const auto answer = distanceBracket(*a.mesh, X_WA, *b.mesh, X_WB, options);
  Nearness near;
  near.distance = answer.stop == DistanceStop::kFar ? kInfinity : answer.distance;
  near.lower = answer.lower_bound;
  near.point_a = answer.point_a;
  near.point_b = answer.point_b;
  near.id_a = answer.triangle_a;
  near.id_b = answer.triangle_b;
  if (near.distance > 0) isContained(a, X_WA, b, X_WB, near);
  return near;
}

Nearness ofMeshAndOther(const Body& mesh, const Transform3d& X_WM, const Body& other,
                        const Transform3d& X_WO, double rel_err, double abs_err,
                        double far_enough) {
  constexpr double kMost = 0.99;  // FCL's requests take less than 1
  rel_err = std::min(rel_err, kMost);
  fcl::DistanceRequestd request(true);
  request.rel_err = rel_err;
  request.abs_err = abs_err;
  fcl::DistanceResultd result;
  // A request with errors leaves out what is nearer than its bound by as much.
  if (far_enough < kInfinity) {
    result.min_distance = std::max({far_enough * (1 + rel_err), far_enough + abs_err, 0x1p-500});
  }
  const double asked = result.min_distance;
  const double found =
      fcl::distance(mesh.geometry.get(), X_WM, other.geometry.get(), X_WO, request, result);
  Nearness near;
  const double length = mesh.middle.norm() + mesh.radius + other.middle.norm() +
                        (other.radius < kInfinity ? other.radius : 0) +
                        (X_WM.translation() - X_WO.translation()).norm();
  if (!(found < asked)) {
    near.distance = kInfinity;
    const double proven = std::min(asked / (1 + rel_err), asked - abs_err) * (1 - 0x1p-50);
    near.lower = std::max(0.0, proven - errorOf(other, length));
    return near;
  }
  near.distance = std::max(0.0, found);
  const double least = std::min(near.distance / (1 + rel_err), near.distance);
  near.lower = std::max(0.0, std::min(least, near.distance - abs_err) - errorOf(other, length));
  near.point_a = result.nearest_points[0];
  near.point_b = result.nearest_points[1];
  near.id_a = result.b1;
  near.id_b = other.kind == BodyKind::kOctree ? result.b2 : -1;
  if (result.o1 != mesh.geometry.get()) swap(near);
  return near;
}

}  // namespace

Nearness distanceOf(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
                    double rel_err, double abs_err, double far_enough) {
  if (a.mesh && b.mesh) return ofMeshes(a, X_WA, b, X_WB, rel_err, abs_err, far_enough);
  if (a.mesh) return ofMeshAndOther(a, X_WA, b, X_WB, rel_err, abs_err, far_enough);
  if (b.mesh) {
    Nearness near = ofMeshAndOther(b, X_WB, a, X_WA, rel_err, abs_err, far_enough);
    swap(near);
    return near;
  }
  if (a.kind == BodyKind::kOctree || b.kind == BodyKind::kOctree) {
    refuse("an octree is served against meshes only; make the other a mesh, or allow the pair.");
  }
  return ofShapes(a, X_WA, b, X_WB);
}

bool touching(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
              double separation, RobotContact* contact) {
  const auto nearContact = [&](const Nearness& near) {
    if (!contact) return;
    contact->id_a = near.id_a;
    contact->id_b = near.id_b;
    contact->point = 0.5 * (near.point_a + near.point_b);
  };
  const bool shapes = !a.mesh && !b.mesh;
  if (shapes && (a.kind != BodyKind::kShape || b.kind != BodyKind::kShape)) {
    const Nearness near = distanceOf(a, X_WA, b, X_WB);
    if (near.distance <= separation) nearContact(near);
    return near.distance <= separation;
  }
  if (separation > 0) {
    const bool meshes = a.mesh && b.mesh;
    if (!contact && meshes && !(isSolid(*a.mesh) && isSolid(*b.mesh))) {
      return closerThan(*a.mesh, X_WA, *b.mesh, X_WB, separation);
    }
    // A shape's threshold is exclusive.
    const Nearness near = distanceOf(a, X_WA, b, X_WB, 0, 0, separation * (1 + 0x1p-40));
    if (!(near.distance <= separation)) return false;
    nearContact(near);
    return true;
  }
  if (shapes && areUnlike(a, b)) {
    const Nearness near = distanceOf(a, X_WA, b, X_WB);
    if (near.lower <= 0) nearContact(near);
    return near.lower <= 0;  // free only by proof, as distances round by the larger one's size
  }
  const fcl::CollisionRequestd request(1, contact != nullptr);
  fcl::CollisionResultd result;
  if (!collide(a, X_WA, b, X_WB, request, result)) return false;
  if (contact && result.numContacts() > 0) {
    const fcl::Contactd& c = result.getContact(0);
    const bool same = c.o1 == a.geometry.get();
    contact->point = c.pos;
    contact->id_a = same ? c.b1 : c.b2;
    contact->id_b = same ? c.b2 : c.b1;
    if (a.kind == BodyKind::kShape) contact->id_a = -1;
    if (b.kind == BodyKind::kShape || b.kind == BodyKind::kPlane) contact->id_b = -1;
    if (a.kind == BodyKind::kPlane) contact->id_a = -1;
  }
  return true;
}

Vector3d wayOut(const Body& a, const Transform3d& X_WA, const Body& b, const Transform3d& X_WB,
                Nearness& near) {
  Vector3d way = Vector3d::Zero();
  if (a.mesh && b.mesh && isSolid(*a.mesh) && isSolid(*b.mesh)) {
    const PenetrationResult depth = penetration(*a.mesh, X_WA, *b.mesh, X_WB);
    way = depth.translation;
    if (depth.upper > 0) near.point_a = near.point_b = depth.point;
  }
  if (way.isZero(0) && a.kind != BodyKind::kOctree && b.kind != BodyKind::kOctree &&
      (a.mesh || b.mesh || !areUnlike(a, b))) {
    fcl::CollisionRequestd request(1, true);
    fcl::CollisionResultd result;
    try {
      if (collide(a, X_WA, b, X_WB, request, result) && result.numContacts() > 0) {
        const fcl::Contactd& c = result.getContact(0);
        way = c.o1 == a.geometry.get() ? c.normal : Vector3d(-c.normal);
        if (c.pos.allFinite()) near.point_a = near.point_b = c.pos;
      }
    } catch (const std::exception&) {
      way.setZero();
    }
  }
  const double length = way.norm();
  if (!(length > 0) || !way.allFinite()) return Vector3d::Zero();
  return way / length;
}

}  // namespace kios::robot
