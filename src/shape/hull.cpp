// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/hull.h"

#include <algorithm>
#include <limits>

#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"

namespace kios::shape {
namespace {

/// Calls f with each face as a fan of triangles, until f returns true. Returns whether it did.
template <typename F>
bool anyFace(const Solid& s, const F& f) {
  const int* face = s.faces;
  for (int i = 0; i < s.num_faces; ++i) {
    const int corners = face[0];
    for (int k = 3; k <= corners; ++k) {
      if (f(Triangle{s.points[face[1]], s.points[face[k - 1]], s.points[face[k]]})) return true;
    }
    face += corners + 1;
  }
  return false;
}

Vec middleOf(const Solid& s) {
  Vec sum = Vec::Zero();
  for (const Vec& q : s.points) sum += q;
  return sum / static_cast<double>(s.points.size());
}

/// Every face has p on the side of the hull's middle, whichever way its corners run.
bool contains(const Solid& s, const Vec& p) {
  const Vec middle = middleOf(s);
  return !anyFace(s, [&](const Triangle& t) {
    const Vec n = (t[1] - t[0]).cross(t[2] - t[0]);
    const double inner = n.dot(middle - t[0]), height = n.dot(p - t[0]);
    return inner < 0 ? height > 0 : (inner > 0 ? height < 0 : height != 0);
  });
}

}  // namespace

bool meetsHull(const Solid& s, const Triangle& t) {
  return contains(s, t[0]) ||
         anyFace(s, [&](const Triangle& face) { return trianglesIntersect(t, face); });
}

TriangleShapeDistance distanceToHull(const Solid& s, const Triangle& t) {
  TriangleShapeDistance best;
  best.distance = best.lower = std::numeric_limits<double>::infinity();
  anyFace(s, [&](const Triangle& face) {
    const TriangleDistance<double> d = triangleDistance(t, face);
    if (d.distance < best.distance) {
      best.distance = best.lower = d.distance;
      best.on_triangle = d.point_a;
      best.on_shape = d.point_b;
    }
    return false;
  });
  return best;
}

FaceExit leastFaceExit(const Solid& s, const Triangle& t) {
  const Vec middle = middleOf(s);
  FaceExit best = {Vec::UnitZ(), std::numeric_limits<double>::infinity()};
  anyFace(s, [&](const Triangle& face) {
    Vec n = (face[1] - face[0]).cross(face[2] - face[0]);
    if (n.dot(middle - face[0]) > 0) n = -n;
    const double length = n.norm();
    if (!(length > 0)) return false;
    const double depth =
        (n.dot(face[0]) - std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])})) / length;
    if (depth < best.depth) best = {n / length, depth};
    return false;
  });
  return best;
}

}  // namespace kios::shape
