// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shape/meets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/convex_faces.h"
#include "shape/hull.h"
#include "shape/nearest_point.h"
#include "shape/polygon.h"
#include "triangle/twofold.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

/// The normal of a triangle with edges e, as the cross product of the two shorter ones: of a
/// needle's long edges it would have no digits. `accurate` says that it has nearly all: the sine of
/// the angle between the two, the triangle's largest, is 1/2 at least.
Vec normalOf(const Vec (&e)[3], bool& accurate) {
  const double sizes[3] = {e[0].squaredNorm(), e[1].squaredNorm(), e[2].squaredNorm()};
  const auto longest = std::max_element(sizes, sizes + 3) - sizes;
  const int i = (longest + 1) % 3, j = (longest + 2) % 3;
  const Vec n = e[i].cross(e[j]);
  accurate = 4 * n.squaredNorm() > sizes[i] * sizes[j];
  return n;
}

/// A corner in the box decides, or else separating axes: three of the box, the triangle's normal,
/// nine cross products of edges. The zero
/// axes of degenerate triangles separate nothing, and the others suffice for those. An axis that
/// separates proves it. None proves a common point but if the normal has its digits: else what the
/// box's slabs leave of the triangle decides.
bool meetsBox(const Solid& s, const Triangle& t, Vec* common) {
  const Vec& h = s.half;
  for (int c = 0; c < 3; ++c) {
    if (std::min({t[0][c], t[1][c], t[2][c]}) > h[c]) return false;
    if (std::max({t[0][c], t[1][c], t[2][c]}) < -h[c]) return false;
  }
  for (const Vec& p : t) {
    if (std::abs(p.x()) > h.x() || std::abs(p.y()) > h.y() || std::abs(p.z()) > h.z()) continue;
    if (common) *common = p;
    return true;
  }
  const auto separates = [](double a, double b, double c, double reach) {
    return std::max(std::min({a, b, c}), -std::max({a, b, c})) > reach;
  };
  const Vec edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  bool accurate;
  const Vec n = normalOf(edges, accurate);
  if (separates(n.dot(t[0]), n.dot(t[1]), n.dot(t[2]), h.dot(n.cwiseAbs()))) return false;
  for (const Vec& e : edges) {
    bool apart = false;
    for (int i = 0; i < 3; ++i) {  // unit vector i x edge
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const auto along = [&](const Vec& p) { return e[j] * p[k] - e[k] * p[j]; };
      apart |= separates(along(t[0]), along(t[1]), along(t[2]),
                         h[j] * std::abs(e[k]) + h[k] * std::abs(e[j]));
    }
    if (apart) return false;
  }
  if (accurate && !common) return true;
  const Polygon polygon(t, h);
  if (polygon.size > 0) {
    if (common) *common = polygon.middle();
    return true;
  }
  if (accurate) *common = distanceToHull(s, t, kInfinity).point;  // touching, rounded
  return accurate;
}

/// Returns true if the z axis pierces the polygon's inside, and sets `common` to that point. A
/// polygon seen from its edge has no inside. The areas keep their digits however thin the polygon
/// is: they are the weights of its corners.
bool aroundAxis(const Polygon& polygon, Vec* common) {
  bool left = true, right = true;
  const auto side = [](const Vec& a, const Vec& b) {
    return accurateMinor({a.x(), 0}, {a.y(), 0}, {b.x(), 0}, {b.y(), 0});
  };
  for (int i = 0; i < polygon.size; ++i) {
    const double at = side(polygon.corner[i], polygon.corner[(i + 1) % polygon.size]);
    left &= at > 0;
    right &= at < 0;
  }
  if (polygon.size < 3 || !(left || right)) return false;
  if (!common) return true;
  int i = 1;  // the first triangle of the fan about corner 0 that has the axis on its last side
  const Vec& a = polygon.corner[0];
  while (i + 2 < polygon.size && (side(polygon.corner[i + 1], a) > 0) != left) ++i;
  const Vec &b = polygon.corner[i], &c = polygon.corner[i + 1];
  const double u = std::abs(side(b, c)), v = std::abs(side(c, a)), w = std::abs(side(a, b));
  *common = (u * a + v * b + w * c) / (u + v + w);
  return true;
}

/// Least rho + slope z over a segment, |slope| being the cone's (0: a cylinder's), and where.
// With w = the way along the segment in the xy plane, measured from the point nearest to the axis,
// rho = hypot(w, m) is convex, z is linear in w, and the derivative vanishes at -k m / sqrt(1-k^2).
double leastOnEdge(const Vec& a, const Vec& b, double slope, Vec* at) {
  const double dx = b.x() - a.x(), dy = b.y() - a.y(), length = std::sqrt(dx * dx + dy * dy);
  const double at_a = std::sqrt(a.x() * a.x() + a.y() * a.y()) + slope * a.z();
  const double at_b = std::sqrt(b.x() * b.x() + b.y() * b.y()) + slope * b.z();
  const double ends = std::min(at_a, at_b);
  if (at) *at = at_a <= at_b ? a : b;
  if (!(length > 0)) return ends;
  const double ux = dx / length, uy = dy / length;
  const double m = std::abs(a.x() * uy - a.y() * ux);
  const double k = slope * (b.z() - a.z()) / length;
  if (!(std::abs(k) < 1)) return ends;
  const double w0 = a.x() * ux + a.y() * uy;
  const double w = std::clamp(-k * m / std::sqrt(1 - k * k), w0, w0 + length);
  const double way = (w - w0) / length;
  const double least = std::sqrt(w * w + m * m) + slope * (a.z() + way * (b.z() - a.z()));
  if (at && least < ends) *at = a + way * (b - a);
  return std::min(ends, least);
}

/// Cylinder and cone are {rho + slope z <= limit, |z| <= h}. If no edge of what the slab leaves of
/// the triangle meets them, only its inside can, and then around the axis.
bool meetsTurned(const Solid& s, const Triangle& t, Vec* common) {
  const double h = s.half_length;
  const bool cone = s.kind == Kind::kCone && h > 0x1p-500 * s.radius;
  const double slope = cone ? s.radius / (2 * h) : 0.0;
  const double limit = cone ? s.radius / 2 : s.radius;
  Polygon polygon(t);
  polygon.clip(2, h);
  for (int i = 0; i < polygon.size; ++i) {
    const Vec &a = polygon.corner[i], &b = polygon.corner[(i + 1) % polygon.size];
    if (leastOnEdge(a, b, slope, common) <= limit) return true;
  }
  return aroundAxis(polygon, common);
}

/// In units of the radii the ellipsoid is the unit ball.
bool meetsInRadii(const Vec& e, const Triangle& t, Vec* common) {
  Triangle scaled;
  for (int i = 0; i < 3; ++i) scaled[i] = t[i].cwiseQuotient(e);
  const Vec nearest = nearestToOrigin(scaled);
  if (common) *common = nearest.cwiseProduct(e);
  return nearest.squaredNorm() <= 1;
}

/// Decides it by what the ellipsoid's box leaves of the triangle, which is at most 1 large in units
/// of the radii. The least radius comes first: later crossings lie between points that are within
/// it, so that none is off by more than rounding of L across another. Radii of 0 leave what lies in
/// the ellipse's plane, a segment's line or a point.
bool meetsFlatEllipsoid(const Vec& e, const Triangle& t, Vec* common) {
  std::array<int, 3> axes = {0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&e](int a, int b) { return e[a] < e[b]; });
  Polygon polygon(t);
  Vec radii = e;
  for (const int axis : axes) {
    const bool flat = isFlat(e, axis);
    polygon.clip(axis, flat ? 0.0 : e[axis]);
    if (flat) radii[axis] = 1;  // of coordinates that are 0
  }
  const auto corner = [&](int k) { return polygon.corner[std::min(k, polygon.size - 1)]; };
  for (int i = 2; polygon.size > 0 && i < std::max(3, polygon.size); ++i) {
    if (meetsInRadii(radii, {corner(0), corner(i - 1), corner(i)}, common)) return true;
  }
  return false;
}

}  // namespace

// The nearest point of a triangle of size S is off by 2^-46 S, in units of the radii as well.
bool isLargeInRadii(const Vec& e, const Triangle& t) {
  const double most = e.maxCoeff();
  if (isFlat(e, 0) || isFlat(e, 1) || isFlat(e, 2)) return true;
  if (4 * e.minCoeff() >= most) return false;
  double size = 0;
  for (const Vec& p : t) size = std::max(size, p.cwiseQuotient(e).lpNorm<1>());
  return size * most > 4 * (sizeOf(t) + most);
}

bool meets(const Solid& s, const Triangle& t, Vec* common) {
  switch (s.kind) {
    case Kind::kSphere: {
      const Vec nearest = nearestToOrigin(t);
      if (common) *common = nearest;
      return nearest.norm() <= s.radius;
    }
    case Kind::kBox:
      return meetsBox(s, t, common);
    case Kind::kEllipsoid:
      return isLargeInRadii(s.half, t) ? meetsFlatEllipsoid(s.half, t, common)
                                       : meetsInRadii(s.half, t, common);
    case Kind::kCylinder:
    case Kind::kCone:
      return meetsTurned(s, t, common);
    default:
      return meetsHull(s, t, common);
  }
}

bool meetsAt(const Solid& s, const Triangle& t, const CoreDistance& core, Vec* common) {
  if (core.inside && common) *common = core.point;
  if (core.inside && s.kind == Kind::kConvex) return true;
  if (s.kind == Kind::kConvex && !hasFaces(s)) {
    const CoreDistance d = distanceToPoints(s, t);
    if (common) *common = d.point;
    return d.upper <= 0x1p-50 * sizeOf(t);
  }
  return meets(s, t, core.inside ? nullptr : common);
}

bool intersects(const Solid& s, const Triangle& t, const ConvexFaces* faces,
                std::optional<Vec>* across) {
  if (!s.bounded()) {
    const double a = s.normal.dot(t[0]), b = s.normal.dot(t[1]), c = s.normal.dot(t[2]);
    if (std::min({a, b, c}) > s.offset) return false;
    return s.kind == Kind::kHalfspace || std::max({a, b, c}) >= s.offset;
  }
  if (s.kind != Kind::kConvex && s.kind != Kind::kCapsule) return meets(s, t, nullptr);
  if (faces && faces->known()) {
    const ConvexFaces::Verdict verdict = faces->judge(t);
    if (verdict != ConvexFaces::Verdict::kOpen) return verdict == ConvexFaces::Verdict::kMeets;
  }
  const double margin = s.margin(), beyond = margin + 0x1p-40 * sizeOf(t);
  CoreDistance core = {};
  if (s.kind == Kind::kCapsule && distanceByCertificate(s, t, beyond, core)) {
    return core.upper <= margin;
  }
  core = gjkDistance(s, t.data(), 3, beyond);
  if (margin > 0) return closedBracket(s, t, margin, core).upper <= margin;
  const bool apart = core.lower > clearOf(t, core);
  if (across && apart) *across = core.point - core.on_core;
  return !apart && meetsAt(s, t, core, nullptr);
}

}  // namespace kios::shape
