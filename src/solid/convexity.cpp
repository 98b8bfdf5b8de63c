// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/convexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include "fcl_kios/detail/rigid.h"
#include "solid/containment.h"
#include "triangle/determinant.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// Holds a mesh as seen from a point within, its vertices welded. Triangles with two equal corners
/// are left out: they pass an edge once each way.
class ConeMesh {
 public:
  explicit ConeMesh(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = mesh.weld();
    std::vector<int> number(mesh.numVertices(), -1);
    faces_.reserve(mesh.numTriangles());
    for (std::size_t t = 0; t < mesh.numTriangles(); ++t) {
      std::array<std::uint32_t, 3> v;
      for (std::size_t k = 0; k < 3; ++k) v[k] = welded[mesh.index(t, k)];
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      std::array<int, 3>& face = faces_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (number[v[k]] < 0) {
          number[v[k]] = static_cast<int>(points_.size());
          points_.push_back(mesh.vertex(v[k]));
        }
        face[k] = number[v[k]];
      }
    }
    center_ = middle();
    for (const Vec& p : points_) farthest_ = std::max(farthest_, (p - center_).norm());
    farthest_ *= 1 + 0x1p-40;
    measureBox(mesh.tree().root_box);
  }

  const Vec& center() const { return center_; }
  /// No vertex is farther from the centre.
  double farthest() const { return farthest_; }

  /// Measures six times the volume of each face's cone, at least. False if one may not be positive.
  bool measureCones() {
    cones_.reserve(faces_.size());
    for (const auto& face : faces_) {
      const auto [six, error] = sixVolumes(center_, point(face[0]), point(face[1]), point(face[2]));
      if (!(six > error)) return false;
      cones_.push_back(six - error);
    }
    return !cones_.empty();
  }

  /// False unless all edges have two faces, each of which runs through it one way.
  bool pairSides() {
    sides_ = sidesOf(faces_.size(), [this](std::size_t f) { return faces_[f]; });
    bool paired = true;
    forEdges(sides_, [&](std::size_t begin, std::size_t end) {
      paired &= end - begin == 2 && sides_[begin].forward != sides_[begin + 1].forward;
    });
    return paired;
  }

  /// E, or something above `most`.
  double measureReflex(double most) const {
    double reflex = 0;
    for (std::size_t i = 0; i < sides_.size() && reflex <= most; i += 2) {
      const Side *side = &sides_[i], *twin = &sides_[i + 1];
      if (!side->forward) std::swap(side, twin);
      const Vec &p = point(side->low), &q = point(side->high);
      const auto [above, error] = sixVolumes(p, q, opposite(*side), opposite(*twin));
      if (above <= -error) continue;
      reflex += 1.01 * (above + error) / cones_[at(side->triangle)] *
                (farthestFromPlane(p - center_, q - center_) / cones_[at(twin->triangle)]);
    }
    return reflex;
  }

  VertexGraph graph() && { return {std::move(points_), sides_}; }

 private:
  /// Bounds the error of determinants of differences of coordinates, relative to the product of
  /// their lengths.
  static constexpr double kError = 0x1p-48;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Vec& point(int i) const { return points_[at(i)]; }
  const Vec& opposite(const Side& s) const {
    return point(faces_[at(s.triangle)][(s.corner + 2U) % 3]);
  }

  /// Returns the surface's centre, which lies well within a convex solid.
  Vec middle() const {
    Vec sum = Vec::Zero();
    double weight = 0;
    for (const auto& f : faces_) {
      const Vec &p = point(f[0]), &q = point(f[1]), &r = point(f[2]);
      const double area = (q - p).cross(r - p).norm();
      sum += area * ((p - point(0)) + (q - point(0)) + (r - point(0))) / 3;
      weight += area;
    }
    return weight > 0 ? Vec(point(0) + sum / weight) : Vec(Vec::Zero());
  }

  /// Bounds |p x q| times the largest distance of a vertex from the plane through the centre, p and
  /// q, all relative to it: at most that of a corner of the box.
  double farthestFromPlane(const Vec& p, const Vec& q) const {
    const Vec normal = p.cross(q);
    const double error = kError * p.norm() * q.norm();
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (std::abs(normal.dot(axes_.col(i))) + error) * half_[i];
    return sum;
  }

  /// (q - p) x (a - p) . (b - p) and a bound of its error: in twofold numbers where doubles can't
  /// tell the sign. Where lengths are below 2^-260 these can't either.
  static std::pair<double, double> sixVolumes(const Vec& p, const Vec& q, const Vec& a,
                                              const Vec& b) {
    const Vec u = q - p, v = a - p, w = b - p;
    const double rounded = u.cross(v).dot(w), error = kError * u.norm() * v.norm() * w.norm();
    if (std::abs(rounded) > error) return {rounded, error};
    Twofold d[3][3];
    for (int c = 0; c < 3; ++c) {
      d[c][0] = twofoldDifference(q[c], p[c]);
      d[c][1] = twofoldDifference(a[c], p[c]);
      d[c][2] = twofoldDifference(b[c], p[c]);
    }
    const TwofoldDeterminant fine = determinant(d);
    return {fine.rounded(), fine.error()};
  }

  /// Thin solids fill the box, however they are turned, so that E tells how thick a dent is
  /// relative to them.
  void measureBox(const engine::Box& box) {
    const auto axis = [&](int i) { return Vec(box.x[i], box.y[i], box.z[i]); };
    axes_.col(0) = axis(0).normalized();
    axes_.col(2) = axis(0).cross(axis(1)).normalized();
    axes_.col(1) = axes_.col(2).cross(axes_.col(0)).normalized();
    for (const Vec& point : points_) {
      half_ = half_.cwiseMax((axes_.transpose() * (point - center_)).cwiseAbs());
    }
    // Axes that are orthonormal to rounding, and rounded products.
    half_.array() += kError * farthest_;
  }

  std::vector<Vec> points_;
  std::vector<std::array<int, 3>> faces_;
  std::vector<double> cones_;
  std::vector<Side> sides_;
  Vec center_;
  double farthest_ = 0;
  Eigen::Matrix3d axes_;
  Vec half_ = Vec::Zero();  ///< extents of the box about the centre, along the axes
};

}  // namespace

VertexGraph::VertexGraph(std::vector<Vec> points, const std::vector<Side>& sides)
    : points_(std::move(points)), begin_(points_.size() + 1, 0), neighbours_(sides.size()) {
  const auto from = [](const Side& s) {
    return static_cast<std::size_t>(s.forward ? s.low : s.high);
  };
  for (const Side& s : sides) ++begin_[from(s) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (const Side& s : sides) {
    neighbours_[static_cast<std::size_t>(next[from(s)]++)] = s.forward ? s.high : s.low;
  }
}

int VertexGraph::climb(const fcl::Vector3d& n, int start) const {
  int best = start;
  double height = detail::dot(n, point(start));
  for (bool higher = true; higher;) {
    higher = false;
    const auto at = static_cast<std::size_t>(best);
    for (int i = begin_[at]; i < begin_[at + 1]; ++i) {
      const int next = neighbours_[static_cast<std::size_t>(i)];
      const double h = detail::dot(n, point(next));
      if (!(h > height)) continue;
      height = h;
      best = next;
      higher = true;
    }
  }
  return best;
}

Convexity measureConvexity(const Mesh& mesh) {
  constexpr double kMost = 0x1p-20;
  ConeMesh cones(mesh);
  if (!cones.measureCones() || !cones.pairSides()) return {};
  const double reflex = cones.measureReflex(kMost);
  if (!(reflex <= kMost)) return {};
  SearchCounts unused;
  if (placeOf(cones.center(), mesh, unused).winding != 1) return {};
  Convexity result;
  result.convex = true;
  result.moved = reflex * cones.farthest();
  result.graph = std::move(cones).graph();
  return result;
}

}  // namespace kios
