// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/certified_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle/expansion.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

constexpr double kEps = 0x1p-52;

double clamp01(double t) { return t < 0 ? 0 : (t > 1 ? 1 : t); }

PairFeature onEdge(int edge, double t) {
  if (t == 0) return {PairFeature::kVertex, edge};
  if (t == 1) return {PairFeature::kVertex, nextVertex(edge)};
  return {PairFeature::kEdge, edge};
}

/// a x b; every component has nearly all its digits, however small the angle is.
Vec accurateCross(const Vec& a, const Vec& b) {
  Vec n;
  for (int c = 0; c < 3; ++c) {
    const int u = nextVertex(c), v = nextVertex(u);
    n[c] = accurateMinor({a[u], 0}, {a[v], 0}, {b[u], 0}, {b[v], 0});
  }
  return n;
}

/// Returns |e|^2, or 0 if that is subnormal: its inverse would be infinite.
double squareOf(const Vec& e) {
  const double square = e.squaredNorm();
  return square >= std::numeric_limits<double>::min() ? square : 0;
}

}  // namespace

CertifiedDistance::CertifiedDistance(const TrianglePair& pair)
    : pair_(pair), tolerance_(8 * kEps * pair.magnitude), least_(64 * kEps * pair.magnitude) {
  for (int i = 0; i < 3; ++i) {
    e_[i] = pair_.p[nextVertex(i)] - pair_.p[i];
    f_[i] = pair_.q[nextVertex(i)] - pair_.q[i];
    ee_[i] = squareOf(e_[i]);
    ff_[i] = squareOf(f_[i]);
    per_ee_[i] = 1 / (ee_[i] > 0 ? ee_[i] : 1);  // edges of length 0 are left out
    per_ff_[i] = 1 / (ff_[i] > 0 ? ff_[i] : 1);
  }
  // Most nearest pairs lie at the vertices that face the other triangle.
  const Vec across =
      (pair_.q[0] + pair_.q[1] + pair_.q[2]) - (pair_.p[0] + pair_.p[1] + pair_.p[2]);
  orderEdges(pair_.p, across, order_p_);
  orderEdges(pair_.q, -across, order_q_);
}

/// The two edges at the vertex farthest along `direction`, then the third.
void CertifiedDistance::orderEdges(const Vec (&v)[3], const Vec& direction, int (&order)[3]) {
  const double h0 = v[0].dot(direction), h1 = v[1].dot(direction), h2 = v[2].dot(direction);
  const int vertex = h0 >= h1 ? (h0 >= h2 ? 0 : 2) : (h1 >= h2 ? 1 : 2);
  order[0] = vertex;
  order[2] = nextVertex(vertex);
  order[1] = nextVertex(order[2]);
}

bool CertifiedDistance::crossing() {
  setPlane(pair_.p, e_, pair_.q, plane_p_);
  setPlane(pair_.q, f_, pair_.p, plane_q_);
  return plane_p_.side == 0 && plane_q_.side == 0;
}

void CertifiedDistance::setPlane(const Vec (&face)[3], const Vec (&edges)[3], const Vec (&other)[3],
                                 Plane& plane) {
  plane.normal = edges[0].cross(edges[1]);
  plane.square = plane.normal.squaredNorm();
  int above = 0, below = 0;
  for (int i = 0; i < 3; ++i) {
    plane.heights[i] = (other[i] - face[0]).dot(plane.normal);
    above += plane.heights[i] > 0;
    below += plane.heights[i] < 0;
  }
  plane.side = above == 3 ? 1 : (below == 3 ? -1 : 0);
}

bool CertifiedDistance::nearestEdges(int begin, int end, PairDistance& found) {
  for (int i = begin; i < end; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (edgePair(order_p_[i], order_q_[j], found)) return true;
      if (touching()) return false;
    }
  }
  return false;
}

bool CertifiedDistance::nearestFace(PairDistance& found) const {
  if (facePair(plane_p_, pair_.p, e_, ee_, pair_.q, found.on_p, found.on_q, found.feature_q,
               found.distance)) {
    found.feature_p = {PairFeature::kFace, 0};
    return true;
  }
  if (facePair(plane_q_, pair_.q, f_, ff_, pair_.p, found.on_q, found.on_p, found.feature_p,
               found.distance)) {
    found.feature_q = {PairFeature::kFace, 0};
    return true;
  }
  return false;
}

/// Nearest points of edges i and j; true if they are those of the triangles.
bool CertifiedDistance::edgePair(int i, int j, PairDistance& found) {
  const Vec &e = e_[i], &f = f_[j];
  if (!(ee_[i] > 0 && ff_[j] > 0)) return false;
  const Vec t = pair_.q[j] - pair_.p[i];
  const double ee = ee_[i], ff = ff_[j], ef = e.dot(f), et = e.dot(t), ft = f.dot(t);
  const double den = ee * ff - ef * ef;
  const bool oblique = den > 1e-4 * ee * ff;
  double s = 0;
  if (oblique) {
    s = clamp01((et * ff - ft * ef) / den);
  } else {  // den has lost its digits
    const Vec n = e.cross(f);
    const double square = n.squaredNorm();
    if (square > 0) s = clamp01(t.cross(f).dot(n) / square);
  }
  double v = (s * ef - ft) * per_ff_[j];
  if (v < 0) {
    v = 0;
    s = clamp01(et * per_ee_[i]);
  } else if (v > 1) {
    v = 1;
    s = clamp01((et + ef) * per_ee_[i]);
  }
  const Vec x = pair_.p[i] + s * e, y = pair_.q[j] + v * f, w = y - x;
  const double square = w.squaredNorm();
  if (square < nearest_square_) nearest_square_ = square;
  // The other vertex of each triangle must lie behind its own point, but for the rounding of w.
  const double slack = 8 * tolerance_ * pair_.magnitude;
  if ((pair_.p[nextVertex(nextVertex(i))] - x).dot(w) > slack) return false;
  if ((pair_.q[nextVertex(nextVertex(j))] - y).dot(w) < -slack) return false;

  const double distance = std::sqrt(square);
  if (!(distance > least_)) return false;
  const bool within_e = s > 0 && s<1, within_f = v> 0 && v < 1;
  // w loses digits as the distance falls, but the directions of the edges don't.
  const auto across = [&w](const Vec& n) { return n.dot(w) < 0 ? Vec(-n) : n; };
  bool proven;
  if (within_e && within_f && oblique) {
    proven = certified(across(e.cross(f)), x, distance);
  } else {
    proven = certified(w, x, distance);
    if (!proven && within_e) proven = certified(w - (w.dot(e) / ee) * e, x, distance);
    if (!proven && within_f) proven = certified(w - (w.dot(f) / ff) * f, x, distance);
    if (!proven && within_e && within_f) {
      proven = certified(across(accurateCross(e, f)), x, distance);
    }
  }
  if (proven) found = {distance, x, y, onEdge(i, s), onEdge(j, v)};
  return proven;
}

/// The slab across `direction` between the triangles is at least distance - tolerance wide.
bool CertifiedDistance::certified(const Vec& direction, const Vec& x, double distance) const {
  double high = (pair_.p[0] - x).dot(direction), low = (pair_.q[0] - x).dot(direction);
  for (int k = 1; k < 3; ++k) {
    high = std::max(high, (pair_.p[k] - x).dot(direction));
    low = std::min(low, (pair_.q[k] - x).dot(direction));
  }
  const double length = direction.norm();
  // A length whose square underflows means nothing.
  return length > 1e-140 && distance * length - (low - high) <= tolerance_ * length;
}

/// The vertex of `other` nearest to the plane of `face`, if all lie on one side of it and that
/// vertex above the face.
bool CertifiedDistance::facePair(const Plane& plane, const Vec (&face)[3], const Vec (&edges)[3],
                                 const double (&squares)[3], const Vec (&other)[3], Vec& on_face,
                                 Vec& on_other, PairFeature& feature, double& distance) const {
  const Vec& n = plane.normal;
  const double square = plane.square;
  const double longest = std::max({squares[0], squares[1], squares[2]});
  if (plane.side == 0 || !(square > 1e-6 * longest * longest))
    return false;  // height / edge > 1e-3
  const double length = std::sqrt(square);
  const double* const h = plane.heights;
  int nearest = std::abs(h[1]) < std::abs(h[0]) ? 1 : 0;
  if (std::abs(h[2]) < std::abs(h[nearest])) nearest = 2;
  distance = std::abs(h[nearest]) / length;
  if (!(distance > least_)) return false;
  // Inside every edge by more than the rounding of this test: near a sharp corner that rounding
  // would reach far beyond the corner.
  for (int i = 0; i < 3; ++i) {
    const double inside = n.cross(edges[i]).dot(other[nearest] - face[i]);
    const double margin = 2 * tolerance_;
    if (!(inside > 0 && inside * inside > margin * margin * square * squares[i])) {
      return false;
    }
  }
  // The face itself must lie within the slab's one side, else n is too inaccurate.
  double low = 0, high = 0;
  for (int i = 1; i < 3; ++i) {
    const double offset = (face[i] - face[0]).dot(n);
    low = std::min(low, offset);
    high = std::max(high, offset);
  }
  if (!(high - low <= 0.5 * tolerance_ * length)) return false;
  on_other = other[nearest];
  on_face = on_other - (h[nearest] / square) * n;
  feature = {PairFeature::kVertex, nearest};
  return true;
}

}  // namespace kios
