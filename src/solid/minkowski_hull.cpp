// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/minkowski_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include "query/ray_walk.h"
#include "solid/support_point.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds a polytope whose faces are triangles of points, wound outwards.
class Polytope {
 public:
  struct Face {
    std::array<int, 3> v, next;  ///< next[i]: the face across the edge from v[i] to v[i + 1]
    Vec normal;                  ///< unit, or zero
    double height;               ///< of the plane over the origin
    bool alive = true;
  };

  explicit Polytope(const std::array<Vec, 4>& tetrahedron)
      : points_(tetrahedron.begin(), tetrahedron.end()) {
    const Vec u = points_[1] - points_[0], v = points_[2] - points_[0], w = points_[3] - points_[0];
    if (u.cross(v).dot(w) > 0) std::swap(points_[1], points_[2]);  // face 0 1 2 looks away from 3
    addFace(0, 1, 2, {1, 2, 3});
    addFace(1, 0, 3, {0, 3, 2});
    addFace(2, 1, 3, {0, 1, 3});
    addFace(0, 2, 3, {0, 2, 1});
  }

  const std::vector<Face>& faces() const { return faces_; }
  const Vec& point(int i) const { return points_[static_cast<std::size_t>(i)]; }

  int lowest() const {
    int best = -1;
    for (int i = 0; i < static_cast<int>(faces_.size()); ++i) {
      if (face(i).alive && (best < 0 || face(i).height < face(best).height)) best = i;
    }
    return best;
  }

  /// Adds a point beyond face `seen`. False if that leaves no polytope, to rounding.
  bool add(const Vec& p, int seen, double tolerance) {
    const int at = static_cast<int>(points_.size());
    points_.push_back(p);
    // What sees the point is one piece around `seen`, and its border one loop.
    std::vector<int> waiting = {seen};
    mutableFace(seen).alive = false;
    struct Border {
      int from, to, outer;
    };
    std::vector<Border> border;
    while (!waiting.empty()) {
      const int i = waiting.back();
      waiting.pop_back();
      const Face f = face(i);
      for (int k = 0; k < 3; ++k) {
        const Face& other = face(f.next[k]);
        if (!other.alive) continue;
        if (other.normal.dot(p) - other.height > tolerance) {
          mutableFace(f.next[k]).alive = false;
          waiting.push_back(f.next[k]);
        }
      }
      for (int k = 0; k < 3; ++k) border.push_back({f.v[k], f.v[(k + 1) % 3], f.next[k]});
    }
    border.erase(std::remove_if(border.begin(), border.end(),
                                [this](const Border& b) { return !face(b.outer).alive; }),
                 border.end());
    if (border.size() < 3) return false;
    for (std::size_t i = 0; i + 1 < border.size(); ++i) {
      std::size_t j = i + 1;
      while (j < border.size() && border[j].from != border[i].to) ++j;
      if (j == border.size()) return false;
      std::swap(border[i + 1], border[j]);
    }
    if (border.back().to != border.front().from) return false;
    const int first = static_cast<int>(faces_.size()), n = static_cast<int>(border.size());
    for (int i = 0; i < n; ++i) {
      const Border& b = border[static_cast<std::size_t>(i)];
      addFace(b.from, b.to, at, {b.outer, first + (i + 1) % n, first + (i + n - 1) % n});
      Face& outer = mutableFace(b.outer);
      for (int k = 0; k < 3; ++k) {
        if (outer.v[k] == b.to && outer.v[(k + 1) % 3] == b.from) outer.next[k] = first + i;
      }
    }
    return true;
  }

  // The faces are a closed surface of triangles with corners in the points, so that it winds round
  // nothing outside their hull. Round the origin it winds if all faces are seen from within there,
  // and so it does round all points nearer than the nearest face. The corners of a face are at
  // least m high along any unit vector n, and so is all of it, and m from the origin.
  double certifiedRadius(double error) const {
    double radius = kInfinity;
    for (const Face& f : faces_) {
      if (!f.alive) continue;
      const Vec &p = point(f.v[0]), &q = point(f.v[1]), &r = point(f.v[2]);
      const double m =
          std::min({f.normal.dot(p), f.normal.dot(q), f.normal.dot(r)}) / (1 + 0x1p-48);
      const double volume = p.dot(q.cross(r));
      const double lengths = p.norm() * q.norm() * r.norm();
      const double room =
          0x1p-48 * lengths +
          2 * error * (p.norm() * q.norm() + q.norm() * r.norm() + r.norm() * p.norm());
      if (!(volume > room)) return 0;
      radius = std::min(radius, m - error - 0x1p-50 * (p.norm() + q.norm() + r.norm()));
    }
    return std::max(0.0, radius);
  }

 private:
  const Face& face(int i) const { return faces_[static_cast<std::size_t>(i)]; }
  Face& mutableFace(int i) { return faces_[static_cast<std::size_t>(i)]; }

  void addFace(int i, int j, int k, const std::array<int, 3>& next) {
    const Vec &p = point(i), &q = point(j), &r = point(k);
    const Vec cross = (q - p).cross(r - p);
    const double length = cross.norm();
    Face f;
    f.v = {i, j, k};
    f.next = next;
    f.normal = length > 0 ? Vec(cross / length) : Vec(Vec::Zero());
    f.height = (f.normal.dot(p) + f.normal.dot(q) + f.normal.dot(r)) / 3;
    faces_.push_back(f);
  }

  std::vector<Vec> points_;
  std::vector<Face> faces_;
};

/// Finds four points that span the set, or none if it is flat.
template <typename S>
bool spanningPoints(const Differences<S>& set, double size,
                    std::array<typename Differences<S>::Point, 4>& p) {
  const double flat = 1e-9 * size;
  const auto farthest = [&](const Vec& n, int near) {
    return set.farthest(n, p[static_cast<std::size_t>(near)]);
  };
  const Vec x(0.80178372573727319, 0.53452248382484879, 0.26726124191242440);
  p[0] = farthest(x, 0);
  p[1] = farthest(-x, 0);
  Vec line = p[1].at - p[0].at;
  if (!(line.norm() > flat)) return false;
  line.normalize();
  const Vec y = line.unitOrthogonal();
  const auto offLine = [&](const Vec& q) { return (q - p[0].at).cross(line).norm(); };
  const auto q1 = farthest(y, 0), q2 = farthest(-y, 1);
  p[2] = offLine(q1.at) > offLine(q2.at) ? q1 : q2;
  if (!(offLine(p[2].at) > flat)) return false;
  const Vec n = line.cross(p[2].at - p[0].at).normalized();
  const auto offPlane = [&](const Vec& q) { return std::abs(n.dot(q - p[0].at)); };
  const auto r1 = farthest(n, 0), r2 = farthest(-n, 1);
  p[3] = offPlane(r1.at) > offPlane(r2.at) ? r1 : r2;
  return offPlane(p[3].at) > flat;
}

}  // namespace

template <typename S>
Differences<S>::Differences(const SolidPair<S>& pair)
    : pair_(pair),
      a_(pair.frame().a),
      b_(pair.frame().b),
      graph_a_(pair.stateA().convexity(a_).graph),
      graph_b_(pair.stateB().convexity(b_).graph),
      error_(0x1p-46 * (largestOf(a_) + 2 * largestOf(b_) + pair.T_AB().cwiseAbs().maxCoeff())) {}

template <typename S>
typename Differences<S>::Point Differences<S>::farthest(const Vec& n, const Point& near) const {
  Point point = near;
  Vec p, q;
  if (graph_a_.empty()) {
    p = a_.vertices[supportPoint(a_, n).vertex].template cast<double>();
  } else {
    point.a = graph_a_.climb(n, near.a);
    p = graph_a_.point(point.a);
  }
  if (graph_b_.empty()) {
    q = b_.vertices[supportPoint<S>(b_, -inB(n)).vertex].template cast<double>();
  } else {
    point.b = graph_b_.climb(-inB(n), near.b);
    q = graph_b_.point(point.b);
  }
  point.at = p - inA(q);
  return point;
}

template <typename S>
double Differences<S>::height(const Vec& n) const {
  const Vec p = a_.vertices[supportPoint(a_, n).vertex].template cast<double>();
  const Vec q = b_.vertices[supportPoint<S>(b_, -inB(n)).vertex].template cast<double>();
  return n.dot(p - inA(q)) + 2 * error_;
}

template <typename S>
HullDepth hullDepth(const Differences<S>& set, double size, double rel_gap, int max_points) {
  HullDepth result;
  std::array<typename Differences<S>::Point, 4> start;
  if (!spanningPoints(set, size, start)) return result;
  Polytope polytope({start[0].at, start[1].at, start[2].at, start[3].at});
  std::vector<typename Differences<S>::Point> points(start.begin(), start.end());
  if (polytope.point(1) != start[1].at) std::swap(points[1], points[2]);
  result.upper = kInfinity;
  // Tilted by a little, a direction has one extreme point, and that is a corner of the hull: no
  // three of them lie on a line, and no face is a segment.
  const Vec tilt = 1e-10 * Vec(0.2672612419124244, -0.8017837257372732, 0.5345224838248488);
  const double tolerance = 1e-14 * size + set.error();
  for (int i = 0; i < max_points; ++i) {
    const int lowest = polytope.lowest();
    const Polytope::Face face = polytope.faces()[static_cast<std::size_t>(lowest)];
    if (face.normal.isZero(0)) break;
    const Vec n = (face.normal + tilt).normalized();
    const auto point = set.farthest(n, points[static_cast<std::size_t>(face.v[0])]);
    const double height = face.normal.dot(point.at);
    if (height < result.upper) {
      result.upper = height;
      result.normal = face.normal;
    }
    if (!(height > set.error())) return result;  // the hulls are apart, or as good as
    if (face.height > 0 && result.upper <= (1 + rel_gap) * face.height) break;
    if (face.normal.dot(point.at) - face.height <= 4 * tolerance) break;
    points.push_back(point);
    if (!polytope.add(point.at, lowest, tolerance)) return result;
  }
  result.lower = polytope.certifiedRadius(set.error());
  return result;
}

KIOS_INSTANTIATE_CLASS(Differences);
KIOS_INSTANTIATE_FUNCTION(hullDepth);

}  // namespace kios
