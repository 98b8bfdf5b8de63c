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

CertifiedDistance::Triangle::Triangle(const Vec (&vertices)[3]) : v(vertices) {
  for (int i = 0; i < 3; ++i) {
    edge[i] = v[nextVertex(i)] - v[i];
    square[i] = squareOf(edge[i]);
    per_square[i] = 1 / (square[i] > 0 ? square[i] : 1);  // edges of length 0 are left out
  }
}

CertifiedDistance::CertifiedDistance(const TrianglePair& pair)
    : pair_(pair),
      tolerance_(8 * kEps * pair.magnitude),
      least_(64 * kEps * pair.magnitude),
      p_(pair.p),
      q_(pair.q) {
  // Most nearest pairs lie at the vertices that face the other triangle.
  const Vec across = (q_.v[0] + q_.v[1] + q_.v[2]) - (p_.v[0] + p_.v[1] + p_.v[2]);
  orderEdges(p_, across);
  orderEdges(q_, -across);
}

/// The two edges at the vertex farthest along `direction`, then the third.
void CertifiedDistance::orderEdges(Triangle& t, const Vec& direction) {
  const double h0 = t.v[0].dot(direction), h1 = t.v[1].dot(direction), h2 = t.v[2].dot(direction);
  const int vertex = h0 >= h1 ? (h0 >= h2 ? 0 : 2) : (h1 >= h2 ? 1 : 2);
  t.order[0] = vertex;
  t.order[2] = nextVertex(vertex);
  t.order[1] = nextVertex(t.order[2]);
}

bool CertifiedDistance::crossing() {
  setPlane(p_, q_);
  setPlane(q_, p_);
  return p_.side == 0 && q_.side == 0;
}

void CertifiedDistance::setPlane(Triangle& face, const Triangle& other) {
  face.normal = face.edge[0].cross(face.edge[1]);
  face.normal_square = face.normal.squaredNorm();
  int above = 0, below = 0;
  for (int i = 0; i < 3; ++i) {
    face.heights[i] = (other.v[i] - face.v[0]).dot(face.normal);
    above += face.heights[i] > 0;
    below += face.heights[i] < 0;
  }
  face.side = above == 3 ? 1 : (below == 3 ? -1 : 0);
}

bool CertifiedDistance::nearestEdges(int begin, int end, PairDistance& found) {
  for (int i = begin; i < end; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (edgePair(p_.order[i], q_.order[j], found)) return true;
      if (touching()) return false;
    }
  }
  return false;
}

bool CertifiedDistance::nearestFace(PairDistance& found) const {
  if (facePair(p_, q_, found.on_p, found.on_q, found.feature_q, found.distance)) {
    found.feature_p = {PairFeature::kFace, 0};
    return true;
  }
  if (facePair(q_, p_, found.on_q, found.on_p, found.feature_p, found.distance)) {
    found.feature_q = {PairFeature::kFace, 0};
    return true;
  }
  return false;
}

/// Nearest points of edges i and j; true if they are those of the triangles.
bool CertifiedDistance::edgePair(int i, int j, PairDistance& found) {
  const Vec &e = p_.edge[i], &f = q_.edge[j];
  const double ee = p_.square[i], ff = q_.square[j];
  if (!(ee > 0 && ff > 0)) return false;
  const Vec t = q_.v[j] - p_.v[i];
  const double ef = e.dot(f), et = e.dot(t), ft = f.dot(t);
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
  double v = (s * ef - ft) * q_.per_square[j];
  if (v < 0) {
    v = 0;
    s = clamp01(et * p_.per_square[i]);
  } else if (v > 1) {
    v = 1;
    s = clamp01((et + ef) * p_.per_square[i]);
  }
  const Vec x = p_.v[i] + s * e, y = q_.v[j] + v * f, w = y - x;
  const double square = w.squaredNorm();
  if (square < nearest_square_) nearest_square_ = square;
  // The other vertex of each triangle must lie behind its own point, but for the rounding of w.
  const double slack = 8 * tolerance_ * pair_.magnitude;
  if ((p_.v[nextVertex(nextVertex(i))] - x).dot(w) > slack) return false;
  if ((q_.v[nextVertex(nextVertex(j))] - y).dot(w) < -slack) return false;

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
  double high = (p_.v[0] - x).dot(direction), low = (q_.v[0] - x).dot(direction);
  for (int k = 1; k < 3; ++k) {
    high = std::max(high, (p_.v[k] - x).dot(direction));
    low = std::min(low, (q_.v[k] - x).dot(direction));
  }
  const double length = direction.norm();
  // A length whose square underflows means nothing.
  return length > 1e-140 && distance * length - (low - high) <= tolerance_ * length;
}

/// The vertex of `other` nearest to the plane of `face`, if all lie on one side of it and that
/// vertex above the face.
bool CertifiedDistance::facePair(const Triangle& face, const Triangle& other, Vec& on_face,
                                 Vec& on_other, PairFeature& feature, double& distance) const {
  const Vec& n = face.normal;
  const double square = face.normal_square;
  const double longest = std::max({face.square[0], face.square[1], face.square[2]});
  if (face.side == 0 || !(square > 1e-6 * longest * longest)) return false;  // height / edge > 1e-3
  const double length = std::sqrt(square);
  const double* const h = face.heights;
  int nearest = std::abs(h[1]) < std::abs(h[0]) ? 1 : 0;
  if (std::abs(h[2]) < std::abs(h[nearest])) nearest = 2;
  distance = std::abs(h[nearest]) / length;
  if (!(distance > least_)) return false;
  // Inside every edge by more than the rounding of this test: near a sharp corner that rounding
  // would reach far beyond the corner.
  for (int i = 0; i < 3; ++i) {
    const double inside = n.cross(face.edge[i]).dot(other.v[nearest] - face.v[i]);
    const double margin = 2 * tolerance_;
    if (!(inside > 0 && inside * inside > margin * margin * square * face.square[i])) {
      return false;
    }
  }
  // The face itself must lie within the slab's one side, else n is too inaccurate.
  double low = 0, high = 0;
  for (int i = 1; i < 3; ++i) {
    const double offset = (face.v[i] - face.v[0]).dot(n);
    low = std::min(low, offset);
    high = std::max(high, offset);
  }
  if (!(high - low <= 0.5 * tolerance_ * length)) return false;
  on_other = other.v[nearest];
  on_face = on_other - (h[nearest] / square) * n;
  feature = {PairFeature::kVertex, nearest};
  return true;
}

}  // namespace kios
