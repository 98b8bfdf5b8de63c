// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_kios/triangle.h"
#include "shape/shape_oracle.h"
#include "shape/solid.h"
#include "shape/triangle_shape.h"

// Distance of a triangle and a solid in long double, for any sizes: polyhedral cores by the oracle
// of two triangles on each of their faces, round shapes by searching edges and by the support point
// of the triangle's plane. It shares no code with the library.

namespace kios::testing {

inline ExactTriangle exact(const shape::Triangle& t) {
  return {t[0].cast<Real>(), t[1].cast<Real>(), t[2].cast<Real>()};
}

/// Holds the distance, and a point of the triangle and of the solid that realise it.
struct ExactNearest {
  Real distance = std::numeric_limits<Real>::infinity();
  ExactPoint on_triangle = ExactPoint::Zero(), on_shape = ExactPoint::Zero();
};

/// Returns the surface of a sphere's, capsule's, box's or convex shape's core as triangles.
inline std::vector<ExactTriangle> coreFaces(const shape::Solid& s) {
  const ExactPoint h = s.half.cast<Real>();
  std::vector<ExactTriangle> faces;
  const ExactPoint end(0, 0, s.half_length), origin = ExactPoint::Zero();
  if (s.kind == shape::Kind::kSphere) faces.push_back({origin, origin, origin});
  if (s.kind == shape::Kind::kCapsule) faces.push_back({ExactPoint(-end), end, end});
  if (s.kind == shape::Kind::kBox) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        ExactPoint q[4];
        for (int k = 0; k < 4; ++k) {
          q[k][axis] = side * h[axis];
          q[k][(axis + 1) % 3] = (k == 1 || k == 2 ? 1 : -1) * h[(axis + 1) % 3];
          q[k][(axis + 2) % 3] = (k >= 2 ? 1 : -1) * h[(axis + 2) % 3];
        }
        faces.push_back({q[0], q[1], q[2]});
        faces.push_back({q[0], q[2], q[3]});
      }
    }
  }
  if (s.kind == shape::Kind::kConvex) {
    const auto corner = [&](int i) { return ExactPoint(s.points[i].cast<Real>()); };
    const int* face = s.faces;
    for (int i = 0; i < s.num_faces; face += face[0] + 1, ++i) {
      for (int k = 2; k < std::max(3, face[0]); ++k) {
        const auto at = [&](int c) { return corner(face[1 + std::min(c, face[0] - 1)]); };
        faces.push_back({at(0), at(k - 1), at(k)});
      }
    }
  }
  return faces;
}

/// Nearest point of a cylinder, cone or ellipsoid; the distance is negative inside, where it is
/// -(the depth at most).
inline Real pointLevel(const shape::Solid& s, const ExactPoint& p, ExactPoint* nearest = nullptr) {
  if (s.kind == shape::Kind::kEllipsoid) {
    const ExactPoint e = s.half.cast<Real>();
    Real level = 0;
    bool outside_flat = false;
    for (int c = 0; c < 3; ++c) {
      if (e[c] > 0) {
        level += p[c] / e[c] * (p[c] / e[c]);
      } else {
        outside_flat |= p[c] != 0;
      }
    }
    const bool inside = level <= 1 && !outside_flat;
    const ExactPoint x = inside ? p : nearestOfEllipsoid(e, p);
    if (nearest) *nearest = x;
    return inside ? (std::sqrt(level) - 1) * e.minCoeff() : (p - x).norm();
  }
  return turnedLevel(s.radius, s.half_length, s.kind == shape::Kind::kCone, p, nearest);
}

/// Returns the least level of a cylinder, cone or ellipsoid over the triangle: negative where the
/// inside is met.
inline Real leastPointLevel(const shape::Solid& s, const ExactTriangle& t) {
  const ExactPoint e = s.half.cast<Real>(), origin = ExactPoint::Zero();
  if (s.kind == shape::Kind::kEllipsoid && e.minCoeff() > 0) {  // a ball, in units of the radii
    const ExactTriangle scaled = {t[0].cwiseQuotient(e), t[1].cwiseQuotient(e),
                                  t[2].cwiseQuotient(e)};
    const Real level = scenes::triangleDistance(scaled, {origin, origin, origin}) - 1;
    return level < 0 ? level * e.minCoeff() : std::numeric_limits<Real>::infinity();
  }
  return leastOver(t, [&s](const ExactPoint& p) { return pointLevel(s, p); });
}

/// Returns the point of a cylinder, cone or ellipsoid that is extreme along n.
inline ExactPoint exactSupport(const shape::Solid& s, const ExactPoint& n) {
  if (s.kind == shape::Kind::kEllipsoid) {
    const ExactPoint m = s.half.cast<Real>().cwiseProduct(n);
    return m.norm() > 0 ? ExactPoint(s.half.cast<Real>().cwiseProduct(m) / m.norm()) : m;
  }
  const Real across = std::hypot(n.x(), n.y()), h = s.half_length;
  const Real scale = across > 0 ? s.radius / across : 0;
  if (s.kind == shape::Kind::kCone) {
    if (n.z() * 2 * h > across * s.radius) return {0, 0, h};
    return {n.x() * scale, n.y() * scale, -h};
  }
  return {n.x() * scale, n.y() * scale, n.z() >= 0 ? h : -h};
}

/// Returns the distance of a triangle and a round shape that don't overlap.
inline ExactNearest roundDistance(const shape::Solid& s, const ExactTriangle& t) {
  ExactNearest best;
  const auto offer = [&](const ExactPoint& x) {
    ExactPoint q;
    const Real d = std::max(Real(0), pointLevel(s, x, &q));
    if (d < best.distance) best = {d, x, q};
  };
  for (int i = 0; i < 3; ++i) {
    const ExactPoint a = t[i], d = t[(i + 1) % 3] - a;
    const auto at = [&](Real u) { return ExactPoint(a + u * d); };
    offer(at(leastAt([&](Real u) { return pointLevel(s, at(u)); }, 110)));
  }
  const ExactPoint u = t[1] - t[0], v0 = t[2] - t[0];
  const Real uu = u.squaredNorm();
  if (!(uu > 0)) return best;
  ExactPoint v = v0 - u.dot(v0) / uu * u;
  v -= u.dot(v) / uu * u;
  const Real vv = v.squaredNorm();
  if (!(vv > 1e-34L * uu)) return best;
  const ExactPoint n = (u / std::sqrt(uu)).cross(v / std::sqrt(vv));
  for (const int side : {-1, 1}) {
    const ExactPoint q = exactSupport(s, side * n) - t[0];
    const Real b = q.dot(v) / vv, a = (q.dot(u) - b * u.dot(v0)) / uu;
    if (a >= 0 && b >= 0 && a + b <= 1) offer(t[0] + a * u + b * v0);
  }
  return best;
}

/// Holds the largest height of a point above a box's or hull's faces: negative inside.
class FaceLevel {
 public:
  FaceLevel(const shape::Solid& s, const std::vector<ExactTriangle>& faces) {
    if (s.kind == shape::Kind::kBox) {
      for (int axis = 0; axis < 3; ++axis) {
        const ExactPoint n = ExactPoint::Unit(axis);
        planes_.push_back({n, s.half[axis]});
        planes_.push_back({-n, s.half[axis]});
      }
      thickness_ = s.half.minCoeff() / s.reach();
      return;
    }
    ExactPoint middle = ExactPoint::Zero();
    for (const shape::Vec& p : s.points) middle += p.cast<Real>() / Real(s.points.size());
    for (const ExactTriangle& face : faces) {
      ExactPoint n = (face[1] - face[0]).cross(face[2] - face[0]);
      const Real length = n.norm();
      // Corners of flat shapes are rounded, and the normals of some faces nothing else.
      const bool face_has_normal = length > 1e-14L * s.reach() * s.reach();
      if (!face_has_normal) n.setZero();
      if (face_has_normal) n *= (n.dot(middle - face[0]) > 0 ? -1 : 1) / length;
      planes_.push_back({n, n.dot(face[0])});
    }
    thickness_ = planes_.size() < 4 ? 0 : std::max(Real(0), -(*this)(middle)) / s.reach();
  }
  /// Is the solid's, as a part of its reach. Where faces are thin, their normals, and levels, are
  /// uncertain by 1e-19 over that.
  Real thickness() const { return thickness_; }

  Real operator()(const ExactPoint& p) const {
    Real most = -std::numeric_limits<Real>::infinity();
    for (const Plane& plane : planes_) most = std::max(most, plane.normal.dot(p) - plane.offset);
    return most;
  }

 private:
  struct Plane {
    ExactPoint normal;
    Real offset;
  };
  std::vector<Plane> planes_;
  Real thickness_;
};

/// Returns the distance of a triangle and a face, both held by doubles. Their meeting is decided
/// exactly, as long double can't for thin ones.
inline Real faceDistance(const shape::Triangle& t, const ExactTriangle& face) {
  const shape::Triangle f = {face[0].cast<double>(), face[1].cast<double>(),
                             face[2].cast<double>()};
  if (trianglesIntersect(t, f)) return 0;
  const Real d = scenes::triangleDistance(exact(t), face);
  return d > 0 ? d : Real(triangleDistance(t, f).distance);
}

/// Returns nearest points of a triangle and a round solid; for others the distance to the core's
/// surface.
inline ExactNearest coreNearest(const shape::Solid& s, const shape::Triangle& triangle,
                                const std::vector<ExactTriangle>& faces) {
  if (faces.empty()) return roundDistance(s, exact(triangle));
  ExactNearest best;
  for (const ExactTriangle& face : faces) {
    best.distance = std::min(best.distance, faceDistance(triangle, face));
  }
  return best;
}

}  // namespace kios::testing
