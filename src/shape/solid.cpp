// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/solid.h"

#include <algorithm>
#include <cmath>

#include "shape/gjk.h"
#include "shape/nearest_point.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

double radial(const Vec& p) { return std::sqrt(p.x() * p.x() + p.y() * p.y()); }

/// The first of the points that lie farthest along n.
const Vec& farthestAlong(const std::vector<Vec>& points, const Vec& n) {
  const Vec* best = points.data();
  double most = -kInfinity;
  for (const Vec& p : points) {
    const double height = p.x() * n.x() + p.y() * n.y() + p.z() * n.z();
    if (!(height > most)) continue;
    most = height;
    best = &p;
  }
  return *best;
}

}  // namespace

double Solid::reach() const {
  switch (kind) {
    case Kind::kSphere:
      return radius;
    case Kind::kCapsule:
      return radius + half_length;
    case Kind::kBox:
      return half.norm();
    case Kind::kEllipsoid:
      return half.maxCoeff();
    case Kind::kCylinder:
    case Kind::kCone:
      return std::sqrt(radius * radius + half_length * half_length);
    case Kind::kConvex: {
      double square = 0;
      for (const Vec& p : points) square = std::max(square, p.squaredNorm());
      return std::sqrt(square);
    }
    default:
      return std::abs(offset);
  }
}

Range rangeOf(const Solid& s) {
  Vec half = s.half;
  switch (s.kind) {
    case Kind::kSphere:
      half.setZero();
      break;
    case Kind::kCapsule:
      half = {0, 0, s.half_length};
      break;
    case Kind::kCylinder:
    case Kind::kCone:
      half = {s.radius, s.radius, s.half_length};
      break;
    case Kind::kConvex: {
      Range range = {s.points[0], s.points[0]};
      for (const Vec& p : s.points) {
        range.low = range.low.cwiseMin(p);
        range.high = range.high.cwiseMax(p);
      }
      return range;
    }
    default:
      break;
  }
  return {-half, half};
}

void makeRows(Solid& s) {
  constexpr std::size_t kFew = 16;
  if (s.kind == Kind::kConvex && s.points.size() > kFew) s.rows = PointRows(s.points);
}

Vec coreSupport(const Solid& s, const Vec& n) {
  switch (s.kind) {
    case Kind::kCapsule:
      return {0, 0, n.z() >= 0 ? s.half_length : -s.half_length};
    case Kind::kBox:
      return {n.x() >= 0 ? s.half.x() : -s.half.x(), n.y() >= 0 ? s.half.y() : -s.half.y(),
              n.z() >= 0 ? s.half.z() : -s.half.z()};
    case Kind::kEllipsoid: {
      const Vec m = s.half.cwiseProduct(n);
      const double length = m.norm();
      if (!(length > 0)) return Vec::Zero();
      return s.half.cwiseProduct(m) / length;
    }
    case Kind::kCylinder: {
      const double across = radial(n), scale = across > 0 ? s.radius / across : 0.0;
      return {n.x() * scale, n.y() * scale, n.z() >= 0 ? s.half_length : -s.half_length};
    }
    case Kind::kCone: {
      const double across = radial(n), scale = across > 0 ? s.radius / across : 0.0;
      if (n.z() * 2 * s.half_length > across * s.radius) return {0, 0, s.half_length};
      return {n.x() * scale, n.y() * scale, -s.half_length};
    }
    case Kind::kConvex:
      return s.rows.empty() ? farthestAlong(s.points, n) : s.points[s.rows.farthestAlong(n)];
    default:
      return Vec::Zero();
  }
}

double extentAlong(const Solid& s, const Vec& n) {
  switch (s.kind) {
    case Kind::kSphere:
      return s.radius;
    case Kind::kCapsule:
      return s.half_length * std::abs(n.z()) + s.radius;
    case Kind::kBox:
      return s.half.dot(n.cwiseAbs());
    case Kind::kEllipsoid:
      return s.half.cwiseProduct(n).norm();
    case Kind::kCylinder:
      return s.radius * radial(n) + s.half_length * std::abs(n.z());
    case Kind::kCone:
      return std::max(s.half_length * n.z(), s.radius * radial(n) - s.half_length * n.z());
    case Kind::kConvex:
      return n.dot(coreSupport(s, n));
    default:
      break;
  }
  const bool along = (n - s.normal).isZero(0), against = (n + s.normal).isZero(0);
  if (along) return s.offset;
  return against && s.kind == Kind::kPlane ? -s.offset : kInfinity;
}

double pointBound(const Solid& s, const Vec& p) {
  if (!s.bounded()) {
    const double height = s.normal.dot(p) - s.offset;
    return s.kind == Kind::kPlane ? std::abs(height) : height;
  }
  constexpr int kSteps = 4;
  if (s.kind == Kind::kConvex) return gjkDistance(s, &p, 1, kInfinity, kSteps).lower;
  const NearestPoint q = nearestPoint(s, p);
  return q.distance > 0 ? q.distance - s.margin() : q.normal.dot(p) - extentAlong(s, q.normal);
}

}  // namespace kios::shape
