// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "triangle/pair.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

/// Below, squares may have lost digits by underflow: nothing is passed over by them.
constexpr double kLeastSquare = 0x1p-660;

/// A point of the segment from a to b, its parameter in [0, 1].
struct SegmentPoint {
  Vec point;
  double t;
};

/// Interpolated from the nearer end, so that the point lies on the segment to eps of its length.
SegmentPoint pointAt(const Vec& a, const Vec& b, double t) {
  return {t < 0.5 ? Vec(a + t * (b - a)) : Vec(b + (1 - t) * (a - b)), t};
}

/// Finds the nearest point of the segment from a along ab, whose square and products with the ways
/// from a and to b are given.
SegmentPoint nearestOnSegment(const Vec& a, const Vec& b, const Vec& ab, double square,
                              double from_a, double from_b) {
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

SegmentPoint nearestOnSegment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  return nearestOnSegment(a, b, ab, ab.squaredNorm(), (p - a).dot(ab), (b - p).dot(ab));
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

  /// The part of p - plane orthogonal to the plane; true if its foot lies in the triangle.
  bool project(const Vec& p, Vec& residual) const {
    if (degenerate_) return false;
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

/// The side of a face, by its normal, on which each vertex v lies farther than `limit`: -1, 1, or 0
/// for neither. `limit` must exceed the distance in question by 32 eps magnitude for rounding. The
/// normal need not be exact, as the face's own extent along it is allowed for.
struct Sides {
  int of[3] = {0, 0, 0};

  Sides(const Vec (&face)[3], const Vec (&edges)[3], const Vec (&v)[3], double limit) {
    const Vec n = edges[0].cross(edges[1]);
    const double square = n.squaredNorm();
    if (!(square > kLeastSquare)) return;
    const double h1 = edges[0].dot(n), h2 = -edges[2].dot(n);
    const double low = std::min({0.0, h1, h2}), high = std::max({0.0, h1, h2});
    const double limit_square = limit * limit * square;
    for (int i = 0; i < 3; ++i) {
      const double h = (v[i] - face[0]).dot(n);
      const double above = h - high, below = low - h;
      if (above > 0 && above * above > limit_square) of[i] = 1;
      if (below > 0 && below * below > limit_square) of[i] = -1;
    }
  }
  bool edge(int i) const { return of[i] * of[nextVertex(i)] > 0; }
};

class RobustDistance {
 public:
  RobustDistance(const TrianglePair& pair, double within)
      : p_(pair.p), q_(pair.q), margin_(64 * kEps * pair.magnitude), limit_(within + margin_) {
    for (int i = 0; i < 3; ++i) {
      e_[i] = p_[nextVertex(i)] - p_[i];
      f_[i] = q_[nextVertex(i)] - q_[i];
      ee_[i] = e_[i].squaredNorm();
      ff_[i] = f_[i].squaredNorm();
    }
  }

  PairDistance find() {
    vertices();
    limit_ = std::min(limit_, std::sqrt(square_) + margin_);
    const Sides far_q(p_, e_, q_, limit_), far_p(q_, f_, p_, limit_);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (far_p.of[i] == 0) vertexOfP(i, j);
        if (far_q.of[j] == 0) vertexOfQ(i, j);
        if (!far_p.edge(i) && !far_q.edge(j)) edges(i, j);
      }
    }
    faces(far_p, far_q);
    best_.distance = std::sqrt(square_);
    return best_;
  }

 private:
  void vertices() {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        between_[i][j] = q_[j] - p_[i];
        squares_[i][j] = between_[i][j].squaredNorm();
        take(squares_[i][j],
             {0, p_[i], q_[j], {PairFeature::kVertex, i}, {PairFeature::kVertex, j}});
      }
    }
  }

  void vertexOfP(int i, int j) {
    const int next = nextVertex(j);
    const double from = -between_[i][j].dot(f_[j]), to = between_[i][next].dot(f_[j]);
    if (farFromEdge(squares_[i][j], from, to, ff_[j])) return;
    consider({p_[i], 0}, {PairFeature::kVertex, i},
             nearestOnSegment(q_[j], q_[next], f_[j], ff_[j], from, to), {PairFeature::kEdge, j});
  }

  void vertexOfQ(int i, int j) {
    const int next = nextVertex(i);
    const double from = between_[i][j].dot(e_[i]), to = -between_[next][j].dot(e_[i]);
    if (farFromEdge(squares_[i][j], from, to, ee_[i])) return;
    consider(nearestOnSegment(p_[i], p_[next], e_[i], ee_[i], from, to), {PairFeature::kEdge, i},
             {q_[j], 0}, {PairFeature::kVertex, j});
  }

  /// A vertex beyond an edge's ends, which are vertices, or farther than limit_ from its line, by
  /// the square of the way from the edge's begin and the products of nearestOnSegment(). Their
  /// difference is off by less than 16 eps of the terms.
  bool farFromEdge(double way, double from, double to, double square) const {
    if (!(from > 0 && to > 0)) return true;
    if (!(square > kLeastSquare)) return false;
    return way * square - from * from > (limit_ * limit_ + 32 * kEps * way) * square;
  }

  void consider(const SegmentPoint& on_p, PairFeature feature_p, const SegmentPoint& on_q,
                PairFeature feature_q) {
    take((on_q.point - on_p.point).squaredNorm(),
         {0, on_p.point, on_q.point, atEnd(feature_p, on_p.t), atEnd(feature_q, on_q.t)});
  }

  void take(double square, const PairDistance& found) {
    if (!(square < square_)) return;
    square_ = square;
    best_ = found;
  }

  static PairFeature atEnd(PairFeature feature, double t) {
    if (feature.kind != PairFeature::kEdge || (t > 0 && t < 1)) return feature;
    return {PairFeature::kVertex, t > 0 ? nextVertex(feature.index) : feature.index};
  }

  /// Interiors of two edges; pairs at an end are vertex-edge pairs. Whatever the parameters' error,
  /// the points lie on the edges, each nearest to the other.
  void edges(int i, int j) {
    const Vec &ab = e_[i], &cd = f_[j], &w = between_[i][j];
    const Vec n = ab.cross(cd);
    const double square = n.squaredNorm();
    if (!(square > 0)) return;
    // The lines' distance is |w n| / |n|. w n is off by less than 16 eps |w| |ab| |cd|, and limit_
    // n likewise; the square of a sum is at most twice the sum of squares.
    const double product = ee_[i] * ff_[j], apart = w.dot(n), limit = limit_ * limit_;
    if (product > kLeastSquare &&
        apart * apart >
            2 * (limit * square + 1024 * kEps * kEps * (squares_[i][j] + limit) * product)) {
      return;
    }
    const double t = w.cross(cd).dot(n), v = w.cross(ab).dot(n);
    if (!(t > 0 && t < square && v > 0 && v < square)) return;
    const Vec &a = p_[i], &b = p_[nextVertex(i)], &c = q_[j], &d = q_[nextVertex(j)];
    const SegmentPoint y = nearestOnSegment(pointAt(a, b, t / square).point, c, d);
    const SegmentPoint x = nearestOnSegment(y.point, a, b);
    consider(x, {PairFeature::kEdge, i}, y, {PairFeature::kEdge, j});
  }

  /// False if two vertices are the same: then the edges are all there is.
  static bool hasArea(const double (&squares)[3]) {
    return squares[0] > 0 && squares[1] > 0 && squares[2] > 0;
  }

  void faces(const Sides& far_p, const Sides& far_q) {
    std::optional<Plane> plane_p, plane_q;  // most are not needed
    const bool area_p = hasArea(ee_), area_q = hasArea(ff_);
    const PairFeature face = {PairFeature::kFace, 0};
    Vec residual;
    for (int i = 0; i < 3; ++i) {
      if (area_p && far_q.of[i] == 0) {
        if (!plane_p) plane_p.emplace(p_);
        if (plane_p->project(q_[i], residual)) {
          take(residual.squaredNorm(),
               {0, q_[i] - residual, q_[i], face, {PairFeature::kVertex, i}});
        }
      }
      if (area_q && far_p.of[i] == 0) {
        if (!plane_q) plane_q.emplace(q_);
        if (plane_q->project(p_[i], residual)) {
          take(residual.squaredNorm(),
               {0, p_[i], p_[i] - residual, {PairFeature::kVertex, i}, face});
        }
      }
    }
  }

  const Vec (&p_)[3];
  const Vec (&q_)[3];
  const double margin_;  ///< 16 eps magnitude for `within`, 16 for the answer, 32 for Sides
  double limit_;         ///< features known to be farther apart are passed over
  Vec e_[3], f_[3];
  double ee_[3], ff_[3];
  Vec between_[3][3];  ///< from p_[i] to q_[j]
  double squares_[3][3];
  double square_ = kInfinity;  ///< of the best distance
  PairDistance best_ = {};
};

}  // namespace

PairDistance robustDistance(const TrianglePair& pair, double within) {
  return RobustDistance(pair, within).find();
}

}  // namespace kios
