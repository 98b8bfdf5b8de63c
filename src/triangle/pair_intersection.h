// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fcl_kios/triangle.h"
#include "triangle/predicates.h"

namespace kios {

/// Vertices of a triangle of a pair, and their sides of the other's plane.
struct PairFace {
  int v[3];
  std::array<int, 3> side;
  bool degenerate = false;  ///< no area: the triangle is the segment from v[0] to v[1]

  bool isBeside() const { return std::abs(side[0] + side[1] + side[2]) == 3; }
  bool inPlane() const { return (side[0] | side[1] | side[2]) == 0; }
  bool straddles() const {
    const auto [least, most] = std::minmax({side[0], side[1], side[2]});
    return least < 0 && most > 0;
  }
};

/// Closed intersection tests between the parts of two triangles, by vertex index.
class PairIntersection {
 public:
  using Coordinates = std::array<double, 3>;

  explicit PairIntersection(const PairPredicates::Coordinates& points)
      : points_(points), signs_(points) {}

  bool intersect() {
    if (!crossesPlanes()) return false;
    if (a_.degenerate) return segmentMeetsFace(a_.v[0], a_.v[1], a_.side[0], a_.side[1], b_);
    if (b_.degenerate) return segmentMeetsFace(b_.v[0], b_.v[1], b_.side[0], b_.side[1], a_);
    return a_.inPlane() ? coplanarMeet() : intervalsMeet();
  }

  /// How two triangles with areas, which intersect, do so.
  Meeting meeting() {
    crossesPlanes();
    if (a_.inPlane()) return shareArea() ? Meeting::kOverlap : Meeting::kTouch;
    // Only what has vertices on both sides of either plane passes through it.
    if (!a_.straddles() || !b_.straddles()) return Meeting::kTouch;
    return intervalsMeet(false) ? Meeting::kCross : Meeting::kTouch;
  }

  /// Mean of the points where an edge of one of two triangles that intersect meets the other.
  Coordinates middle() {
    crossesPlanes();
    Coordinates sum = {0, 0, 0};
    int count = 0;
    const auto add = [&](const Coordinates& p) {
      ++count;
      for (int c = 0; c < 3; ++c) sum[c] += (p[c] - sum[c]) / count;  // a mean never overflows
    };
    for (int e = 0; e < 3; ++e) {
      eachMeeting(a_, e, b_, add);
      eachMeeting(b_, e, a_, add);
    }
    return sum;
  }

 private:
  /// Sides of every vertex with respect to the other plane; false if one plane has a triangle
  /// strictly on one side.
  bool crossesPlanes() {
    // The plane of the larger one is that which tells more often.
    const bool larger = sizeOf(a_) >= sizeOf(b_);
    PairFace &first = larger ? b_ : a_, &second = larger ? a_ : b_;
    findSides(first, second);
    if (first.isBeside()) return false;
    // A vertex beside a triangle's plane shows that there is one. What lies in it is coplanar.
    if (first.inPlane()) findDegenerate(second);
    if (first.inPlane() && !second.degenerate) {
      second.side = {0, 0, 0};
    } else {
      findSides(second, first);
      if (second.isBeside()) return false;
    }
    if (second.inPlane()) findDegenerate(first);
    return true;
  }

  double sizeOf(const PairFace& f) const {
    double size = 0;
    for (int c = 0; c < 3; ++c) {
      const double at = points_[f.v[0]][c];
      size += std::abs(points_[f.v[1]][c] - at) + std::abs(points_[f.v[2]][c] - at);
    }
    return size;
  }

  /// From a vertex of the plane: its differences are the plane's own, however small the triangle.
  void findSides(PairFace& f, const PairFace& plane) const {
    f.side = signs_.sides(f.v, plane.v[1], plane.v[0], plane.v[2]);
  }

  /// Collinear vertices lie along their line as they do by coordinates.
  void findDegenerate(PairFace& f) {
    if (axisOf(f) >= 0) return;
    f.degenerate = true;
    const auto order = [&](int i, int j) {
      if (!(points_[f.v[j]] < points_[f.v[i]])) return;
      std::swap(f.v[i], f.v[j]);
      std::swap(f.side[i], f.side[j]);
    };
    order(0, 2);
    order(0, 1);
    order(2, 1);
  }

  /// A face's two edges that cross the other's plane; they start in the vertex that is alone on its
  /// side.
  struct Interval {
    int alone, begin, end;  ///< of face.v
    bool above;             ///< the side of `alone`
  };
  static Interval intervalOf(const PairFace& f) {
    const auto alone = [&f](int i) {
      const int s = f.side[i], t = f.side[kNext[i]], u = f.side[kNext[kNext[i]]];
      return t * u >= 0 && (s == 0 ? t * u > 0 : s * (t + u) <= 0);
    };
    int i = 0;
    while (i < 2 && !alone(i)) ++i;
    const int j = kNext[i], k = kNext[j];
    return {i, j, k, f.side[i] > f.side[j] + f.side[k]};
  }

  /// Triangles in two planes: each meets the planes' common line in an interval. The orientation of
  /// an edge of a and one of b tells which meets the line first (Guigue and Devillers, "Fast and
  /// robust triangle-triangle overlap test using orientation predicates", 2003).
  /// Intervals that have but an end in common meet only if `closed`.
  bool intervalsMeet(bool closed = true) const {
    Interval a = intervalOf(a_), b = intervalOf(b_);
    if (a.above) std::swap(b.begin, b.end);
    if (!b.above) std::swap(a.begin, a.end);
    const auto order = [&](int end_a, int end_b) {  // along the line
      return signs_.orient3d(a_.v[a.alone], a_.v[end_a], b_.v[b.alone], b_.v[end_b]);
    };
    const int first = order(a.begin, b.end), last = order(a.end, b.begin);
    return first <= 0 && last >= 0 && (closed || first * last != 0);
  }

  /// Nothing separates two triangles of one plane if no edge of theirs does.
  bool coplanarMeet() const {
    const int axis = axisOf(a_);
    int in[3][3];
    return insides(a_, b_, axis, in) && insides(b_, a_, axis, in);
  }

  /// Whether the insides of two triangles of one plane meet: no edge has all of the other beyond
  /// it.
  bool shareArea() const {
    const int axis = axisOf(a_);
    const auto reaches = [&](const PairFace& f, const PairFace& other) {
      int in[3][3];
      return insides(f, other, axis, in) && std::all_of(in, in + 3, [](const int(&of_edge)[3]) {
               return *std::max_element(of_edge, of_edge + 3) > 0;
             });
    };
    return reaches(a_, b_) && reaches(b_, a_);
  }

  /// in[e][i]: the side of edge e of f on which vertex i of `other` lies, 1 inside. False if an
  /// edge separates the triangles.
  bool insides(const PairFace& f, const PairFace& other, int axis, int (&in)[3][3]) const {
    const int turn = signs_.orient2d(f.v[0], f.v[1], f.v[2], axis);
    for (int e = 0; e < 3; ++e) {
      for (int i = 0; i < 3; ++i) {
        in[e][i] = turn * signs_.orient2d(f.v[e], f.v[kNext[e]], other.v[i], axis);
      }
      if (in[e][0] + in[e][1] + in[e][2] == -3) return false;
    }
    return true;
  }

  /// Calls add() with the points where edge e of `face` meets `other`: a crossing of its plane, or
  /// a vertex in it and crossings with its edges.
  template <typename Add>
  void eachMeeting(const PairFace& face, int e, const PairFace& other, const Add& add) const {
    const int n = kNext[e], p = face.v[e], q = face.v[n];
    const int sp = face.side[e], sq = face.side[n];
    if (!other.degenerate && sp * sq != 0) {
      if (segmentMeetsFace(p, q, sp, sq, other)) add(crossing(face, e, n, other));
      return;
    }
    if (segmentMeetsFace(p, p, sp, sp, other)) add(points_[p]);
    for (int o = 0; o < 3; ++o) {
      const int r = other.v[o], s = other.v[kNext[o]];
      if (segmentsMeet(p, q, r, s)) add(meetingPoint(p, q, r, s));
    }
  }

  /// Segment p q, whose ends lie on sides sp, sq of the face's plane.
  bool segmentMeetsFace(int p, int q, int sp, int sq, const PairFace& f) const {
    if (f.degenerate) return segmentsMeet(p, q, f.v[0], f.v[1]);
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

  int axisOf(const PairFace& f) const { return signs_.projectionAxis(f.v[0], f.v[1], f.v[2]); }

  /// Nothing separates them if neither an edge nor the segment does.
  bool coplanarSegmentMeetsFace(int p, int q, const PairFace& f) const {
    const int axis = axisOf(f), turn = signs_.orient2d(f.v[0], f.v[1], f.v[2], axis);
    for (int e = 0; e < 3; ++e) {
      const int r = f.v[e], s = f.v[kNext[e]];
      if (turn * signs_.orient2d(r, s, p, axis) < 0 && turn * signs_.orient2d(r, s, q, axis) < 0) {
        return false;
      }
    }
    if (p == q) return true;
    int beside = 0;
    for (const int v : f.v) beside += signs_.orient2d(p, q, v, axis);
    return std::abs(beside) < 3;
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

  /// Returns the point where edge i j of `face`, whose ends aren't on one side, meets the plane of
  /// f.
  Coordinates crossing(const PairFace& face, int i, int j, const PairFace& f) const {
    const int p = face.v[i], q = face.v[j];
    if (face.side[i] == 0) return points_[p];
    if (face.side[j] == 0) return points_[q];
    return between(p, q, signs_.crossing3d(p, q, f.v[0], f.v[1], f.v[2]));
  }

  /// A common point of two segments that meet.
  Coordinates meetingPoint(int p, int q, int r, int s) const {
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

  Coordinates between(int p, int q, double t) const {
    Coordinates point;
    for (int c = 0; c < 3; ++c) {
      const double a = points_[p][c], b = points_[q][c];
      point[c] = t < 0.5 ? a + t * (b - a) : b + (1 - t) * (a - b);
    }
    return point;
  }

  const PairPredicates::Coordinates& points_;
  const PairPredicates signs_;
  PairFace a_ = {{0, 1, 2}, {}}, b_ = {{3, 4, 5}, {}};
};

}  // namespace kios
