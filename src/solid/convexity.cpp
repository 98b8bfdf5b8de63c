// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/convexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include "fcl_kios/volume/rigid.h"
#include "model/prepared.h"
#include "solid/winding.h"
#include "tree/weld.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;
using Fine = boost::multiprecision::cpp_bin_float_quad;

/// Holds a mesh as seen from a point within, its vertices welded. Triangles with two equal corners
/// are left out: they pass an edge once each way.
class ConeMesh {
 public:
  template <typename S>
  explicit ConeMesh(const engine::MeshView<S>& mesh) {
    const std::vector<std::uint32_t> welded = engine::weld(mesh);
    std::vector<int> number(mesh.num_vertices, -1);
    faces_.reserve(mesh.num_triangles);
    for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
      std::array<std::uint32_t, 3> v;
      for (std::size_t k = 0; k < 3; ++k) v[k] = welded[mesh.index(t, k)];
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      std::array<int, 3>& face = faces_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (number[v[k]] < 0) {
          number[v[k]] = static_cast<int>(points_.size());
          points_.push_back(mesh.vertices[v[k]].template cast<double>());
        }
        face[k] = number[v[k]];
      }
    }
    center_ = middle();
    for (const Vec& p : points_) farthest_ = std::max(farthest_, (p - center_).norm());
    farthest_ *= 1 + 0x1p-40;
    fitBox();
  }

  const Vec& center() const { return center_; }
  /// No vertex is farther from the centre.
  double farthest() const { return farthest_; }

  /// Measures six times the volume of each face's cone, at least. False if one may not be positive.
  bool measureCones() {
    cones_.reserve(faces_.size());
    for (const auto& face : faces_) {
      const Vec p = point(face[0]) - center_, q = point(face[1]) - center_,
                r = point(face[2]) - center_;
      const double lengths = p.norm() * q.norm() * r.norm();
      double volume = p.dot(q.cross(r)) - kError * lengths;
      if (!(volume > 0)) {
        volume = fineVolume(center_, point(face[0]), point(face[1]), point(face[2])) -
                 kFineError * lengths;
      }
      if (!(volume > 0)) return false;
      cones_.push_back(volume);
    }
    return !cones_.empty();
  }

  /// Sorts sides by the vertex from which they run. False unless all edges have two faces.
  bool pairSides() {
    begin_.assign(points_.size() + 1, 0);
    for (const auto& face : faces_) {
      for (const int v : face) ++begin_[at(v) + 1];
    }
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    to_.resize(3 * faces_.size());
    face_.resize(to_.size());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = at(next[at(faces_[f][k])]++);
        to_[i] = faces_[f][(k + 1) % 3];
        face_[i] = static_cast<int>(f);
      }
    }
    edges_.reserve(to_.size() / 2);
    for (int v = 0; v < static_cast<int>(points_.size()); ++v) {
      for (int i = begin_[at(v)]; i < begin_[at(v) + 1]; ++i) {
        // The other side is looked for at the end that has fewer: in all that takes O(n).
        const int w = to_[at(i)], fewer = degree(w) - degree(v);
        if (fewer > 0 || (fewer == 0 && w < v)) continue;
        int twin = -1;
        for (int j = begin_[at(w)]; j < begin_[at(w) + 1]; ++j) {
          if (to_[at(j)] != v) continue;
          if (twin >= 0) return false;
          twin = j;
        }
        if (twin < 0) return false;
        edges_.emplace_back(v, i, twin);
      }
    }
    return 2 * edges_.size() == to_.size();
  }

  /// Holds E, and its share of edges that are reflex beyond the rounding of doubles.
  struct Reflex {
    double sum = 0, certain = 0;
  };
  /// Where `fine`, edges that rounding alone may have bent are measured in 113 bits, which costs
  /// more; else they count as if they were as reflex as they may be. Ends where it exceeds
  /// `max_reflex`.
  Reflex measureReflex(bool fine, double max_reflex) const {
    Reflex reflex;
    for (const Edge& e : edges_) {
      const int v = e.from, w = to_[at(e.side)];
      const Vec &p = point(v), &q = point(w);
      const Vec &a = point(opposite(e.side, v, w)), &b = point(opposite(e.twin, v, w));
      const Vec along = q - p, in_a = a - p, in_b = b - p;
      const double lengths =
          std::sqrt(along.squaredNorm() * in_a.squaredNorm() * in_b.squaredNorm());
      double error = kError * lengths;
      double above = along.cross(in_a).dot(in_b);  // six times the volume of (p, q, a, b)
      if (above <= -error) continue;
      const bool certain = above > error;
      if (fine && !certain) {
        error = kFineError * lengths;
        above = fineVolume(p, q, a, b);
        if (above <= -error) continue;
      }
      const double term =
          1.01 * (above + error) / cones_[at(face_[at(e.side)])] *
          (farthestFromPlane(p - center_, q - center_) / cones_[at(face_[at(e.twin)])]);
      reflex.sum += term;
      if (certain) reflex.certain += term;
      if (!((fine ? reflex.sum : reflex.certain) <= max_reflex)) break;
    }
    return reflex;
  }

  VertexGraph graph() && { return {std::move(points_), std::move(begin_), std::move(to_)}; }

 private:
  /// Bounds the error of determinants of differences of coordinates, relative to the product of
  /// their lengths.
  static constexpr double kError = 0x1p-48;
  static constexpr double kFineError = 0x1p-100;

  struct Edge {
    int from, side, twin;
    Edge(int from, int side, int twin) : from(from), side(side), twin(twin) {}
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Vec& point(int i) const { return points_[at(i)]; }
  int degree(int v) const { return begin_[at(v) + 1] - begin_[at(v)]; }
  int opposite(int side, int v, int w) const {
    const auto& f = faces_[at(face_[at(side)])];
    return f[0] != v && f[0] != w ? f[0] : f[1] != v && f[1] != w ? f[1] : f[2];
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

  /// Returns (q - p) x (a - p) . (b - p), where doubles can't tell.
  static double fineVolume(const Vec& p, const Vec& q, const Vec& a, const Vec& b) {
    Fine d[3][3];
    const Vec* const ends[3] = {&q, &a, &b};
    for (int i = 0; i < 3; ++i) {
      for (int c = 0; c < 3; ++c) d[i][c] = Fine((*ends[i])[c]) - Fine(p[c]);
    }
    const Fine volume = d[2][0] * (d[0][1] * d[1][2] - d[0][2] * d[1][1]) +
                        d[2][1] * (d[0][2] * d[1][0] - d[0][0] * d[1][2]) +
                        d[2][2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
    return static_cast<double>(volume);
  }

  /// Fits a box around all vertices: along the way to the farthest, and to the farthest from that
  /// line. Thin solids fill it, however they are turned, so that E tells how thick a dent is
  /// relative to them.
  void fitBox() {
    const auto farthestFrom = [this](const auto& squared) {
      Vec found = Vec::Zero();
      double largest = 0;
      for (const Vec& point : points_) {
        const Vec v = point - center_;
        const double square = squared(v);
        if (!(square > largest)) continue;
        largest = square;
        found = v;
      }
      return found;
    };
    const Vec longest = farthestFrom([](const Vec& v) { return v.squaredNorm(); });
    if (!(longest.squaredNorm() > 0)) return;
    axes_.col(0) = longest.normalized();
    const Vec wide = farthestFrom(
        [this](const Vec& v) { return (v - v.dot(axes_.col(0)) * axes_.col(0)).squaredNorm(); });
    const Vec across = wide - wide.dot(axes_.col(0)) * axes_.col(0);
    axes_.col(1) =
        across.squaredNorm() > 0 ? Vec(across.normalized()) : axes_.col(0).unitOrthogonal();
    axes_.col(1) -= axes_.col(1).dot(axes_.col(0)) * axes_.col(0);
    axes_.col(1).normalize();
    axes_.col(2) = axes_.col(0).cross(axes_.col(1));
    for (const Vec& point : points_) {
      half_ = half_.cwiseMax((axes_.transpose() * (point - center_)).cwiseAbs());
    }
    // Axes that are orthonormal to rounding, and rounded products.
    half_.array() += kError * farthest_;
  }

  std::vector<Vec> points_;
  std::vector<std::array<int, 3>> faces_;
  std::vector<double> cones_;
  std::vector<int> begin_, to_, face_;  ///< sides, by the vertex from which they run
  std::vector<Edge> edges_;
  Vec center_;
  double farthest_ = 0;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
  Vec half_ = Vec::Zero();  ///< extents of the box about the centre, along the axes
};

}  // namespace

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

template <typename S>
Convexity measureConvexity(const Model<S>& model) {
  constexpr double kMost = 0x1p-20, kNothing = 0x1p-36;
  ConeMesh mesh(viewOf(model));
  if (!mesh.measureCones() || !mesh.pairSides()) return {};
  auto reflex = mesh.measureReflex(false, kMost);
  if (!(reflex.certain <= kMost)) return {};
  if (reflex.sum > kNothing) reflex = mesh.measureReflex(true, kMost);
  if (!(reflex.sum <= kMost)) return {};
  SearchCounts unused;
  if (placeOf(mesh.center(), model, unused).winding != 1) return {};
  Convexity result;
  result.convex = true;
  result.moved = reflex.sum * mesh.farthest();
  result.graph = std::move(mesh).graph();
  return result;
}

KIOS_INSTANTIATE_FUNCTION(measureConvexity);

}  // namespace kios
