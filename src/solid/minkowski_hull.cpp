// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/minkowski_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include "query/shape_search.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds a polytope whose faces are triangles of points, wound outwards.
class Polytope {
 public:
  struct Face {
    std::array<int, 3> v;
    Vec normal;     ///< unit, or zero
    double height;  ///< of the plane over the origin
  };

  explicit Polytope(const std::array<Vec, 4>& tetrahedron)
      : points_(tetrahedron.begin(), tetrahedron.end()) {
    const Vec u = points_[1] - points_[0], v = points_[2] - points_[0], w = points_[3] - points_[0];
    if (u.cross(v).dot(w) > 0) std::swap(points_[1], points_[2]);  // face 0 1 2 looks away from 3
    addFace(0, 1, 2);
    addFace(1, 0, 3);
    addFace(2, 1, 3);
    addFace(0, 2, 3);
  }

  const Vec& point(int i) const { return points_[static_cast<std::size_t>(i)]; }

  /// Returns the face nearest to the origin; nullptr if rounding left none.
  const Face* lowest() const {
    const auto lower = [](const Face& a, const Face& b) { return a.height < b.height; };
    const auto face = std::min_element(faces_.begin(), faces_.end(), lower);
    return face == faces_.end() ? nullptr : &*face;
  }

  /// Adds a point: faces from the border of those that see it take their place.
  void add(const Vec& p, double tolerance) {
    const int at = static_cast<int>(points_.size());
    points_.push_back(p);
    const auto seen = std::partition(faces_.begin(), faces_.end(), [&](const Face& f) {
      return f.normal.dot(p) - f.height <= tolerance;
    });
    std::vector<std::pair<int, int>> border;
    for (auto f = seen; f != faces_.end(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair<int, int> edge = {f->v[k], f->v[(k + 1) % 3]};
        const auto back =
            std::find(border.begin(), border.end(), std::pair(edge.second, edge.first));
        if (back == border.end()) {
          border.push_back(edge);
        } else {
          border.erase(back);
        }
      }
    }
    faces_.erase(seen, faces_.end());
    for (const auto& [from, to] : border) addFace(from, to, at);
  }

  // The faces are a closed surface of triangles with corners in the points, as new ones pass each
  // edge as those did that went: so it winds round nothing outside their hull.
  // Round the origin it winds if all faces are seen from within there, and so it does round all
  // points nearer than the nearest face. The corners of a face are at least m high along any unit
  // vector n, and so is all of it, and m from the origin.
  double certifiedRadius(double error) const {
    double radius = faces_.empty() ? 0 : kInfinity;
    for (const Face& f : faces_) {
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
  void addFace(int i, int j, int k) {
    const Vec &p = point(i), &q = point(j), &r = point(k);
    const Vec cross = (q - p).cross(r - p);
    const double length = cross.norm();
    const Vec n = length > 0 ? Vec(cross / length) : Vec(Vec::Zero());
    faces_.push_back({{i, j, k}, n, (n.dot(p) + n.dot(q) + n.dot(r)) / 3});
  }

  std::vector<Vec> points_;
  std::vector<Face> faces_;
};

/// Finds four points that span the set, or none if it is flat.
bool spanningPoints(const Differences& set, double size, std::array<Differences::Point, 4>& p) {
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

Differences::Differences(const SolidPair& pair)
    : X_AB_(pair.frame().X_AB),
      a_(pair.a()),
      b_(pair.b()),
      graph_a_(pair.convexityA().graph),
      graph_b_(pair.convexityB().graph),
      error_(0x1p-46 * (a_.largest() + 2 * b_.largest() + X_AB_.T().cwiseAbs().maxCoeff())) {}

Differences::Point Differences::farthest(const Vec& n, const Point& near) const {
  Point point = near;
  const Vec down = -(X_AB_.R().transpose() * n);
  point.a = graph_a_.climb(n, near.a);
  point.b = graph_b_.climb(down, near.b);
  point.at = graph_a_.point(point.a) - X_AB_ * graph_b_.point(point.b);
  return point;
}

double Differences::height(const Vec& n) const {
  const Vec down = -(X_AB_.R().transpose() * n);
  return n.dot(farthestVertex(a_, n) - X_AB_ * farthestVertex(b_, down)) + 2 * error_;
}

HullDepth hullDepth(const Differences& set, double size, double rel_gap, int max_points) {
  HullDepth result;
  std::array<Differences::Point, 4> start;
  if (!spanningPoints(set, size, start)) return result;
  Polytope polytope({start[0].at, start[1].at, start[2].at, start[3].at});
  std::vector<Differences::Point> points(start.begin(), start.end());
  if (polytope.point(1) != start[1].at) std::swap(points[1], points[2]);
  result.upper = kInfinity;
  // Tilted by a little, a direction has one extreme point, and that is a corner of the hull: no
  // three of them lie on a line, and no face is a segment.
  const Vec tilt = 1e-10 * Vec(0.2672612419124244, -0.8017837257372732, 0.5345224838248488);
  const double tolerance = 1e-14 * size + set.error();
  for (int i = 0; i < max_points; ++i) {
    const Polytope::Face* const lowest = polytope.lowest();
    if (!lowest || lowest->normal.isZero(0)) break;
    const Polytope::Face face = *lowest;
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
    polytope.add(point.at, tolerance);
  }
  result.lower = polytope.certifiedRadius(set.error());
  return result;
}

}  // namespace kios
