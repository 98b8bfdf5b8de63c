// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/feature_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "volume/rounding.h"

namespace kios::engine {
namespace {

using Vec = Eigen::Vector3d;

double clamp01(double t) { return t > 0 ? std::min(t, 1.0) : 0.0; }

/// a / b, and a for b = 0, which a is then: nothing is to be trapped.
double quotient(double a, double b) { return a / (b > 0 ? b : 1.0); }

/// True if two edges that start in p and q are nearest there, by a margin that exceeds the rounding
/// of the products. The distance of two edges is convex, so that no other points can be nearer.
bool leadAway(const Vec& p, const Vec& other_p, const Vec& q, const Vec& other_q) {
  constexpr double kMargin2 = 0x1p-80;
  const Vec w = q - p, a = other_p - p, b = other_q - q;
  const double aw = a.dot(w), bw = b.dot(w), ww = kMargin2 * w.squaredNorm();
  return aw < 0 && bw > 0 && aw * aw > ww * a.squaredNorm() && bw * bw > ww * b.squaredNorm();
}

}  // namespace

// By the cross product, not by aa bb - ab^2: a parameter then errs by eps / sin. What that adds to
// the distance after the re-projections is at most eps of the extent.
FeatureDistance edgeDistance(const Vec& p0, const Vec& p1, const Vec& q0, const Vec& q1,
                             NearestEnds& ends) {
  const Vec a = p1 - p0, b = q1 - q0, t = q0 - p0;
  const double aa = a.squaredNorm(), bb = b.squaredNorm();
  const Vec n = a.cross(b);
  double s = clamp01(quotient(t.cross(b).dot(n), n.squaredNorm()));
  const double v = clamp01(quotient((s * a - t).dot(b), bb));
  // The point of q from its nearer end.
  const Vec y = v < 0.5 ? Vec(t + v * b) : Vec((q1 - p0) - (1 - v) * b);
  s = clamp01(quotient(y.dot(a), aa));
  const double extent = std::sqrt(aa) + std::sqrt(bb) + t.lpNorm<Eigen::Infinity>();
  // Nearly parallel edges may give any s and v: all ends are tried.
  const bool parallel = !(n.squaredNorm() > 0x1p-20 * aa * bb);
  for (int i = 0; i < 4; ++i) {
    const bool s_low = (i & 1) == 0, v_low = (i & 2) == 0;
    if (!parallel && (s_low != (s < 0.5) || v_low != (v < 0.5))) continue;
    const Vec &p = s_low ? p0 : p1, &q = v_low ? q0 : q1;
    if (!leadAway(p, s_low ? p1 : p0, q, v_low ? q1 : q0)) continue;
    ends = {p, q, (q - p).norm()};
    return {ends.distance, extent};
  }
  if ((s == 0 || s == 1) && (v == 0 || v == 1)) {
    return {((v == 0 ? q0 : q1) - (s == 0 ? p0 : p1)).norm(), extent};
  }
  const Vec w = s < 0.5 ? Vec(y - s * a) : Vec((y - a) + (1 - s) * a);
  return {w.norm(), extent};
}

bool nearestAt(const NearestEnds& ends, const Vec& p0, const Vec& p1, const Vec& q0,
               const Vec& q1) {
  const auto& [p, q, distance] = ends;
  if ((p0 != p && p1 != p) || (q0 != q && q1 != q)) return false;
  return leadAway(p, p0 == p ? p1 : p0, q, q0 == q ? q1 : q0);
}

FeatureDistance faceDistance(const FacePlane& face, const Vec& point) {
  Vec residual;
  const bool inside = face.project(point, residual);
  return {inside ? residual.norm() : kInfinity, face.extentTo(point)};
}

}  // namespace kios::engine
