// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include "scenes/random.h"
#include "scenes/shape_geometry.h"
#include "scenes/shapes.h"
#include "scenes/triangle_oracle.h"

// FCL's nine shapes and an oracle for them in long double that shares no code with the library:
// closed forms for points, and golden-section search over the triangle.

namespace kios::testing {

using Real = long double;
using scenes::ExactPoint;
using scenes::ExactTriangle;

enum class Shape {
  kBox,
  kSphere,
  kEllipsoid,
  kCapsule,
  kCone,
  kCylinder,
  kConvex,
  kHalfspace,
  kPlane
};
inline constexpr Shape kShapes[] = {Shape::kBox,     Shape::kSphere,    Shape::kEllipsoid,
                                    Shape::kCapsule, Shape::kCone,      Shape::kCylinder,
                                    Shape::kConvex,  Shape::kHalfspace, Shape::kPlane};

inline const char* nameOf(Shape shape) {
  constexpr const char* kNames[] = {"box",      "sphere", "ellipsoid", "capsule", "cone",
                                    "cylinder", "convex", "halfspace", "plane"};
  return kNames[static_cast<int>(shape)];
}

struct NameOfShape {
  template <typename Info>
  std::string operator()(const Info& info) const {
    return nameOf(info.param);
  }
};

/// Holds sizes by kind: box sides, ellipsoid radii, (radius, length), normal and offset. Those of
/// half spaces and planes aside, all are floats.
struct ShapeSpec {
  Shape kind;
  fcl::Vector3d size;
  double offset = 0;
  scenes::Mesh hull;
};

/// Returns sizes in about [0.2, 1] times `scale` (a power of two), thin ones among them.
inline ShapeSpec randomShape(Shape kind, scenes::Random& random, double scale = 1) {
  const auto length = [&] {
    return scale * float(random.unit() < 0.2 ? random.uniform(0.01, 0.1) : random.uniform(0.2, 1));
  };
  ShapeSpec spec{kind, {length(), length(), length()}, 0, {}};
  if (kind == Shape::kHalfspace || kind == Shape::kPlane) {
    spec.size = fcl::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1));
    spec.size.normalize();
    spec.offset = scale * float(random.uniform(-0.5, 0.5));
  }
  if (kind == Shape::kConvex) {
    spec.hull = scenes::icosphere(1, random.unit() < 0.7 ? 0 : 1);
    for (auto& p : spec.hull.vertices) {
      p = p.cwiseProduct(spec.size).cast<float>().cast<double>();
    }
  }
  return spec;
}

template <typename S>
std::shared_ptr<fcl::CollisionGeometry<S>> makeShape(const ShapeSpec& spec) {
  const fcl::Vector3<S> v = spec.size.cast<S>();
  switch (spec.kind) {
    case Shape::kBox:
      return std::make_shared<fcl::Box<S>>(v);
    case Shape::kSphere:
      return std::make_shared<fcl::Sphere<S>>(v[0]);
    case Shape::kEllipsoid:
      return std::make_shared<fcl::Ellipsoid<S>>(v);
    case Shape::kCapsule:
      return std::make_shared<fcl::Capsule<S>>(v[0], v[1]);
    case Shape::kCone:
      return std::make_shared<fcl::Cone<S>>(v[0], v[1]);
    case Shape::kCylinder:
      return std::make_shared<fcl::Cylinder<S>>(v[0], v[1]);
    case Shape::kHalfspace:
      return std::make_shared<fcl::Halfspace<S>>(v, S(spec.offset));
    case Shape::kPlane:
      return std::make_shared<fcl::Plane<S>>(v, S(spec.offset));
    default:
      return scenes::convexOf<S>(spec.hull);
  }
}

/// Golden section for the least value of a convex function on [0, 1]; returns where.
template <typename F>
Real leastAt(const F& f, int steps) {
  const Real phi = (std::sqrt(Real(5)) - 1) / 2;
  Real low = 0, high = 1, a = high - phi, b = low + phi, fa = f(a), fb = f(b);
  Real at = fa <= fb ? a : b, least = std::min(fa, fb);
  const auto note = [&](Real x, Real value) {
    if (value < least) {
      least = value;
      at = x;
    }
  };
  note(0, f(0));
  note(1, f(1));
  for (int i = 0; i < steps; ++i) {
    if (fa <= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - phi * (high - low);
      fa = f(a);
      note(a, fa);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + phi * (high - low);
      fb = f(b);
      note(b, fb);
    }
  }
  return at;
}

/// Returns the least value of a convex function of points over a triangle.
template <typename F>
Real leastOver(const ExactTriangle& t, const F& f) {
  constexpr int kSteps = 64;
  const auto inner = [&](Real u) {
    const ExactPoint from = t[0] + u * (t[1] - t[0]), to = t[0] + u * (t[2] - t[0]);
    const auto at = [&](Real w) { return f(ExactPoint(from + w * (to - from))); };
    return at(leastAt(at, kSteps));
  };
  return inner(leastAt(inner, kSteps));
}

/// Returns the nearest point of an ellipsoid, some of whose radii may be 0, to one that isn't in
/// it.
inline ExactPoint nearestOfEllipsoid(const ExactPoint& e, const ExactPoint& p) {
  const auto inUnits = [&](Real t) {  // x_i = e_i^2 p_i / (e_i^2 + t)
    ExactPoint q = ExactPoint::Zero();
    for (int c = 0; c < 3; ++c) {
      if (e[c] > 0) q[c] = e[c] * p[c] / (e[c] * e[c] + t);
    }
    return q;
  };
  Real low = 0, high = e.cwiseProduct(p).norm();
  for (int i = 0; i < 110; ++i) {
    const Real t = (low + high) / 2;
    (inUnits(t).squaredNorm() > 1 ? low : high) = t;
  }
  return e.cwiseProduct(inUnits(high));
}

/// Returns the distance of a cylinder or cone of radius r and half length h; negative inside, where
/// it is -(the depth at most).
inline Real turnedLevel(Real r, Real h, bool cone, const ExactPoint& p,
                        ExactPoint* nearest = nullptr) {
  const Real rho = std::hypot(p.x(), p.y()), z = p.z();
  const Real side =
      !cone || h == 0 ? rho - r : (2 * h * (rho - r) + r * (z + h)) / std::hypot(2 * h, r);
  const Real inside = std::max({side, -h - z, z - h});
  if (inside <= 0) {
    if (nearest) *nearest = p;
    return inside;
  }
  // In the half-plane (rho, z): a convex polygon, its sides from the axis out.
  const Real corners[4][2] = {{0, -h}, {r, -h}, {cone ? 0 : r, h}, {0, h}};
  Real best = std::numeric_limits<Real>::infinity(), at[2] = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const Real *a = corners[i], *b = corners[i + 1];
    const Real dx = b[0] - a[0], dz = b[1] - a[1], square = dx * dx + dz * dz;
    Real t = square > 0 ? ((rho - a[0]) * dx + (z - a[1]) * dz) / square : 0;
    t = std::clamp(t, Real(0), Real(1));
    const Real x = a[0] + t * dx, y = a[1] + t * dz;
    const Real d = (rho - x) * (rho - x) + (z - y) * (z - y);
    if (d < best) {
      best = d;
      at[0] = x;
      at[1] = y;
    }
  }
  if (nearest) {
    const Real scale = rho > 0 ? at[0] / rho : 0;
    *nearest =
        rho > 0 ? ExactPoint(scale * p.x(), scale * p.y(), at[1]) : ExactPoint(at[0], 0, at[1]);
  }
  return std::sqrt(best);
}

inline ExactTriangle exactCorners(const scenes::Mesh& mesh, const fcl::Triangle& t) {
  return {mesh.vertices[t[0]].cast<Real>(), mesh.vertices[t[1]].cast<Real>(),
          mesh.vertices[t[2]].cast<Real>()};
}

/// Convex in p, <= 0 on the shape, > 0 outside; there `distance` is the distance.
inline Real level(const ShapeSpec& s, const ExactPoint& p, bool distance) {
  const ExactPoint v = s.size.cast<Real>();
  const Real rho = std::hypot(p.x(), p.y()), h = v[1] / 2;
  switch (s.kind) {
    case Shape::kBox: {
      const ExactPoint q = p.cwiseAbs() - v / 2;
      return q.maxCoeff() <= 0 || !distance ? q.maxCoeff() : q.cwiseMax(Real(0)).norm();
    }
    case Shape::kSphere:
      return p.norm() - v[0];
    case Shape::kEllipsoid: {
      const Real level = p.cwiseQuotient(v).norm() - 1;
      return level <= 0 || !distance ? level * v.minCoeff() : (p - nearestOfEllipsoid(v, p)).norm();
    }
    case Shape::kCapsule:
      return std::hypot(rho, std::max(std::abs(p.z()) - h, Real(0))) - v[0];
    case Shape::kCylinder:
    case Shape::kCone:
      return turnedLevel(v[0], h, s.kind == Shape::kCone, p);
    case Shape::kConvex: {
      Real inside = -1e30L, outside = 1e30L;
      for (const auto& t : s.hull.triangles) {
        const ExactTriangle face = exactCorners(s.hull, t);
        const ExactPoint a = face[1] - face[0], b = face[2] - face[0];
        ExactPoint n(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                     a.x() * b.y() - a.y() * b.x());
        n /= n.norm();
        const Real height = n.dot(p - face[0]);
        inside = std::max(inside, height);
        if (distance && height > 0) {
          outside = std::min(outside, scenes::triangleDistance(face, {p, p, p}));
        }
      }
      return inside <= 0 || !distance ? inside : outside;
    }
    default:
      return v.dot(p) - s.offset;
  }
}

/// Returns the least level (or distance) over a triangle in the shape's frame. Error: about 1e-16
/// of the extent.
inline Real leastLevel(const ShapeSpec& s, const ExactTriangle& t, bool distance) {
  if (s.kind == Shape::kHalfspace || s.kind == Shape::kPlane) {
    const Real a = level(s, t[0], true), b = level(s, t[1], true), c = level(s, t[2], true);
    const Real low = std::min({a, b, c}), high = std::max({a, b, c});
    return s.kind == Shape::kHalfspace ? low : std::max(low, -high);
  }
  return leastOver(t, [&](const ExactPoint& p) { return level(s, p, distance); });
}

/// Returns the distance of the triangle and the full shape, 0 at overlap.
inline Real oracleDistance(const ShapeSpec& s, const ExactTriangle& t) {
  if (s.kind == Shape::kConvex) {  // that of its faces, unless a corner is inside
    Real least = std::max(Real(0), level(s, t[0], true));
    for (const auto& face : s.hull.triangles) {
      least = std::min(least, scenes::triangleDistance(t, exactCorners(s.hull, face)));
    }
    return least;
  }
  return std::max(Real(0), leastLevel(s, t, true));
}

}  // namespace kios::testing
