// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
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
#include "shape/golden_section.h"

// FCL's nine shapes and an oracle for them in long double that shares no code with the library:
// closed forms for points, and golden-section search over the triangle.

namespace kios::testing {

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

/// Returns the distance to a convex set in the (rho, z) half-plane: the cone's triangle.
inline Real segmentDistance(Real x, Real y, Real ax, Real ay, Real bx, Real by) {
  const Real dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
  Real t = squared > 0 ? ((x - ax) * dx + (y - ay) * dy) / squared : 0;
  t = std::clamp(t, Real(0), Real(1));
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

inline Real ellipsoidDistance(const ExactPoint& e, const ExactPoint& p) {
  Real low = 0, high = e.cwiseProduct(p).norm();  // of t in x_i = e_i^2 p_i / (e_i^2 + t)
  const auto x = [&](Real t) {
    return ExactPoint(e.array().square() * p.array() / (e.array().square() + t));
  };
  for (int i = 0; i < 75; ++i) {
    const Real t = (low + high) / 2;
    (x(t).cwiseQuotient(e).squaredNorm() > 1 ? low : high) = t;
  }
  return (p - x(high)).norm();
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
      return level <= 0 || !distance ? level * v.minCoeff() : ellipsoidDistance(v, p);
    }
    case Shape::kCapsule:
      return std::hypot(rho, std::max(std::abs(p.z()) - h, Real(0))) - v[0];
    case Shape::kCylinder: {
      const Real a = rho - v[0], b = std::abs(p.z()) - h;
      return std::max(a, b) <= 0 || !distance
                 ? std::max(a, b)
                 : std::hypot(std::max(a, Real(0)), std::max(b, Real(0)));
    }
    case Shape::kCone: {
      const Real slant = (2 * h * (rho - v[0]) + v[0] * (p.z() + h)) / std::hypot(2 * h, v[0]);
      const Real inside = std::max(-h - p.z(), slant);
      if (inside <= 0 || !distance) return inside;
      return std::min(segmentDistance(rho, p.z(), 0, -h, v[0], -h),
                      segmentDistance(rho, p.z(), v[0], -h, 0, h));
    }
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
