// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/solid.h"

#include <algorithm>
#include <cmath>

#include "shape/gjk.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

double radial(const Vec& p) { return std::sqrt(p.x() * p.x() + p.y() * p.y()); }

/// Distance to a product of two convex sets from the signed distances to both.
double productDistance(double u, double v) {
  if (u <= 0 || v <= 0) return std::max(u, v);
  return std::sqrt(u * u + v * v);
}

/// The cone is the triangle (0, -h), (r, -h), (0, h) of the half-plane (rho, z), turned. A
/// segment has no side that ends at the apex, a disk none that ends at the rim.
double conePoint(const Solid& s, const Vec& p) {
  const double h = s.half_length, r = s.radius, rho = radial(p), z = p.z();
  const double base = -h - z;
  const double length = std::sqrt(4 * h * h + r * r);
  if (!(length > 0)) return std::sqrt(rho * rho + z * z);
  const double slant = (2 * h * (rho - r) + r * (z + h)) / length;
  if (base <= 0 && slant <= 0 && z <= h && rho <= r) return std::max(base, slant);
  const double to_base = std::hypot(std::max(rho - r, 0.0), base);
  const double t = std::clamp((2 * h * (z + h) - r * (rho - r)) / (length * length), 0.0, 1.0);
  const double to_slant = std::hypot(rho - (1 - t) * r, z + h - 2 * h * t);
  return std::min(to_base, to_slant);
}

/// n p - h(n) bounds the distance from below for every unit n. The nearest point x has the normal
/// p_i / (e_i^2 + t) for one t > 0; a few Newton steps towards it, from below, give good normals.
double ellipsoidBound(const Solid& s, const Vec& p) {
  const Vec& e = s.half;
  const double e_max = e.maxCoeff();
  double best = p.norm() - e_max;
  const Vec e2 = e.cwiseProduct(e), ep = e.cwiseProduct(p);
  double t = std::max(0.0, ep.norm() - e_max * e_max);
  if (!(e2.minCoeff() + t > 0)) return best;  // flat, and p not clearly outside
  for (int step = 0; step < 3; ++step) {
    const Vec n = p.array() / (e2.array() + t);
    const double length = n.norm();
    if (!(length > 0 && length < kInfinity)) break;
    const double bound = (n.dot(p) - e.cwiseProduct(n).norm()) / length;
    if (bound > best) best = bound;
    const Vec x = e.cwiseProduct(n);  // F(t) = |x|^2 - 1 falls and is convex
    const double slope = -2 * (x.array().square() / (e2.array() + t)).sum();
    if (!(slope < 0)) break;
    const double next = t - (x.squaredNorm() - 1) / slope;
    if (!(next > t)) break;
    t = next;
  }
  return best;
}

/// Calls visit(xy, zx, yz) for two points at a time, whose six coordinates lie one after another;
/// an odd last one is there twice.
template <typename Visit>
void visitTwos(const std::vector<Vec>& points, const Visit& visit) {
  using lanes::Double2;
  const auto visitAt = [&](const double* p) {
    visit(lanes::load(p), lanes::load(p + 2), lanes::load(p + 4));
  };
  const std::size_t even = points.size() / 2 * 2;
  for (std::size_t i = 0; i < even; i += 2) visitAt(points[i].data());
  if (even == points.size()) return;
  const Vec last[2] = {points.back(), points.back()};
  visitAt(last[0].data());
}

/// The first of the points that lie farthest along n. Two at a time, as visitTwos().
const Vec& farthestAlong(const std::vector<Vec>& points, const Vec& n) {
  using lanes::Double2;
  const Double2 xy = {n.x(), n.y()}, zx = {n.z(), n.x()}, yz = {n.y(), n.z()};
  constexpr std::size_t kBlock = 64;
  double heights[kBlock];
  const Vec* best = points.data();
  double most = -kInfinity;
  for (std::size_t from = 0; from < points.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - from);
    const Vec* const block = points.data() + from;
    Double2 highest = {most, most};
    const auto takeTwo = [&](std::size_t i) {
      const double* const p = block[i].data();
      const Double2 a = lanes::load(p) * xy, b = lanes::load(p + 2) * zx,
                    c = lanes::load(p + 4) * yz;
      const Double2 height = Double2{a[0], b[1]} + Double2{a[1], c[0]} + Double2{b[0], c[1]};
      lanes::store(heights + i, height);
      highest = lanes::max(height, highest);
    };
    std::size_t i = 0;
    for (; i + 3 < count; i += 4) {
      takeTwo(i);
      takeTwo(i + 2);
    }
    if (i + 1 < count) {
      takeTwo(i);
      i += 2;
    }
    if (i < count) {
      heights[i] = n.dot(block[i]);
      highest[0] = std::max(highest[0], heights[i]);
    }
    const double here = std::max(highest[0], highest[1]);
    if (!(here > most)) continue;
    most = here;
    i = 0;
    while (i + 2 < count && heights[i] < most && heights[i + 1] < most) i += 2;
    best = block + (i + 1 < count && heights[i] < most ? i + 1 : i);
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
      using lanes::Double2;
      Double2 squared = {0, 0};
      visitTwos(points, [&](Double2 xy, Double2 zx, Double2 yz) {
        const Double2 a = xy * xy, b = zx * zx, c = yz * yz;
        squared = lanes::max(Double2{a[0] + a[1] + b[0], b[1] + c[0] + c[1]}, squared);
      });
      return std::sqrt(std::max(squared[0], squared[1]));
    }
    default:
      return std::abs(offset);
  }
}

Range rangeOf(const std::vector<Vec>& points) {
  using lanes::Double2;
  const Vec& first = points[0];
  const Double2 start[3] = {{first.x(), first.y()}, {first.z(), first.x()}, {first.y(), first.z()}};
  Double2 low[3] = {start[0], start[1], start[2]}, high[3] = {start[0], start[1], start[2]};
  visitTwos(points, [&](Double2 xy, Double2 zx, Double2 yz) {
    const Double2 two[3] = {xy, zx, yz};
    for (int i = 0; i < 3; ++i) {
      low[i] = lanes::min(two[i], low[i]);
      high[i] = lanes::max(two[i], high[i]);
    }
  });
  return {{std::min(low[0][0], low[1][1]), std::min(low[0][1], low[2][0]),
           std::min(low[1][0], low[2][1])},
          {std::max(high[0][0], high[1][1]), std::max(high[0][1], high[2][0]),
           std::max(high[1][0], high[2][1])}};
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
    case Kind::kConvex:
      return rangeOf(s.points);
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
  switch (s.kind) {
    case Kind::kSphere:
      return p.norm() - s.radius;
    case Kind::kCapsule: {
      const double z = std::max(std::abs(p.z()) - s.half_length, 0.0);
      return std::sqrt(p.x() * p.x() + p.y() * p.y() + z * z) - s.radius;
    }
    case Kind::kBox: {
      const Vec q = p.cwiseAbs() - s.half;
      const double inside = q.maxCoeff();
      return inside <= 0 ? inside : q.cwiseMax(0.0).norm();
    }
    case Kind::kEllipsoid:
      return ellipsoidBound(s, p);
    case Kind::kCylinder:
      return productDistance(radial(p) - s.radius, std::abs(p.z()) - s.half_length);
    case Kind::kCone:
      return conePoint(s, p);
    case Kind::kConvex: {
      constexpr int kSteps = 4;
      return gjkDistance(s, &p, 1, kInfinity, kSteps).lower;
    }
    case Kind::kHalfspace:
      return s.normal.dot(p) - s.offset;
    default:
      return std::abs(s.normal.dot(p) - s.offset);
  }
}

}  // namespace kios::shape
