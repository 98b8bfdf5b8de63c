// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/nearest_point.h"

#include <algorithm>
#include <cmath>

#include "triangle/twofold.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

double length2(double x, double y) { return std::sqrt(x * x + y * y); }

/// In the half-plane (rho, z) of a turned solid: the nearest point and the unit normal.
struct Profile {
  double rho, z, normal_rho, normal_z;
};

Profile profileTo(double rho, double z, double at_rho, double at_z) {
  const double d_rho = rho - at_rho, d_z = z - at_z, d = length2(d_rho, d_z);
  if (!(d > 0)) return {at_rho, at_z, 1, 0};
  return {at_rho, at_z, d_rho / d, d_z / d};
}

Profile cylinderProfile(const Solid& s, double rho, double z) {
  const double h = s.half_length, side = z < 0 ? -1.0 : 1.0;
  const double out = rho - s.radius, up = side * z - h;
  if (out > 0 && up > 0) return profileTo(rho, z, s.radius, side * h);
  if (out >= up) return {s.radius, z, 1, 0};
  return {rho, side * h, 0, side};
}

Profile coneProfile(const Solid& s, double rho, double z) {
  const double h = s.half_length, r = s.radius, slant = length2(2 * h, r);
  if (!(slant > 0)) return profileTo(rho, z, 0, 0);
  const double n_rho = 2 * h / slant, n_z = r / slant;             // of the slanted side
  const double along = ((r - rho) * r + (z + h) * 2 * h) / slant;  // from the rim to the apex
  const double above = n_rho * (rho - r) + n_z * (z + h), below = -h - z;
  if (rho <= r && (below >= 0 || below >= above)) return {rho, -h, 0, -1};
  if (along <= 0) return profileTo(rho, z, r, -h);
  if (along >= slant) return profileTo(rho, z, 0, h);
  return {r - along * r / slant, -h + along * 2 * h / slant, n_rho, n_z};
}

NearestPoint turned(const Solid& s, const Vec& p) {
  const double rho = length2(p.x(), p.y());
  const double ux = rho > 0 ? p.x() / rho : 1.0, uy = rho > 0 ? p.y() / rho : 0.0;
  const Profile q =
      s.kind == Kind::kCylinder ? cylinderProfile(s, rho, p.z()) : coneProfile(s, rho, p.z());
  NearestPoint nearest;
  nearest.on_shape = {q.rho * ux, q.rho * uy, q.z};
  nearest.normal = {q.normal_rho * ux, q.normal_rho * uy, q.normal_z};
  nearest.distance = std::max(0.0, q.normal_rho * (rho - q.rho) + q.normal_z * (p.z() - q.z));
  return nearest;
}

/// x_i = e_i^2 p_i / (e_i^2 + t), with w = x / e of length 1 for one t >= 0 outside. One coordinate
/// alone has |w_i| = 1 at most at the start, which leaves |w|^2 at most 3 however flat the
/// ellipsoid is. 1 / |w| is concave in t, by Cauchy and Schwarz, so that Newton's steps to where it
/// is 1 stay below; and nearly linear: a step of s leaves at most 1.5 s^2 / (least e^2 + t), below
/// rounding at the last. Where a radius e_i is 0, that holds of the others; t is 0 for points above
/// the inside.
NearestPoint onEllipsoid(const Solid& s, const Vec& p) {
  const Eigen::Array<bool, 3, 1> flat(isFlat(s.half, 0), isFlat(s.half, 1), isFlat(s.half, 2));
  const Vec e = flat.select(0.0, s.half), e2 = e.cwiseProduct(e), ep = e.cwiseProduct(p);
  const auto over = [&](const Vec& v, double t) -> Vec {
    return flat.select(0.0, v.array() / (e2.array() + t));
  };
  const double least = flat.select(kInfinity, e2).minCoeff();
  double t = std::max(0.0, (ep.cwiseAbs() - e2).maxCoeff());
  for (int step = 0; step < 100; ++step) {
    const Vec w = over(ep, t);
    const double square = w.squaredNorm(), fall = w.dot(over(w, t));
    if (!(fall > 0)) break;  // at the centre
    const double next = t + (std::sqrt(square) - 1) * square / fall;
    if (!(next > t)) break;
    const bool last = next - t <= 0x1p-28 * (least + t);
    t = next;
    if (last) break;
  }
  const Vec n = over(p, t), from_shape = flat.select(p, t * n);
  const double distance = from_shape.norm();
  if (distance > 0) return {distance, e2.cwiseProduct(n), from_shape / distance};
  if (flat.any()) return {0, p, flat.select(Vec::Ones(), Vec::Zero()).matrix().normalized()};
  const double length = n.norm();
  return {0, p, length > 0 ? Vec(n / length) : Vec::UnitZ()};
}

}  // namespace

Vec faceNormal(const Triangle& t) {
  Vec n;
  for (int c = 0; c < 3; ++c) {
    const int u = (c + 1) % 3, v = (c + 2) % 3;
    const auto edge = [&t](int corner, int axis) {
      return twofoldDifference(t[corner][axis], t[0][axis]);
    };
    n[c] = accurateMinor(edge(1, u), edge(1, v), edge(2, u), edge(2, v));
  }
  return n;
}

// The differences from a box are exact but for one rounding each, and so is their direction.
NearestPoint nearestPoint(const Solid& s, const Vec& p) {
  Vec q;
  switch (s.kind) {
    case Kind::kEllipsoid:
      return onEllipsoid(s, p);
    case Kind::kCylinder:
    case Kind::kCone:
      return turned(s, p);
    case Kind::kBox:
      q = p.cwiseMax(-s.half).cwiseMin(s.half);
      break;
    case Kind::kCapsule:
      q = {0, 0, std::clamp(p.z(), -s.half_length, s.half_length)};
      break;
    default:
      q.setZero();
  }
  const Vec way = p - q;
  const double distance = way.norm();
  return {distance, q, distance > 0 ? Vec(way / distance) : Vec::UnitZ()};
}

}  // namespace kios::shape
