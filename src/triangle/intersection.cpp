// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle/intersection.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "triangle/common_point.h"
#include "triangle/predicates.h"

namespace kios {
namespace {

constexpr int kNext[3] = {1, 2, 0};

/// Vertices of a triangle of the pair.
struct Face {
  int v[3];
  bool degenerate = false;  ///< no area: the triangle is the union of its edges
};

/// Closed intersection tests between the parts of two triangles, by vertex index.
class PairIntersection {
 public:
  explicit PairIntersection(const PairPredicates::Coordinates& points)
      : points_(points), signs_(points) {}

  bool test() {
    if (!crossesPlanes()) return false;
    for (int e = 0; e < 3; ++e) {
      const int n = kNext[e];
      if (segmentMeetsFace(a_.v[e], a_.v[n], side_a_[e], side_a_[n], b_)) return true;
      if (segmentMeetsFace(b_.v[e], b_.v[n], side_b_[e], side_b_[n], a_)) return true;
    }
    return false;
  }

  /// The first common point that is found, nothing if there is none: cheaper than middle().
  std::optional<std::array<double, 3>> anyPoint() {
    if (!crossesPlanes()) return std::nullopt;
    std::array<double, 3> point;
    for (int e = 0; e < 3; ++e) {
      if (edgeMeets(a_, side_a_, e, b_, point) || edgeMeets(b_, side_b_, e, a_, point)) {
        return point;
      }
    }
    return std::nullopt;
  }

  /// Mean of the points where an edge of one triangle meets the other, after test().
  std::array<double, 3> middle() {
    crossesPlanes();
    std::array<double, 3> sum = {0, 0, 0};
    int count = 0;
    const auto add = [&](const std::array<double, 3>& p) {
      ++count;
      for (int c = 0; c < 3; ++c) sum[c] += (p[c] - sum[c]) / count;  // a mean never overflows
    };
    for (int e = 0; e < 3; ++e) {
      eachMeeting(a_, side_a_, e, b_, add);
      eachMeeting(b_, side_b_, e, a_, add);
    }
    return sum;
  }

 private:
  /// Sides of every vertex with respect to the other plane; false if one plane has a triangle
  /// strictly on one side.
  bool crossesPlanes() {
    for (int i = 0; i < 3; ++i) side_b_[i] = signs_.orient3d(0, 1, 2, 3 + i);
    if (std::abs(side_b_[0] + side_b_[1] + side_b_[2]) == 3) return false;
    for (int i = 0; i < 3; ++i) side_a_[i] = signs_.orient3d(3, 4, 5, i);
    if (std::abs(side_a_[0] + side_a_[1] + side_a_[2]) == 3) return false;
    // A vertex beside a triangle's plane shows that there is one.
    a_.degenerate = !(side_b_[0] | side_b_[1] | side_b_[2]) && axisOf(a_) < 0;
    b_.degenerate = !(side_a_[0] | side_a_[1] | side_a_[2]) && axisOf(b_) < 0;
    return true;
  }

  /// Calls add() with the points where edge e of `face` meets `other`: a crossing of its plane, or
  /// a vertex in it and crossings with its edges.
  template <typename Add>
  void eachMeeting(const Face& face, const int* side, int e, const Face& other,
                   const Add& add) const {
    const int p = face.v[e], q = face.v[kNext[e]];
    const int sp = side[e], sq = side[kNext[e]];
    if (!other.degenerate && sp * sq != 0) {
      if (segmentMeetsFace(p, q, sp, sq, other)) {
        add(crossing(p, q, other));
      }
      return;
    }
    if (segmentMeetsFace(p, p, sp, sp, other)) add(points_[p]);
    for (int o = 0; o < 3; ++o) {
      const int r = other.v[o], s = other.v[kNext[o]];
      if (segmentsMeet(p, q, r, s)) add(meetingPoint(p, q, r, s));
    }
  }

  bool edgeMeets(const Face& face, const int* side, int e, const Face& other,
                 std::array<double, 3>& point) const {
    const int n = kNext[e];
    if (!segmentMeetsFace(face.v[e], face.v[n], side[e], side[n], other)) return false;
    if (!other.degenerate && side[e] * side[n] < 0) {
      point = crossing(face.v[e], face.v[n], other);
      return true;
    }
    bool located = false;
    eachMeeting(face, side, e, other, [&](const std::array<double, 3>& p) {
      if (!located) point = p;
      located = true;
    });
    if (!located) point = points_[face.v[n]];  // coplanar, the end alone lies in the face
    return true;
  }

  /// Segment p q, whose ends lie on sides sp, sq of the face's plane.
  bool segmentMeetsFace(int p, int q, int sp, int sq, const Face& f) const {
    if (f.degenerate) {
      for (int e = 0; e < 3; ++e) {
        if (segmentsMeet(p, q, f.v[e], f.v[kNext[e]])) return true;
      }
      return false;
    }
    if (sp * sq > 0) return false;
    if (sp == 0 && sq == 0) return coplanarSegmentMeetsFace(p, q, f);
    // The line meets the plane in one point of the segment; inside if it passes all edges alike.
    bool left = false, right = false;
    for (int e = 0; e < 3; ++e) {
      const int s = signs_.orient3d(p, q, f.v[e], f.v[kNext[e]]);
      left |= s > 0;
      right |= s < 0;
      if (left && right) return false;
    }
    return true;
  }

  int axisOf(const Face& f) const { return signs_.projectionAxis(f.v[0], f.v[1], f.v[2]); }

  bool coplanarSegmentMeetsFace(int p, int q, const Face& f) const {
    const int axis = axisOf(f);
    bool left = false, right = false;
    for (int e = 0; e < 3; ++e) {
      const int r = f.v[e], s = f.v[kNext[e]];
      if (segmentsMeetInPlane(p, q, r, s, axis)) return true;
      const int side = signs_.orient2d(r, s, p, axis);
      left |= side > 0;
      right |= side < 0;
    }
    return !(left && right);
  }

  /// Segments in a plane whose projection along `axis` is one to one.
  bool segmentsMeetInPlane(int p, int q, int r, int s, int axis) const {
    const int o1 = signs_.orient2d(p, q, r, axis), o2 = signs_.orient2d(p, q, s, axis);
    const int o3 = signs_.orient2d(r, s, p, axis), o4 = signs_.orient2d(r, s, q, axis);
    if ((o1 | o2 | o3 | o4) == 0) return boxesMeet(p, q, r, s);
    return o1 * o2 <= 0 && o3 * o4 <= 0;
  }

  /// Segments in space, either or both of which may be points.
  bool segmentsMeet(int p, int q, int r, int s) const {
    if (signs_.orient3d(p, q, r, s) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (signs_.cross2d(p, q, r, s, axis) != 0) return segmentsMeetInPlane(p, q, r, s, axis);
    }
    for (int axis = 0; axis < 3; ++axis) {  // parallel, or points: they must be collinear
      if (signs_.orient2d(p, q, r, axis) != 0 || signs_.orient2d(p, q, s, axis) != 0 ||
          signs_.orient2d(r, s, p, axis) != 0) {
        return false;
      }
    }
    return boxesMeet(p, q, r, s);
  }

  bool boxesMeet(int p, int q, int r, int s) const {
    for (int c = 0; c < 3; ++c) {
      const bool apart_below = !signs_.notAbove(r, p, c) && !signs_.notAbove(r, q, c) &&
                               !signs_.notAbove(s, p, c) && !signs_.notAbove(s, q, c);
      const bool apart_above = !signs_.notAbove(p, r, c) && !signs_.notAbove(p, s, c) &&
                               !signs_.notAbove(q, r, c) && !signs_.notAbove(q, s, c);
      if (apart_below || apart_above) return false;
    }
    return true;
  }

  /// Where p q crosses the plane of f, on whose two sides its ends lie.
  std::array<double, 3> crossing(int p, int q, const Face& f) const {
    return between(p, q, signs_.crossing3d(p, q, f.v[0], f.v[1], f.v[2]));
  }

  /// A common point of two segments that meet.
  std::array<double, 3> meetingPoint(int p, int q, int r, int s) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (signs_.cross2d(p, q, r, s, axis) == 0) continue;
      return between(p, q, signs_.crossing2d(p, q, r, s, axis));
    }
    // Collinear: an end of one lies within the other.
    for (const int end : {r, s}) {
      if (boxesMeet(p, q, end, end)) return points_[end];
    }
    return points_[p];
  }

  std::array<double, 3> between(int p, int q, double t) const {
    std::array<double, 3> point;
    for (int c = 0; c < 3; ++c) {
      const double a = points_[p][c], b = points_[q][c];
      point[c] = t < 0.5 ? a + t * (b - a) : b + (1 - t) * (a - b);
    }
    return point;
  }

  const PairPredicates::Coordinates& points_;
  const PairPredicates signs_;
  Face a_ = {{0, 1, 2}}, b_ = {{3, 4, 5}};
  int side_a_[3], side_b_[3];
};

template <typename S>
PairPredicates::Coordinates coordinates(const TriangleVertices<S>& a,
                                        const TriangleVertices<S>& b) {
  PairPredicates::Coordinates all;
  for (int i = 0; i < 3; ++i) {
    all[i] = {a[i][0], a[i][1], a[i][2]};
    all[3 + i] = {b[i][0], b[i][1], b[i][2]};
  }
  return all;
}

template <typename S>
bool boxesApart(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  for (int c = 0; c < 3; ++c) {
    const auto [low_a, high_a] = std::minmax({a[0][c], a[1][c], a[2][c]});
    const auto [low_b, high_b] = std::minmax({b[0][c], b[1][c], b[2][c]});
    if (high_a < low_b || high_b < low_a) return true;
  }
  return false;
}

}  // namespace

template <typename S>
bool trianglesIntersect(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  if (boxesApart(a, b)) return false;
  return PairIntersection(coordinates(a, b)).test();
}

template <typename S>
bool commonPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b, Point<S>& point) {
  if (boxesApart(a, b)) return false;
  const auto found = PairIntersection(coordinates(a, b)).anyPoint();
  if (found) {
    for (int c = 0; c < 3; ++c) point[c] = static_cast<S>((*found)[c]);
  }
  return found.has_value();
}

template <typename S>
Point<S> intersectionPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const auto point = PairIntersection(coordinates(a, b)).middle();
  return {static_cast<S>(point[0]), static_cast<S>(point[1]), static_cast<S>(point[2])};
}

template bool trianglesIntersect(const TriangleVertices<double>&, const TriangleVertices<double>&);
template bool trianglesIntersect(const TriangleVertices<float>&, const TriangleVertices<float>&);
template bool commonPoint(const TriangleVertices<double>&, const TriangleVertices<double>&,
                          Point<double>&);
template bool commonPoint(const TriangleVertices<float>&, const TriangleVertices<float>&,
                          Point<float>&);
template Point<double> intersectionPoint(const TriangleVertices<double>&,
                                         const TriangleVertices<double>&);
template Point<float> intersectionPoint(const TriangleVertices<float>&,
                                        const TriangleVertices<float>&);

}  // namespace kios
