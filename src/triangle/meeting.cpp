// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle.h"
#include "triangle/pair_intersection.h"
#include "triangle/plain_intersection.h"
#include "triangle/predicates.h"

namespace kios {
namespace {

/// Whether the edge opposite a corner meets another triangle.
bool oppositeMeets(const TriangleVerticesd& t, int corner, const TriangleVerticesd& other) {
  const Pointd& q = t[kNext[kNext[corner]]];
  return trianglesIntersect<double>({t[kNext[corner]], q, q}, other);
}

}  // namespace

// With a vertex in common, any other common point is the end of a segment from that vertex in both
// triangles, which leaves one of them through its opposite edge. With an edge, only triangles of
// one plane that lie on one side of it share more.
Meeting meetingOf(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  const auto isThin = [](const TriangleVerticesd& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  };
  if (isThin(a) || isThin(b)) return Meeting::kNone;  // below, a corner is shared with one at most
  int of_a[3] = {}, of_b[3] = {}, count = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      of_a[count] = i;
      of_b[count++] = j;
    }
  }
  const PlainPlane plane_a = planeOf(a), plane_b = planeOf(b);
  const int last_a = 3 - of_a[0] - of_a[1], last_b = 3 - of_b[0] - of_b[1];  // where they share two
  const auto liesBeside = [](const PlainPlane& plane, const TriangleVerticesd& t, int corner) {
    return plane.side(t[kNext[corner]]) * plane.side(t[kNext[kNext[corner]]]) > 0;
  };
  if (count == 0 && !trianglesIntersect(a, b)) return Meeting::kNone;
  if (count == 1 && (liesBeside(plane_a, b, of_b[0]) || liesBeside(plane_b, a, of_a[0]))) {
    return Meeting::kNone;
  }
  if (count == 2 && plane_a.side(b[last_b]) != 0) return Meeting::kNone;
  const PairPredicates::Coordinates points = coordinatesOf(a, b);
  const PairPredicates signs(points);
  const int axis = signs.projectionAxis(0, 1, 2);
  if (axis < 0 || signs.projectionAxis(3, 4, 5) < 0) return Meeting::kNone;
  if (count == 3) return Meeting::kOverlap;
  if (count == 2) {
    const auto turn = [&](int third) { return signs.orient2d(of_a[0], of_a[1], third, axis); };
    const bool folded =
        signs.orient3d(0, 1, 2, 3 + last_b) == 0 && turn(last_a) == turn(3 + last_b);
    return folded ? Meeting::kOverlap : Meeting::kNone;
  }
  if (count == 1 && !oppositeMeets(a, of_a[0], b) && !oppositeMeets(b, of_b[0], a)) {
    return Meeting::kNone;
  }
  return PairIntersection(points).meeting();
}

}  // namespace kios
