// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle/pair.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

/// A point of the segment from a to b, its parameter in [0, 1].
struct SegmentPoint {
  Vec point;
  double t;
};

/// Interpolated from the nearer end, so that the point lies on the segment to eps of its length.
SegmentPoint pointAt(const Vec& a, const Vec& b, double t) {
  return {t < 0.5 ? Vec(a + t * (b - a)) : Vec(b + (1 - t) * (a - b)), t};
}

SegmentPoint nearestOnSegment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const double square = ab.squaredNorm();
  if (!(square > 0)) return {a, 0};
  const double from_a = (p - a).dot(ab), from_b = (b - p).dot(ab);
  if (!(from_a > 0)) return {a, 0};
  if (!(from_b > 0)) return {b, 1};
  // Beyond 1/2 only by rounding, for a segment much shorter than its distance.
  if (from_a < from_b) {
    const double t = std::min(0.5, from_a / square);
    return {a + t * ab, t};
  }
  const double t = std::min(0.5, from_b / square);
  return {b - t * ab, 1 - t};
}

/// A triangle's plane by its longest edge and the height above it, by Gram-Schmidt done twice:
/// accurate to eps for any aspect, which a cross product is not.
class Plane {
 public:
  explicit Plane(const Vec (&v)[3]) {
    int longest = 0;
    double square = -1;
    for (int i = 0; i < 3; ++i) {
      const double s = (v[nextVertex(i)] - v[i]).squaredNorm();
      if (s > square) {
        square = s;
        longest = i;
      }
    }
    origin_ = v[longest];
    edge_ = v[nextVertex(longest)] - origin_;
    height_ = v[nextVertex(nextVertex(longest))] - origin_;
    foot_ = 0;
    if (square > 0) {
      foot_ = removePart(edge_, height_);
      foot_ += removePart(edge_, height_);
    }
    degenerate_ = !(height_.squaredNorm() > 0) || !(square > 0);
  }

  bool degenerate() const { return degenerate_; }

  /// The part of p - plane orthogonal to the plane; true if its foot lies in the triangle.
  bool project(const Vec& p, Vec& residual) const {
    residual = p - origin_;
    double s = removePart(edge_, residual), c = removePart(height_, residual);
    s += removePart(edge_, residual);
    c += removePart(height_, residual);
    s += removePart(edge_, residual);
    const double from_side = s - c * foot_;
    return c >= 0 && from_side >= 0 && from_side + c <= 1;
  }

 private:
  static double removePart(const Vec& direction, Vec& from) {
    const double t = from.dot(direction) / direction.squaredNorm();
    from -= t * direction;
    return t;
  }

  Vec origin_, edge_, height_;
  double foot_;  ///< foot of the apex along the edge, in edges
  bool degenerate_;
};

class RobustDistance {
 public:
  explicit RobustDistance(const TrianglePair& pair) : p_(pair.p), q_(pair.q) {}

  PairDistance find() {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        consider({p_[i], 0}, {PairFeature::kVertex, i},
                 nearestOnSegment(p_[i], q_[j], q_[nextVertex(j)]), {PairFeature::kEdge, j});
        consider(nearestOnSegment(q_[j], p_[i], p_[nextVertex(i)]), {PairFeature::kEdge, i},
                 {q_[j], 0}, {PairFeature::kVertex, j});
        edges(i, j);
      }
    }
    faces();
    best_.distance = std::sqrt(square_);
    return best_;
  }

 private:
  void consider(const SegmentPoint& on_p, PairFeature feature_p, const SegmentPoint& on_q,
                PairFeature feature_q) {
    const double square = (on_q.point - on_p.point).squaredNorm();
    if (!(square < square_)) return;
    square_ = square;
    best_ = {0, on_p.point, on_q.point, atEnd(feature_p, on_p.t), atEnd(feature_q, on_q.t)};
  }

  static PairFeature atEnd(PairFeature feature, double t) {
    if (feature.kind != PairFeature::kEdge || (t > 0 && t < 1)) return feature;
    return {PairFeature::kVertex, t > 0 ? nextVertex(feature.index) : feature.index};
  }

  /// Interiors of two edges; pairs at an end are vertex-edge pairs. Whatever the parameters' error,
  /// the points lie on the edges, each nearest to the other.
  void edges(int i, int j) {
    const Vec &a = p_[i], &b = p_[nextVertex(i)], &c = q_[j], &d = q_[nextVertex(j)];
    const Vec ab = b - a, cd = d - c, w = c - a;
    const Vec n = ab.cross(cd);
    const double square = n.squaredNorm();
    if (!(square > 0)) return;
    const double t = w.cross(cd).dot(n) / square, v = w.cross(ab).dot(n) / square;
    if (!(t > 0 && t < 1 && v > 0 && v < 1)) return;
    const SegmentPoint y = nearestOnSegment(pointAt(a, b, t).point, c, d);
    const SegmentPoint x = nearestOnSegment(y.point, a, b);
    consider(x, {PairFeature::kEdge, i}, y, {PairFeature::kEdge, j});
  }

  void faces() {
    const Plane plane_p(p_), plane_q(q_);
    const PairFeature face = {PairFeature::kFace, 0};
    for (int i = 0; i < 3; ++i) {
      Vec residual;
      if (!plane_p.degenerate() && plane_p.project(q_[i], residual)) {
        consider(residual, {q_[i] - residual, q_[i], face, {PairFeature::kVertex, i}});
      }
      if (!plane_q.degenerate() && plane_q.project(p_[i], residual)) {
        consider(residual, {p_[i], p_[i] - residual, {PairFeature::kVertex, i}, face});
      }
    }
  }

  struct Points {
    Vec on_p, on_q;
    PairFeature feature_p, feature_q;
  };
  void consider(const Vec& residual, const Points& at) {
    const double square = residual.squaredNorm();
    if (!(square < square_)) return;
    square_ = square;
    best_ = {0, at.on_p, at.on_q, at.feature_p, at.feature_q};
  }

  const Vec (&p_)[3];
  const Vec (&q_)[3];
  double square_ = std::numeric_limits<double>::infinity();  ///< of the best distance
  PairDistance best_;
};

}  // namespace

PairDistance robustDistance(const TrianglePair& pair) { return RobustDistance(pair).find(); }

}  // namespace kios
