// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/triangle_contact.h"

#include <algorithm>
#include <limits>

#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include "fcl_kios/triangle/intersection.h"

namespace kios {
namespace {

/// Unit normal, zero for a triangle without one.
template <typename S>
Point<S> normalOf(const TriangleVertices<S>& t) {
  const Point<S> u = (t[1] - t[0]).stableNormalized(), v = (t[2] - t[0]).stableNormalized();
  const Point<S> n = u.cross(v);
  return n.squaredNorm() > 0 ? Point<S>(n.normalized()) : Point<S>(Point<S>::Zero());
}

/// True if FCL's routine finds the triangle's plane. It squares the area twice, and if that under-
/// or overflows, it reads a normal that it never set.
template <typename S>
bool hasPlaneForFCL(const TriangleVertices<S>& t) {
  const S squared = (t[1] - t[0]).cross(t[2] - t[0]).squaredNorm();
  return squared >= std::numeric_limits<S>::min() && squared <= std::numeric_limits<S>::max();
}

}  // namespace

template <typename S>
TriangleContact<S> triangleContact(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  TriangleContact<S> contact;
  const Point<S> normal_a = normalOf(a), normal_b = normalOf(b);
  if (!normal_a.isZero(0) && !normal_b.isZero(0) && hasPlaneForFCL(a) && hasPlaneForFCL(b)) {
    Point<S> points[3];  // FCL's room for deepest vertices
    unsigned int num_points = 0;
    contact.depth = 0;
    if (fcl::detail::Intersect<S>::intersect_Triangle(a[0], a[1], a[2], b[0], b[1], b[2], points,
                                                      &num_points, &contact.depth,
                                                      &contact.normal) &&
        num_points > 0 && contact.normal.allFinite()) {
      contact.num_points = std::min(num_points, 2U);
      contact.depth = std::max(S(0), contact.depth);  // FCL's tolerance is 1e-5 of any unit
      std::copy_n(points, contact.num_points, contact.points);
      return contact;
    }
  }
  contact.points[0] = intersectionPoint(a, b);
  contact.num_points = 1;
  contact.normal = !normal_a.isZero(0)
                       ? normal_a
                       : (!normal_b.isZero(0) ? Point<S>(-normal_b) : Point<S>(Point<S>::UnitX()));
  contact.depth = 0;
  return contact;
}

template TriangleContact<double> triangleContact(const TriangleVertices<double>&,
                                                 const TriangleVertices<double>&);
template TriangleContact<float> triangleContact(const TriangleVertices<float>&,
                                                const TriangleVertices<float>&);

}  // namespace kios
