// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/hull.h"

#include <algorithm>
#include <vector>

#include "fcl_kios/triangle.h"
#include "shape/nearest_point.h"
#include "triangle/predicates.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::shape {
namespace {

/// Calls f with a polygon of `corners` corners as a fan of triangles until f returns true; segments
/// and points are triangles without area.
template <typename Corner, typename F>
bool anyOfFan(int corners, const Corner& corner, const F& f) {
  if (corners == 1) return f(Triangle{corner(0), corner(0), corner(0)});
  if (corners == 2) return f(Triangle{corner(0), corner(1), corner(1)});
  for (int k = 2; k < corners; ++k) {
    if (f(Triangle{corner(0), corner(k - 1), corner(k)})) return true;
  }
  return false;
}

template <typename F>
bool anyBoxFace(const Vec& h, const F& f) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double side : {-h[axis], h[axis]}) {
      const auto corner = [&](int k) {
        Vec p;
        p[axis] = side;
        p[u] = k == 1 || k == 2 ? h[u] : -h[u];
        p[v] = k >= 2 ? h[v] : -h[v];
        return p;
      };
      if (anyOfFan(4, corner, f)) return true;
    }
  }
  return false;
}

/// Calls f with each face of the core as triangles, until f returns true. Returns whether it did.
template <typename F>
bool anyFace(const Solid& s, const F& f) {
  if (s.kind == Kind::kBox) return anyBoxFace(s.half, f);
  if (s.kind == Kind::kCapsule) {
    const Vec end(0, 0, s.half_length);
    return f(Triangle{Vec(-end), end, end});
  }
  const auto point = [&s](int k) { return s.points[k]; };
  if (s.points.size() <= 3) return anyOfFan(static_cast<int>(s.points.size()), point, f);
  const int* face = s.faces;
  for (int i = 0; i < s.num_faces; ++i) {
    const int corners = face[0];
    const auto corner = [&s, face](int k) { return s.points[face[1 + k]]; };
    if (anyOfFan(corners, corner, f)) return true;
    face += corners + 1;
  }
  return false;
}

/// True if p lies in the closed tetrahedron of an apex and a face, by exact signs. Flat ones
/// contain nothing.
bool inTetrahedron(const Vec& apex, const Triangle& face, const Vec& p) {
  constexpr int kApex = 3, kPoint = 4;
  const PairPredicates::Coordinates points = coordinatesOf(face, Triangle{apex, p, p});
  const PairPredicates signs(points);
  const int volume = signs.orient3d(0, 1, 2, kApex);
  return volume != 0 && signs.orient3d(0, 1, 2, kPoint) * volume >= 0 &&
         signs.orient3d(kPoint, 1, 2, kApex) * volume >= 0 &&
         signs.orient3d(0, kPoint, 2, kApex) * volume >= 0 &&
         signs.orient3d(0, 1, kPoint, kApex) * volume >= 0;
}

/// True if p lies in a hull that has a volume: in one of the tetrahedra of a vertex and the faces,
/// whichever way the corners of those run.
bool contains(const Solid& s, const Vec& p) {
  if (s.points.size() <= 3) return false;
  const auto [low, high] = rangeOf(s);
  if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
  return anyFace(s, [&](const Triangle& face) { return inTetrahedron(s.points[0], face, p); });
}

bool isEdge(TriangleFeature feature) {
  return feature != TriangleFeature::kFace && feature >= TriangleFeature::kEdge0;
}

Vec edgeOf(const Triangle& t, TriangleFeature feature) {
  const int i = static_cast<int>(feature) - static_cast<int>(TriangleFeature::kEdge0);
  return unitVector(t[(i + 1) % 3] - t[i]);
}

/// From the solid to the triangle, unit, across the features where they are nearest: these keep
/// their digits where the points' difference has lost them.
Vec directionAcross(const Triangle& t, const Triangle& face, const TriangleDistance<double>& d) {
  const Vec between = d.point_a - d.point_b;
  Vec n = Vec::Zero();
  if (d.feature_a == TriangleFeature::kFace) {
    n = unitVector(faceNormal(t));
  } else if (d.feature_b == TriangleFeature::kFace) {
    n = unitVector(faceNormal(face));
  } else if (isEdge(d.feature_a) && isEdge(d.feature_b)) {
    n = edgeOf(t, d.feature_a).cross(edgeOf(face, d.feature_b));
  }
  if (!(n.squaredNorm() > 0x1p-80)) n = between;
  return unitVector(n.dot(between) < 0 ? Vec(-n) : n);
}

/// The point that may lie farthest beyond x along n, whose direction may be off by `error`; null if
/// none does or those that do have been chosen.
const Vec* farthestBeyond(const Solid& s, const Vec& x, const Vec& n, double error,
                          const std::vector<Vec>& chosen) {
  const Vec* farthest = nullptr;
  double most = 0;
  for (const Vec& p : s.points) {
    const double beyond = n.dot(p - x) + error * (p - x).norm();
    if (!(beyond > most) || std::find(chosen.begin(), chosen.end(), p) != chosen.end()) continue;
    most = beyond;
    farthest = &p;
  }
  return farthest;
}

}  // namespace

bool hasFaces(const Solid& s) {
  return s.kind == Kind::kBox || s.kind == Kind::kCapsule ||
         (s.kind == Kind::kConvex && (s.num_faces > 0 || s.points.size() <= 3));
}

bool meetsHull(const Solid& s, const Triangle& t, Vec* common) {
  const bool meets = anyFace(s, [&](const Triangle& face) {
    if (!trianglesIntersect(t, face)) return false;
    if (common) *common = intersectionPoint(t, face);
    return true;
  });
  if (meets) return true;
  // Without a common point with the surface the triangle is inside as a whole, or not at all.
  // Points may round faces so that a few between tetrahedra, as some about the middle, are in none.
  if (s.kind != Kind::kConvex) return false;
  for (const Vec& corner : t) {
    if (!contains(s, corner)) continue;
    if (common) *common = corner;
    return true;
  }
  return false;
}

CoreDistance distanceToHull(const Solid& s, const Triangle& t, double within) {
  CoreDistance best = {};
  best.upper = kInfinity;
  // Upper bounds of distances are off by less than this.
  const double slack = 0x1p-46 * (sizeOf(t) + s.reach());
  const Vec low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  anyFace(s, [&](const Triangle& face) {
    const double reach = std::min(within, best.upper) + slack;
    for (int c = 0; c < 3; ++c) {
      if (std::min({face[0][c], face[1][c], face[2][c]}) > high[c] + reach) return false;
      if (std::max({face[0][c], face[1][c], face[2][c]}) < low[c] - reach) return false;
    }
    const TriangleDistance<double> d = triangleDistance(t, face);
    if (d.distance < best.upper) best = {d.distance, d.distance, false, d.point_a, d.point_b};
    return false;
  });
  return best;
}

// The direction towards the triangle loses digits as the distance falls, and a point beyond might
// be passed over for that: so points count as far as the direction may be off.
CoreDistance distanceToPoints(const Solid& s, const Triangle& t) {
  CoreDistance best = {};
  best.upper = kInfinity;
  std::vector<Vec> chosen = {coreSupport(s, t[0] - s.points[0])};
  Vec n = Vec::Zero();
  const double size = sizeOf(t) + s.reach();
  constexpr int kMost = 32;
  while (true) {
    const Vec next = chosen.back();
    const std::size_t last = chosen.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      for (std::size_t j = i; j <= last; ++j) {
        const Triangle face = {chosen[i], chosen[j], next};
        for (std::size_t k = 0; k < i && i < j && j < last; ++k) {
          if (inTetrahedron(chosen[k], face, t[0])) {
            return {0, 0, true, t[0], t[0]};
          }
        }
        const TriangleDistance<double> d = triangleDistance(t, face);
        if (!(d.distance < best.upper)) continue;
        best = {d.distance, d.distance, false, d.point_a, d.point_b};
        n = directionAcross(t, face, d);
      }
    }
    if (best.upper <= 0x1p-48 * size || chosen.size() == kMost) break;
    const double error = 0x1p-50 * size / best.upper;
    const Vec* farthest = farthestBeyond(s, best.on_core, n, error, chosen);
    if (!farthest) break;
    chosen.push_back(*farthest);
  }
  return best;
}

CoreDistance closedBracket(const Solid& s, const Triangle& t, double required,
                           const CoreDistance& core) {
  const double tolerance = 0x1p-48 * (sizeOf(t) + core.on_core.lpNorm<1>());
  const bool decided = core.inside || core.lower > required;
  if (decided || core.upper - core.lower <= tolerance) return core;
  if (!hasFaces(s) && s.kind != Kind::kConvex) return core;
  const CoreDistance exact =
      hasFaces(s) ? distanceToHull(s, t, core.upper) : distanceToPoints(s, t);
  if (exact.upper <= core.upper) return exact;
  return {core.upper, core.upper, core.inside, core.point, core.on_core};
}

}  // namespace kios::shape
