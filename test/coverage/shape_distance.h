// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenes/oracle.h"

// Distance of a triangle to each of FCL's nine convex shapes, with nothing of FCL or of the
// library: the distance of a point to a convex set is convex, so nested golden sections over the
// triangle find the least, and closed forms in the shape's frame give the distance of each point.

namespace kios::coverage {

using fcl::Vector3d;
/// Distance of a point to a shape in the shape's frame, 0 inside.
using PointDistance = std::function<double(const Vector3d&)>;

template <typename S>
struct ShapeCase {
  std::shared_ptr<fcl::CollisionGeometry<S>> geometry;
  PointDistance distance;
  double tolerance;  ///< of the oracle itself, above rounding
};

// Distance in the half plane of radius r >= 0 and height z to a convex polygon, given in
// counter-clockwise order.
inline double polygonDistance(double r, double z,
                              const std::vector<std::array<double, 2>>& corners) {
  bool inside = true;
  double best = 1e300;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[(i + 1) % corners.size()];
    const double dx = bx - ax, dy = by - ay;
    if (dx * (z - ay) - dy * (r - ax) < 0) inside = false;
    const double t = std::clamp(((r - ax) * dx + (z - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    best = std::min(best, std::hypot(r - ax - t * dx, z - ay - t * dy));
  }
  return inside ? 0 : best;
}

// Root of the secular equation by bisection (Eberly).
inline double ellipsoidDistance(const Vector3d& p, const Vector3d& radii) {
  if (p.cwiseQuotient(radii).squaredNorm() <= 1) return 0;
  const auto level = [&](double t) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = radii[i] * p[i] / (t + radii[i] * radii[i]);
      sum += x * x;
    }
    return sum - 1;
  };
  double low = 0, high = radii.maxCoeff() * p.norm() + 1;
  for (int i = 0; i < 90; ++i) (level(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  Vector3d q;
  for (int i = 0; i < 3; ++i) q[i] = radii[i] * radii[i] * p[i] / (low + radii[i] * radii[i]);
  return (p - q).norm();
}

/// Least of a convex function on [0, 1].
template <typename F>
double goldenLeast(const F& f) {
  constexpr double kRatio = 0.6180339887498949;
  double a = 0, b = 1, x = b - kRatio, y = kRatio, fx = f(x), fy = f(y);
  double best = std::min({f(0.0), f(1.0), fx, fy});
  for (int i = 0; i < 56 && best > 0; ++i) {
    if (fx < fy) {
      b = y, y = x, fy = fx, x = b - kRatio * (b - a), fx = f(x);
      best = std::min(best, fx);
    } else {
      a = x, x = y, fx = fy, y = a + kRatio * (b - a), fy = f(y);
      best = std::min(best, fy);
    }
  }
  return best;
}

/// Distance of a triangle, in the shape's frame; `enough`: a value above this need not be exact.
inline double triangleShapeDistance(const std::array<Vector3d, 3>& t, const PointDistance& distance,
                                    double enough) {
  const Vector3d centre = (t[0] + t[1] + t[2]) / 3;
  double radius = 0;
  for (const Vector3d& p : t) radius = std::max(radius, (p - centre).norm());
  const double from_centre = distance(centre);
  if (from_centre == 0) return 0;
  if (from_centre - radius > enough) return from_centre - radius;
  return goldenLeast([&](double u) {
    const Vector3d left = t[0] + u * (t[1] - t[0]), right = t[0] + u * (t[2] - t[0]);
    return goldenLeast([&](double v) { return distance(left + v * (right - left)); });
  });
}

/// FCL's nine shapes, with sizes that floats hold.
template <typename S>
std::map<std::string, ShapeCase<S>> shapeCases() {
  std::map<std::string, ShapeCase<S>> cases;
  const auto add = [&](const char* name, auto geometry, PointDistance distance, double off = 0) {
    cases[name] = {geometry, std::move(distance), off};
  };
  add("box", std::make_shared<fcl::Box<S>>(S(1), S(0.75), S(0.5)), [](const Vector3d& p) {
    return (p.cwiseAbs() - Vector3d(0.5, 0.375, 0.25)).cwiseMax(0.0).norm();
  });
  add("sphere", std::make_shared<fcl::Sphere<S>>(S(0.5)),
      [](const Vector3d& p) { return std::max(0.0, p.norm() - 0.5); });
  add("ellipsoid", std::make_shared<fcl::Ellipsoid<S>>(S(0.75), S(0.5), S(0.25)),
      [](const Vector3d& p) { return ellipsoidDistance(p, Vector3d(0.75, 0.5, 0.25)); });
  add("capsule", std::make_shared<fcl::Capsule<S>>(S(0.25), S(1)), [](const Vector3d& p) {
    const double z = p[2] - std::clamp(p[2], -0.5, 0.5);
    return std::max(0.0, Vector3d(p[0], p[1], z).norm() - 0.25);
  });
  add("cone", std::make_shared<fcl::Cone<S>>(S(0.5), S(1)), [](const Vector3d& p) {
    return polygonDistance(std::hypot(p[0], p[1]), p[2], {{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}});
  });
  add("cylinder", std::make_shared<fcl::Cylinder<S>>(S(0.5), S(1)), [](const Vector3d& p) {
    return polygonDistance(std::hypot(p[0], p[1]), p[2],
                           {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}});
  });
  add("plane", std::make_shared<fcl::Plane<S>>(fcl::Vector3<S>::UnitZ(), S(0.25)),
      [](const Vector3d& p) { return std::abs(p[2] - 0.25); });
  add("halfspace", std::make_shared<fcl::Halfspace<S>>(fcl::Vector3<S>::UnitZ(), S(0.25)),
      [](const Vector3d& p) { return std::max(0.0, p[2] - 0.25); });

  // An octahedron |x| / 0.5 + |y| / 1 + |z| / 0.5 <= 1.
  const auto corners = std::make_shared<std::vector<fcl::Vector3<S>>>();
  for (const double s : {1.0, -1.0}) {
    corners->emplace_back(S(0.5 * s), S(0), S(0));
    corners->emplace_back(S(0), S(s), S(0));
    corners->emplace_back(S(0), S(0), S(0.5 * s));
  }
  const auto faces = std::make_shared<std::vector<int>>();
  for (const std::array<int, 3>& f : {std::array{0, 1, 2},
                                      {1, 3, 2},
                                      {3, 4, 2},
                                      {4, 0, 2},
                                      {1, 0, 5},
                                      {3, 1, 5},
                                      {4, 3, 5},
                                      {0, 4, 5}}) {
    faces->insert(faces->end(), {3, f[0], f[1], f[2]});
  }
  add("convex", std::make_shared<fcl::Convex<S>>(corners, 8, faces), [](const Vector3d& q) {
    const Vector3d p = q.cwiseAbs(), n(2, 1, 2);  // symmetric: one octant will do
    if (n.dot(p) <= 1) return 0.0;
    const scenes::ExactPoint point = p.cast<long double>();
    const scenes::ExactTriangle face{scenes::ExactPoint(0.5L, 0, 0), scenes::ExactPoint(0, 1, 0),
                                     scenes::ExactPoint(0, 0, 0.5L)};
    return static_cast<double>(scenes::triangleDistance(face, {point, point, point}));
  });
  return cases;
}

}  // namespace kios::coverage
