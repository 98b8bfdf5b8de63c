// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/certified_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle/twofold.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

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
  plane_p_.face = pair_.p;
  plane_p_.edges = e_;
  plane_p_.squares = ee_;
  plane_q_.face = pair_.q;
  plane_q_.edges = f_;
  plane_q_.squares = ff_;
  setPlane(pair_.q, plane_p_);
  setPlane(pair_.p, plane_q_);
  return plane_p_.side == 0 && plane_q_.side == 0;
}

void CertifiedDistance::setPlane(const Vec (&other)[3], Plane& plane) const {
  plane.normal = plane.edges[0].cross(plane.edges[1]);
  plane.square = plane.normal.squaredNorm();
  plane.length = std::sqrt(plane.square);
  const double in_plane = tolerance_ * plane.length;
  int above = 0, below = 0;
  for (int i = 0; i < 3; ++i) {
    plane.heights[i] = (other[i] - plane.face[0]).dot(plane.normal);
    above += plane.heights[i] > in_plane;
    below += plane.heights[i] < -in_plane;
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
  return takeFoot(kNone, facePair(plane_p_, pair_.q), found) ||
         takeFoot(facePair(plane_q_, pair_.p), kNone, found);
}

/// A vertex of either and its foot on the other's face; false if there is none.
bool CertifiedDistance::takeFoot(int vertex_of_p, int vertex_of_q, PairDistance& found) const {
  if (vertex_of_p == kNone && vertex_of_q == kNone) return false;
  const bool of_q = vertex_of_p == kNone;
  const int i = of_q ? vertex_of_q : vertex_of_p;
  const Plane& plane = of_q ? plane_p_ : plane_q_;
  found.distance = std::abs(plane.heights[i]) / plane.length;
  const Vec& vertex = (of_q ? pair_.q : pair_.p)[i];
  const Vec foot = vertex - (plane.heights[i] / plane.square) * plane.normal;
  const PairFeature face = {PairFeature::kFace, 0}, corner = {PairFeature::kVertex, i};
  found.on_p = of_q ? foot : vertex;
  found.on_q = of_q ? vertex : foot;
  found.feature_p = of_q ? face : corner;
  found.feature_q = of_q ? corner : face;
  return true;
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

/// The face is no sliver, and it lies within the slab's one side: else its normal is too
/// inaccurate.
bool CertifiedDistance::isAccurate(const Plane& plane) const {
  const double longest = std::max({plane.squares[0], plane.squares[1], plane.squares[2]});
  if (!(plane.square > 1e-6 * longest * longest)) return false;  // height / edge > 1e-3
  double low = 0, high = 0;
  for (int i = 1; i < 3; ++i) {
    const double offset = (plane.face[i] - plane.face[0]).dot(plane.normal);
    low = std::min(low, offset);
    high = std::max(high, offset);
  }
  return high - low <= 0.5 * tolerance_ * plane.length;
}

/// Inside every edge by more than the rounding of this test: near a sharp corner that rounding
/// would reach far beyond the corner.
bool CertifiedDistance::isAbove(const Plane& plane, const Vec& vertex) const {
  const double margin = 2 * tolerance_;
  for (int i = 0; i < 3; ++i) {
    const double inside = plane.normal.cross(plane.edges[i]).dot(vertex - plane.face[i]);
    if (!(inside > 0 && inside * inside > margin * margin * plane.square * plane.squares[i])) {
      return false;
    }
  }
  return true;
}

/// The vertex of `other` nearest to the plane of a face, if all lie on one side of it and that
/// vertex above the face.
int CertifiedDistance::facePair(const Plane& plane, const Vec (&other)[3]) const {
  const double* const h = plane.heights;
  int nearest = std::abs(h[1]) < std::abs(h[0]) ? 1 : 0;
  if (std::abs(h[2]) < std::abs(h[nearest])) nearest = 2;
  const bool far = std::abs(h[nearest]) > least_ * plane.length;
  const bool found = plane.side != 0 && far && isAbove(plane, other[nearest]) && isAccurate(plane);
  return found ? nearest : kNone;
}

}  // namespace kios
