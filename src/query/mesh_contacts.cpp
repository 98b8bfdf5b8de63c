// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/mesh_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fcl_kios/triangle.h"
#include "volume/unit_vector.h"

namespace kios {
namespace {

/// Unit normal, zero for a triangle without one.
Pointd normalOf(const TriangleVerticesd& t) {
  const Pointd u = unitVector(t[1] - t[0]), v = unitVector(t[2] - t[0]);
  const Pointd n = u.cross(v);
  return n.squaredNorm() > 0 ? Pointd(n.normalized()) : Pointd(Pointd::Zero());
}

/// The plane of a triangle as FCL's buildTrianglePlane() computes it: n . x = offset. Nothing where
/// the square of the area under- or overflows.
struct Plane {
  explicit Plane(const TriangleVerticesd& t) : normal((t[1] - t[0]).cross(t[2] - t[0])) {
    const double squared = normal.squaredNorm();
    found = squared >= std::numeric_limits<double>::min() &&
            squared <= std::numeric_limits<double>::max();
    if (!found) return;
    normal /= std::sqrt(squared);
    offset = normal.dot(t[0]);
  }

  Pointd normal;
  double offset = 0;
  bool found;
};

/// The vertices that lie deepest below a plane, as FCL's computeDeepestPoints() finds them: with
/// its tolerances, and its 1e-5 of any unit of length.
struct Deepest {
  Deepest(const TriangleVerticesd& t, const Plane& plane) {
    constexpr double kEpsilon = 1e-5;
    constexpr double kEqual = 1e-6;
    bool above = false, below = false, in_plane = false;
    for (const Pointd& p : t) {
      const double below_by = -(plane.normal.dot(p) - plane.offset);
      below |= below_by > kEpsilon;
      above |= below_by < -kEpsilon;
      in_plane |= !(below_by > kEpsilon) && !(below_by < -kEpsilon);
      if (below_by > depth) {
        depth = below_by;
        points[0] = p;
        count = 1;
      } else if (below_by + kEqual >= depth) {
        points[count++] = p;
      }
    }
    if (depth < -kEpsilon || (!in_plane && !(above && below))) count = 0;
  }

  double depth = -std::numeric_limits<double>::max();
  Pointd points[3];
  std::size_t count = 0;
};

}  // namespace

// FCL tests 17 axes first; that the triangles intersect is known here.
TriangleContact triangleContact(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  TriangleContact contact;
  const Plane plane_a(a), plane_b(b);
  if (plane_a.found && plane_b.found) {
    const Deepest of_b(b, plane_a), of_a(a, plane_b);
    const bool along_a = of_a.depth > of_b.depth;
    const Deepest& deepest = along_a ? of_b : of_a;
    contact.normal = along_a ? plane_a.normal : Pointd(-plane_b.normal);
    if (deepest.count > 0 && contact.normal.allFinite()) {
      contact.num_points = std::min<std::size_t>(deepest.count, 2);
      contact.depth = std::max(0.0, deepest.depth);
      std::copy_n(deepest.points, contact.num_points, contact.points);
      return contact;
    }
  }
  const Pointd normal_a = normalOf(a), normal_b = normalOf(b);
  contact.points[0] = intersectionPoint(a, b);
  contact.num_points = 1;
  contact.normal = !normal_a.isZero(0)
                       ? normal_a
                       : (!normal_b.isZero(0) ? Pointd(-normal_b) : Pointd(Pointd::UnitX()));
  contact.depth = 0;
  return contact;
}

}  // namespace kios
