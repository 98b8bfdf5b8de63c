// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/point_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle.h"

namespace kios {
namespace {

/// A point of a triangle, as seen from p and in the triangle's frame, and a direction.
struct Foot {
  Pointd way, point, n;
};

/// False if the nearest point isn't over the face, or its normal's square loses digits.
bool findOnFace(const Pointd (&v)[3], const TriangleVerticesd& t, Foot& foot) {
  const Pointd e = v[1] - v[0], f = v[2] - v[0], n = e.cross(f);
  const double square = n.squaredNorm();
  // Then no product of e and f that matters underflows, nor does one of n with a corner or foot,
  // and none overflows.
  if (!(square > 0x1p-900 && square < 0x1p900)) return false;
  const double r = n.dot(f.cross(v[0])) / square, s = n.dot(v[0].cross(e)) / square;
  if (!(r >= 0 && s >= 0 && r + s <= 1)) return false;
  foot = {v[0] + r * e + s * f, t[0] + r * (t[1] - t[0]) + s * (t[2] - t[0]),
          n.dot(v[0]) < 0 ? Pointd(-n) : n};
  return true;
}

/// If an edge is nearer than the corner that `foot` begins with. The direction of an inner point of
/// an edge is made orthogonal to the edge, which it misses by rounding where the point is near.
void findOnEdge(const Pointd (&v)[3], const TriangleVerticesd& t, Foot& foot) {
  double least = foot.way.squaredNorm();
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    const Pointd e = v[b] - v[a];
    const double square = e.squaredNorm();
    const double s = square > 0 ? std::clamp(-e.dot(v[a]) / square, 0.0, 1.0) : 0.0;
    const Pointd x = s < 1 ? Pointd(v[a] + s * e) : v[b];
    if (!(x.squaredNorm() < least)) continue;
    least = x.squaredNorm();
    foot = {x, s < 1 ? Pointd(t[a] + s * (t[b] - t[a])) : t[b],
            s > 0 && s < 1 ? Pointd(x - (x.dot(e) / square) * e) : x};
  }
}

}  // namespace

// A slab across n proves a foot that is not within rounding of p: no point of the triangle is
// nearer than the least n v / |n| of the corners, whatever n is. With u = eps / 2, that is off by
// 8 u magnitude at most, |foot| by 11 u, and they may differ by 16 u.
NearestOnTriangle nearestOnTriangle(const Pointd& p, const TriangleVerticesd& t) {
  const Pointd v[3] = {t[0] - p, t[1] - p, t[2] - p};
  double magnitude = 0;
  for (const Pointd& w : v) magnitude = std::max(magnitude, w.cwiseAbs().maxCoeff());
  if (magnitude > 0x1p-300 && magnitude < 0x1p300) {  // so no square of a length that matters fails
    Foot foot = {v[0], t[0], v[0]};
    if (!findOnFace(v, t, foot)) findOnEdge(v, t, foot);
    const double distance = foot.way.norm(), length = foot.n.norm();
    const double lower = std::min({foot.n.dot(v[0]), foot.n.dot(v[1]), foot.n.dot(v[2])});
    if (distance > 0x1p-46 * magnitude && length > 0 &&
        distance * length - lower <= 0x1p-49 * magnitude * length) {
      return {distance, foot.point};
    }
  }
  const TriangleDistanced robust = triangleDistance<double>({p, p, p}, t);
  return {robust.distance, robust.point_b};
}

}  // namespace kios
