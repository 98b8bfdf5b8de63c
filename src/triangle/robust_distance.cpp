// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "triangle/face_plane.h"
#include "triangle/pair.h"
#include "volume/rounding.h"

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
  const double square = ab.squaredNorm(), from_a = (p - a).dot(ab), from_b = (b - p).dot(ab);
  if (!(square > 0) || !(from_a > 0)) return {a, 0};
  if (!(from_b > 0)) return {b, 1};
  // Beyond 1/2 only by rounding, for a segment much shorter than its distance.
  if (from_a < from_b) {
    const double t = std::min(0.5, from_a / square);
    return {a + t * ab, t};
  }
  const double t = std::min(0.5, from_b / square);
  return {b - t * ab, 1 - t};
}

PairFeature atEnd(PairFeature feature, double t) {
  if (feature.kind != PairFeature::kEdge || (t > 0 && t < 1)) return feature;
  return {PairFeature::kVertex, t > 0 ? nextVertex(feature.index) : feature.index};
}

class RobustDistance {
 public:
  explicit RobustDistance(const TrianglePair& pair) : p_(pair.p), q_(pair.q) {}

  PairDistance find() {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        take({p_[i], 0}, {PairFeature::kVertex, i}, {q_[j], 0}, {PairFeature::kVertex, j});
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int next_i = nextVertex(i), next_j = nextVertex(j);
        take({p_[i], 0}, {PairFeature::kVertex, i}, nearestOnSegment(p_[i], q_[j], q_[next_j]),
             {PairFeature::kEdge, j});
        take(nearestOnSegment(q_[j], p_[i], p_[next_i]), {PairFeature::kEdge, i}, {q_[j], 0},
             {PairFeature::kVertex, j});
        edges(i, j);
      }
    }
    faces();
    best_.distance = std::sqrt(square_);
    return best_;
  }

 private:
  void take(const SegmentPoint& on_p, PairFeature feature_p, const SegmentPoint& on_q,
            PairFeature feature_q) {
    take((on_q.point - on_p.point).squaredNorm(),
         {0, on_p.point, on_q.point, atEnd(feature_p, on_p.t), atEnd(feature_q, on_q.t)});
  }
  void take(double square, const PairDistance& found) {
    if (!(square < square_)) return;
    square_ = square;
    best_ = found;
  }

  /// Interiors of two edges; pairs at an end are vertex-edge pairs. Whatever the parameters' error,
  /// the points lie on the edges, each nearest to the other.
  void edges(int i, int j) {
    const Vec &a = p_[i], &b = p_[nextVertex(i)], &c = q_[j], &d = q_[nextVertex(j)];
    const Vec ab = b - a, cd = d - c, w = c - a, n = ab.cross(cd);
    const double square = n.squaredNorm(), t = w.cross(cd).dot(n), v = w.cross(ab).dot(n);
    if (!(t > 0 && t < square && v > 0 && v < square)) return;
    const SegmentPoint y = nearestOnSegment(pointAt(a, b, t / square).point, c, d);
    take(nearestOnSegment(y.point, a, b), {PairFeature::kEdge, i}, y, {PairFeature::kEdge, j});
  }

  void faces() {
    const FacePlane plane_p(p_), plane_q(q_);
    const PairFeature face = {PairFeature::kFace, 0};
    Vec residual;
    for (int i = 0; i < 3; ++i) {
      const PairFeature vertex = {PairFeature::kVertex, i};
      if (plane_p.project(q_[i], residual)) {
        take(residual.squaredNorm(), {0, q_[i] - residual, q_[i], face, vertex});
      }
      if (plane_q.project(p_[i], residual)) {
        take(residual.squaredNorm(), {0, p_[i], p_[i] - residual, vertex, face});
      }
    }
  }

  const Vec (&p_)[3];
  const Vec (&q_)[3];
  double square_ = kInfinity;  ///< of the best distance
  PairDistance best_ = {};
};

}  // namespace

PairDistance robustDistance(const TrianglePair& pair) { return RobustDistance(pair).find(); }

}  // namespace kios
