// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/gjk.h"
#include "shape/hull.h"
#include "shape/triangle_shape.h"

namespace kios::shape {
namespace {

/// Separating axes: three of the box, the triangle's normal, nine cross products of edges. The zero
/// axes of degenerate triangles separate nothing, and the others suffice for those.
bool meetsBox(const Vec& h, const Triangle& t) {
  for (int c = 0; c < 3; ++c) {
    if (std::min({t[0][c], t[1][c], t[2][c]}) > h[c]) return false;
    if (std::max({t[0][c], t[1][c], t[2][c]}) < -h[c]) return false;
  }
  const auto separates = [&](const Vec& n) {
    const double reach = h.dot(n.cwiseAbs());
    const double a = n.dot(t[0]), b = n.dot(t[1]), c = n.dot(t[2]);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  const Vec edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  if (separates(edges[0].cross(edges[1]))) return false;
  for (const Vec& e : edges) {
    if (separates({0, -e.z(), e.y()}) || separates({e.z(), 0, -e.x()}) ||
        separates({-e.y(), e.x(), 0})) {
      return false;
    }
  }
  return true;
}

/// A triangle cut to |z| <= h.
struct Polygon {
  int size = 0;
  std::array<Vec, 7> corner;
};

void clip(const Polygon& in, double sign, double h, Polygon& out) {
  out.size = 0;
  for (int i = 0; i < in.size; ++i) {
    const Vec &a = in.corner[i], &b = in.corner[(i + 1) % in.size];
    const double above_a = sign * a.z() - h, above_b = sign * b.z() - h;
    if (above_a <= 0) out.corner[out.size++] = a;
    if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0)) {
      const double t = above_a / (above_a - above_b);
      Vec p = a + t * (b - a);
      p.z() = sign * h;
      out.corner[out.size++] = p;
    }
  }
}

/// Whether the z axis pierces the polygon's inside. A polygon seen from its edge has none.
bool aroundAxis(const Polygon& polygon) {
  bool left = true, right = true;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec &a = polygon.corner[i], &b = polygon.corner[(i + 1) % polygon.size];
    const double side = a.x() * b.y() - a.y() * b.x();
    left &= side > 0;
    right &= side < 0;
  }
  return polygon.size >= 3 && (left || right);
}

/// Least rho + slope z over a segment, |slope| being the cone's (0: a cylinder's).
// With w = the way along the segment in the xy plane, measured from the point nearest to the axis,
// rho = hypot(w, m) is convex, z is linear in w, and the derivative vanishes at -k m / sqrt(1-k^2).
double leastOnEdge(const Vec& a, const Vec& b, double slope) {
  const double dx = b.x() - a.x(), dy = b.y() - a.y(), length = std::sqrt(dx * dx + dy * dy);
  const double at_a = std::sqrt(a.x() * a.x() + a.y() * a.y()) + slope * a.z();
  const double at_b = std::sqrt(b.x() * b.x() + b.y() * b.y()) + slope * b.z();
  const double ends = std::min(at_a, at_b);
  if (!(length > 0)) return ends;
  const double ux = dx / length, uy = dy / length;
  const double m = std::abs(a.x() * uy - a.y() * ux);
  const double k = slope * (b.z() - a.z()) / length;
  if (!(std::abs(k) < 1)) return ends;
  const double w0 = a.x() * ux + a.y() * uy;
  const double w = std::clamp(-k * m / std::sqrt(1 - k * k), w0, w0 + length);
  return std::min(ends,
                  std::sqrt(w * w + m * m) + slope * (a.z() + (w - w0) / length * (b.z() - a.z())));
}

/// Cylinder and cone are {rho + slope z <= limit, |z| <= h}. If no edge of what the slab leaves of
/// the triangle meets them, only its inside can, and then around the axis.
bool meetsTurned(const Solid& s, const Triangle& t) {
  const double h = s.half_length;
  const bool cone = s.kind == Kind::kCone && h > 0;
  const double slope = cone ? s.radius / (2 * h) : 0.0;
  const double limit = cone ? s.radius / 2 : s.radius;
  Polygon polygon, cut;
  polygon.size = 3;
  std::copy(t.begin(), t.end(), polygon.corner.begin());
  clip(polygon, 1, h, cut);
  clip(cut, -1, h, polygon);
  for (int i = 0; i < polygon.size; ++i) {
    if (leastOnEdge(polygon.corner[i], polygon.corner[(i + 1) % polygon.size], slope) <= limit) {
      return true;
    }
  }
  return aroundAxis(polygon);
}

/// In units of the radii the ellipsoid is the unit ball.
bool meetsEllipsoid(const Vec& e, const Triangle& t) {
  Triangle scaled;
  for (int i = 0; i < 3; ++i) scaled[i] = t[i].cwiseQuotient(e);
  double weights[3];
  return nearestToOrigin(scaled, weights).squaredNorm() <= 1;
}

}  // namespace

bool intersects(const Solid& s, const Triangle& t) {
  switch (s.kind) {
    case Kind::kSphere: {
      double weights[3];
      return nearestToOrigin(t, weights).norm() <= s.radius;
    }
    case Kind::kBox:
      return meetsBox(s.half, t);
    case Kind::kEllipsoid:
      if (s.half.minCoeff() > 0x1p-100 * s.half.maxCoeff()) return meetsEllipsoid(s.half, t);
      break;
    case Kind::kCylinder:
    case Kind::kCone:
      return meetsTurned(s, t);
    case Kind::kHalfspace:
    case Kind::kPlane: {
      const double a = s.normal.dot(t[0]), b = s.normal.dot(t[1]), c = s.normal.dot(t[2]);
      if (std::min({a, b, c}) > s.offset) return false;
      return s.kind == Kind::kHalfspace || std::max({a, b, c}) >= s.offset;
    }
    default:
      break;
  }
  const double size = sizeOf(t), clear = 0x1p-40 * size;
  const CoreDistance core = gjkDistance(s, t.data(), 3, s.margin() + clear);
  if (s.margin() > 0) return core.upper <= s.margin();
  if (core.inside || core.lower > clear) return core.inside;
  if (s.num_faces > 0) return meetsHull(s, t);
  return core.upper <= 0x1p-50 * size;
}

}  // namespace kios::shape
