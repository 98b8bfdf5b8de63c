// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "fcl_kios/points.h"
#include "model/prepared.h"
#include "query/point_batch.h"
#include "triangle/solid_angle.h"
#include "volume/balls.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Nodes are opened together that err by so much of the largest error: not measured.
constexpr double kOpened = 0.25;
/// A mesh is seen from so many of its sizes by less than any rounding.
constexpr double kFar = 0x1p60;
/// Nodes are not used from nearer, in units of the mesh, where fifth powers underflow.
constexpr double kNear = 0x1p-150;
constexpr double kPi = 3.141592653589793;

/// Where one index is there twice, that and the other; xyz last.
constexpr int monomial(int i, int j, int k) {
  return i == j ? 3 * i + k : (i == k ? 3 * i + j : (j == k ? 3 * j + i : 9));
}

/// What a node's triangles look like from afar, about a point c.
///
/// The number is the integral of n f(x) / 4 pi over the surface, n the normal, f(x) = -grad u,
/// u = 1 / |x - p|. With d = c - p, R = |d|, y = x - c, the integrals N of n, M of y n^T and T of
/// n y y, Taylor's series of f about c gives
///   4 pi w = N d / R^3 - 3 M(d, d) / R^5 + 7.5 T(d, d, d) / R^7 + rest,
/// where M and T are without their parts in |d|^2, of which a harmonic u knows nothing. The kth
/// derivative of u at distance s is at most k! / s^(k+1) along any k unit vectors: along k equal
/// ones it is k! P_k / s^(k+1), |P_k| <= 1 a Legendre polynomial, and a symmetric form on a
/// Euclidean space is largest for equal vectors (Banach 1938). So N alone errs by a r / (2 pi (R -
/// r)^3) at most, a the area and r the radius; all three by the fourth derivative times |y|^3 / 3!,
/// in all r `spread` / (pi (R - r)^5), `spread` the integral of |y|^2.
///
/// Rounding: let W be the sum of |e| |f| of the triangles, e and f two edges, which bounds twice
/// the area also of needles, whose normal e x f / 2 is known to 3 u W only. The terms of N, M and T
/// are at most (1 + 3 + 7.5) W / (4 pi R^2) < W / R^2, since r < R. One is rounded at most 40 times
/// on its way to a parent's moments, and once more for every other child that is added; a child's
/// own may be 4 times as large as in the parent's ball. `rounding` sums this up over the levels
/// below.
struct Moments {
  double c[3], N[3];
  double M[6];   ///< xx, yy, zz, xy + yx, yz + zy, zx + xz
  double T[10];  ///< by monomial()
  double radius, spread, rounding;

  /// A node in a sum, and a bound of its error.
  struct Term {
    double value, error;
    std::uint32_t node;
  };
  Term seenFrom(const Pointd& p, std::uint32_t node) const {
    const double x = c[0] - p[0], y = c[1] - p[1], z = c[2] - p[2];
    const double xx = x * x, yy = y * y, zz = z * z, R2 = xx + yy + zz, R = std::sqrt(R2);
    const double gap = R - radius, gap2 = gap * gap;
    if (!(gap > kNear)) return {0, kInfinity, node};
    const double of_M =
        M[0] * xx + M[1] * yy + M[2] * zz + M[3] * x * y + M[4] * y * z + M[5] * z * x;
    const double of_T = xx * (T[0] * x + T[1] * y + T[2] * z) +
                        yy * (T[3] * x + T[4] * y + T[5] * z) +
                        zz * (T[6] * x + T[7] * y + T[8] * z) + T[9] * x * y * z;
    const double per_R2 = 1 / R2;
    const double value = N[0] * x + N[1] * y + N[2] * z - per_R2 * (3 * of_M - 7.5 * per_R2 * of_T);
    return {value * per_R2 / (R * 4 * kPi),
            radius * spread / (kPi * gap2 * gap2 * gap) + rounding * per_R2, node};
  }
};

/// Sums of moments, about an origin of their own.
struct Sums {
  Pointd origin = Pointd::Zero(), N = Pointd::Zero();
  Pointd at = Pointd::Zero();  ///< integral of y
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero(), T[3] = {M, M, M};
  double area = 0, spread = 0, edges = 0;

  void add(const Sums& part) {
    const Pointd o = part.origin - origin;
    area += part.area;
    edges += part.edges;
    at += part.at + part.area * o;
    spread += part.spread + 2 * o.dot(part.at) + part.area * o.squaredNorm();
    N += part.N;
    const Eigen::Matrix3d n_o = part.N * o.transpose();
    M += part.M + n_o;
    for (int i = 0; i < 3; ++i) {
      const Pointd m = part.M.row(i);
      T[i] += part.T[i] + (m + part.N[i] * o) * o.transpose() + o * m.transpose();
    }
  }
};

/// About the corner a, as the centroid may lie between numbers.
Sums ofTriangle(const Pointd& a, const Pointd& e, const Pointd& f) {
  Sums sums, about_a;
  sums.origin = (e + f) / 3;
  sums.N = 0.5 * e.cross(f);
  sums.area = sums.N.norm();
  sums.edges = e.norm() * f.norm();
  sums.spread = sums.area * (e.squaredNorm() + f.squaredNorm() + (f - e).squaredNorm()) / 36;
  const Pointd corners[3] = {-(e + f) / 3, (2 * e - f) / 3, (2 * f - e) / 3};
  for (int i = 0; i < 3; ++i) {
    for (const Pointd& y : corners) sums.T[i] += sums.N[i] / 12 * y * y.transpose();
  }
  about_a.add(sums);
  about_a.origin = a;
  return about_a;
}

}  // namespace

class WindingTree::Nodes {
 public:
  template <typename S>
  explicit Nodes(const Model<S>& model)
      : Nodes(meshOf(model), [&model] {
          requireFinished(model);
          return stateOf(model);
        }) {}

  /// Throws std::invalid_argument if the model isn't in the state that the tree was made of, in
  /// which neither its arrays nor its tree may be there any more.
  void requireUnchanged() const {
    if (state_() == made_of_) return;
    refuse("the model of a WindingTree was changed after the tree was made; make another one.");
  }
  bool isOf(const ModelState& state) const { return state == made_of_; }

  double at(const Pointd& p, double error) const {
    using Term = Moments::Term;
    if (!((p - mesh_.center()).cwiseAbs().maxCoeff() <= std::ldexp(kFar, exponent_))) return 0;
    const Pointd q = inUnits(p);
    std::vector<Term> terms = {moments_[0].seenFrom(q, 0)}, kept;
    double near = 0;
    for (;;) {
      double total = 0, largest = 0;
      for (const Term& term : terms) {
        total += term.error;
        largest = std::max(largest, term.error);
      }
      if (!(total > error)) break;
      // Those that err most: the errors of what is left are alike at the end.
      const double most = largest < kInfinity ? kOpened * largest : 0x1p1000;
      kept.clear();
      for (const Term& term : terms) {
        if (term.error >= most) {
          open(term.node, q, kept, near);
        } else {
          kept.push_back(term);
        }
      }
      terms.swap(kept);
    }
    for (const Term& term : terms) near += term.value;
    return near;
  }

  std::size_t bytes() const { return sizeof(*this) + moments_.capacity() * sizeof(Moments); }

 private:
  Nodes(const Mesh& mesh, std::function<ModelState()> state)
      : mesh_(mesh),
        state_(std::move(state)),
        made_of_(state_()),
        exponent_(mesh.radius() > 0 ? exponentOf(mesh.radius()) : 0),
        half_unit_(std::ldexp(1.0, -exponent_ / 2)),
        other_half_(std::ldexp(1.0, -exponent_ - (-exponent_ / 2))),
        moments_(mesh.tree().nodes.size()) {
    std::vector<Sums> sums(moments_.size());
    for (std::size_t i = moments_.size(); i-- > 0;) measure(i, sums);  // children before parents
  }

  /// In two steps, as one factor may overflow.
  Pointd inUnits(const Pointd& p) const { return p * half_unit_ * other_half_; }

  template <typename Visit>
  void forFaces(const engine::Node& node, const Visit& visit) const {
    const engine::Leaf& leaf = mesh_.tree().leaves[node.leaf()];
    for (std::uint32_t i = 0; i < leaf.num_faces; ++i) {
      visit(mesh_.tree().features[leaf.feature_offset + i].triangle());
    }
  }
  std::uint32_t endOfChildren(const engine::Node& node) const {
    return node.first_child + mesh_.tree().children[static_cast<std::size_t>(node.child)].count;
  }

  void open(std::uint32_t index, const Pointd& q, std::vector<Moments::Term>& terms,
            double& sum) const {
    const engine::Node& node = mesh_.tree().nodes[index];
    if (node.isLeaf()) {
      forFaces(node, [&](std::size_t t) {
        const TriangleVerticesd corners = mesh_.triangle(t);
        sum += solidAngle(q, {inUnits(corners[0]), inUnits(corners[1]), inUnits(corners[2])});
      });
      return;
    }
    for (std::uint32_t i = node.first_child; i < endOfChildren(node); ++i) {
      terms.push_back(moments_[i].seenFrom(q, i));
    }
  }

  void measure(std::size_t index, std::vector<Sums>& sums) {
    const engine::Node& node = mesh_.tree().nodes[index];
    std::vector<Sums> parts;
    std::vector<std::pair<Pointd, double>> balls;
    double below = 0;  // what the children round
    if (node.isLeaf()) {
      forFaces(node, [&](std::size_t t) {
        const Pointd a = inUnits(mesh_.corner(t, 0)), b = inUnits(mesh_.corner(t, 1)),
                     c = inUnits(mesh_.corner(t, 2));
        parts.push_back(ofTriangle(a, b - a, c - a));
        for (const Pointd& p : {a, b, c}) balls.emplace_back(p, 0);
      });
    } else {
      for (std::uint32_t i = node.first_child; i < endOfChildren(node); ++i) {
        parts.push_back(sums[i]);
        balls.emplace_back(sums[i].origin, moments_[i].radius);
        below += moments_[i].rounding;
      }
    }
    // The moments are about the centroid as it is stored: its rounding changes nothing.
    Sums total;
    total.origin = parts[0].origin;
    for (const Sums& part : parts) total.add(part);
    Sums& own = sums[index];
    own.origin = total.origin;
    if (total.area > 0) own.origin += total.at / total.area;
    for (const Sums& part : parts) own.add(part);

    Moments& m = moments_[index];
    m.rounding = below + 0x1p-51 * (static_cast<double>(parts.size()) + 40) * own.edges;
    m.radius = 0;
    for (const auto& [p, r] : balls) m.radius = std::max(m.radius, (p - own.origin).norm() + r);
    m.radius *= 1 + 0x1p-40;
    m.spread = own.spread + 0x1p-40 * own.edges * m.radius * m.radius;
    Eigen::Map<Pointd>(m.c) = own.origin;
    Eigen::Map<Pointd>(m.N) = own.N;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      m.M[i] = own.M(i, i) - own.M.trace() / 3;
      m.M[3 + i] = own.M(i, j) + own.M(j, i);
    }
    std::fill_n(m.T, 10, 0.0);
    Pointd in_squares = Pointd::Zero();  // the part |d|^2 (in_squares d) / 5 of T
    for (int i = 0; i < 3; ++i) {
      in_squares += own.T[i].row(i).transpose() + own.T[i].col(i);
      in_squares[i] += own.T[i].trace();
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) m.T[monomial(i, j, k)] += own.T[i](j, k);
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) m.T[monomial(i, i, k)] -= in_squares[k] / 5;
    }
  }

  const Mesh mesh_;
  const std::function<ModelState()> state_;  ///< of the model as it is now
  const ModelState made_of_;
  const int exponent_;  ///< of the unit of moments
  const double half_unit_, other_half_;
  std::vector<Moments> moments_;
};

template <typename S>
WindingTree::WindingTree(const Model<S>& model) : nodes_(new Nodes(model)) {}
WindingTree::~WindingTree() = default;
WindingTree::WindingTree(WindingTree&& other) noexcept = default;
WindingTree& WindingTree::operator=(WindingTree&& other) noexcept = default;

double WindingTree::at(const fcl::Vector3d& p, double error) const {
  requireValidPoint(p, 0);
  require(error >= 0, "the error", error, "0 or more");
  nodes_->requireUnchanged();
  return nodes_->at(p, error);
}

std::size_t WindingTree::bytes() const { return sizeof(*this) + nodes_->bytes(); }

template <typename S>
bool WindingTree::isOf(const Model<S>& model) const {
  requireFinished(model);
  return nodes_->isOf(stateOf(model));
}

template WindingTree::WindingTree(const Modeld&);
template WindingTree::WindingTree(const Modelf&);
template bool WindingTree::isOf(const Modeld&) const;
template bool WindingTree::isOf(const Modelf&) const;

}  // namespace kios
