// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The distance of two convex bodies is the width of the widest slab between them:
//   d = max over unit n of h(n),  h(n) = min over b of n.y - max over a of n.x,
// and any n with h(n) > 0 proves that they are at least h(n) apart. h is concave, and C1 as the
// bodies are strictly convex: its derivative is y - x of the unique support points. On the sphere
// of directions, a surface, Newton's method needs 3 to 6 steps; its curvature is that of the
// spheres, circles and vertices which hold the support points.
#include "clearance/nearest_pair.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "volume/rounding.h"

namespace kios::exact {
namespace {

/// Holds up to four differences z = y - x of points x of a and y of b, as in the algorithm of
/// Gilbert, Johnson and Keerthi. Their convex hull is part of the set of all differences, which
/// contains the origin if and only if the bodies meet. By the simplex of shapes, which drops flat
/// tetrahedra, brackets of very uneven volumes stayed open by up to 1e-2 (exact_distance_test).
class Simplex {
 public:
  /// Drops what does not hold the nearest point first; a full simplex around the origin stays.
  void add(const Vector3d& x, const Vector3d& y);

  /// Returns p, and q: the point of the hull nearest to the origin is q - p, with p in a and q in
  /// b.
  const Vector3d& p() const { return p_; }
  const Vector3d& q() const { return q_; }

 private:
  struct Point {
    Vector3d x, y;
    double weight;
  };
  void findNearest();

  int size_ = 0;
  std::array<Point, 4> point_;
  Vector3d p_ = Vector3d::Zero(), q_ = Vector3d::Zero();
};

void Simplex::add(const Vector3d& x, const Vector3d& y) {
  int kept = 0;
  for (int i = 0; i < size_; ++i) {
    if (point_[i].weight > 0) point_[kept++] = point_[i];
  }
  size_ = kept;
  if (size_ == 4) return;
  point_[size_++] = {x, y, 0};
  findNearest();
}

// Takes the nearest of the 15 faces whose weights are >= 0: every such combination is a point of
// the hull, so that rounding costs iterations, but never the truth of p and q.
void Simplex::findNearest() {
  double least = kInfinity;
  std::array<double, 4> best = {};
  for (int face = 1; face < 1 << size_; ++face) {
    int corner[4], corners = 0;
    for (int i = 0; i < size_; ++i) {
      if (face & (1 << i)) corner[corners++] = i;
    }
    const Vector3d first = point_[corner[0]].y - point_[corner[0]].x;
    std::array<double, 4> weight = {};
    weight[corner[0]] = 1;
    Vector3d nearest = first;
    if (corners > 1) {
      Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> edges(3, corners - 1);
      for (int i = 1; i < corners; ++i) {
        edges.col(i - 1) = (point_[corner[i]].y - point_[corner[i]].x) - first;
      }
      const Eigen::ColPivHouseholderQR<decltype(edges)> factors(edges);
      if (!(factors.maxPivot() > 0)) continue;  // one point, which is a face of its own
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> along = factors.solve(-first);
      if (!along.allFinite()) continue;
      nearest += edges * along;
      for (int i = 1; i < corners; ++i) {
        weight[corner[i]] = along[i - 1];
        weight[corner[0]] -= along[i - 1];
      }
    }
    bool inside = nearest.norm() < least;
    for (int i = 0; i < corners; ++i) inside = inside && weight[corner[i]] >= 0;
    if (!inside) continue;
    least = nearest.norm();
    best = weight;
  }
  p_.setZero();
  q_.setZero();
  for (int i = 0; i < size_; ++i) {
    point_[i].weight = best[i];
    p_ += best[i] * point_[i].x;
    q_ += best[i] * point_[i].y;
  }
}

/// Both bodies in common units.
class VolumePair {
 public:
  VolumePair(const SphereIntersection& a, const SphereIntersection& b, const Matrix3d& R,
             const Vector3d& offset)
      : a_(a), b_(b), R_(R) {
    const double reach_a = scaled(a.reach(), a.exponent());
    const double reach_b = scaled(b.reach(), b.exponent());
    const double largest = std::max({offset.lpNorm<Eigen::Infinity>(), reach_a, reach_b});
    exponent_ = largest > 0 ? std::ilogb(largest) : 0;
    unit_a_ = reach_a > 0 ? scaled(1.0, a.exponent() - exponent_) : 0;
    unit_b_ = reach_b > 0 ? scaled(1.0, b.exponent() - exponent_) : 0;
    for (int c = 0; c < 3; ++c) offset_[c] = scaled(offset[c], -exponent_);
    size_ = offset_.norm() + unit_a_ * a.reach() + unit_b_ * b.reach();
  }

  NearestPair solve();

 private:
  /// The slab across n.
  struct Slab {
    Vector3d n, x, y;
    SphereIntersection::Extreme on_a, on_b;
    double height;  ///< h(n)

    Vector3d between() const { return y - x; }
    Vector3d tangential() const { return between() - height * n; }
  };

  Slab slab(const Vector3d& direction);
  Slab widest(Slab slab);
  Slab search(Slab slab, NearestPair& result);
  bool inBoth(const Vector3d& p) const;
  double converged() const { return 4 * kUlpDouble * size_; }
  Vector3d farthestSpheres() const;
  double provenHeight(const Slab& slab) const;

  const SphereIntersection& a_;
  const SphereIntersection& b_;
  const Matrix3d R_;
  Vector3d offset_;
  int exponent_;
  double unit_a_, unit_b_;
  double size_;
  int probes_ = 0;
};

VolumePair::Slab VolumePair::slab(const Vector3d& direction) {
  ++probes_;
  Slab s;
  s.n = direction.normalized();
  s.on_a = a_.support(s.n);
  s.on_b = b_.support(-(R_.transpose() * s.n));
  s.x = unit_a_ * s.on_a.x;
  s.y = offset_ + unit_b_ * (R_ * s.on_b.x);
  s.height = s.n.dot(s.between());
  return s;
}

// On the plane that touches the sphere of directions at n, -h has the Hessian H + h I, H >= 0 the
// bodies' curvature. The step is exact for two spheres and for two vertices.
VolumePair::Slab VolumePair::widest(Slab best) {
  const double rounding = converged();
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vector3d e0 = best.n.unitOrthogonal(), e1 = best.n.cross(e0);
    Eigen::Matrix<double, 3, 2> T;
    T << e0, e1;
    const Eigen::Vector2d g = T.transpose() * best.between();
    const double steepness = g.norm();
    if (steepness <= rounding / 2) break;
    const Matrix3d H =
        unit_a_ * best.on_a.curvature + unit_b_ * (R_ * best.on_b.curvature * R_.transpose());
    Eigen::Matrix2d M = T.transpose() * H * T;
    // If the bodies overlap, h < 0, and M + h I may be indefinite away from the maximum.
    const Eigen::Matrix2d full = M + best.height * Eigen::Matrix2d::Identity();
    const bool definite =
        full.trace() > 0 && full.determinant() > 1e-6 * full.trace() * full.trace();
    if (best.height > 0 || definite) {
      M = full;
    } else {
      M += (std::abs(best.height) + rounding) * Eigen::Matrix2d::Identity();
    }
    Eigen::Vector2d step = M.inverse() * g;
    if (!step.allFinite() || !(step.dot(g) > 0)) step = g / steepness;
    if (step.norm() > 1) step.normalize();
    const double slope = step.dot(g);
    bool accepted = false;
    for (double part = 1; part > 0x1p-24 && !accepted; part /= 2) {
      Slab trial = slab(best.n + part * (T * step));
      const double gain = trial.height - best.height;
      accepted = gain >= 1e-4 * part * slope && gain > rounding;
      // Heights that don't differ any more still leave n half of its digits to gain.
      if (!accepted && std::abs(gain) <= rounding) {
        if (!(trial.tangential().norm() < 0.75 * steepness)) return best;
        accepted = true;
      }
      if (accepted) best = trial;
    }
    if (!accepted) break;
  }
  return best;
}

/// From the sphere of a to the sphere of b that are farthest apart: separation()'s pair.
Vector3d VolumePair::farthestSpheres() const {
  double farthest = -kInfinity;
  Vector3d direction = Vector3d::UnitX();
  for (int j = 0; j < b_.spheres(); ++j) {
    const Vector3d c = offset_ + unit_b_ * (R_ * b_.sphere(j).c);
    for (int i = 0; i < a_.spheres(); ++i) {
      const Vector3d between = c - unit_a_ * a_.sphere(i).c;
      const double length = between.norm();
      const double apart = length - unit_a_ * a_.sphere(i).r - unit_b_ * b_.sphere(j).r;
      if (!(apart > farthest) || !(length > 0)) continue;
      farthest = apart;
      direction = between;
    }
  }
  return direction;
}

// n.offset, the sums and |n| - 1 round by less than 16 u of the size; n was only found in floating
// point, but any n proves its slab.
double VolumePair::provenHeight(const Slab& s) const {
  const double height = s.n.dot(offset_) - unit_a_ * a_.supportBound(s.n, s.on_a) -
                        unit_b_ * b_.supportBound(-(R_.transpose() * s.n), s.on_b);
  return height - 16 * kUlpDouble * size_ - 8 * kUlpDouble * std::abs(height);
}

/// True if p is in both bodies, but for rounding.
bool VolumePair::inBoth(const Vector3d& p) const {
  const auto outside = [](const SphereIntersection& body, double unit, const Vector3d& x) {
    return unit > 0 ? unit * body.violation(x / unit) : x.norm();
  };
  return outside(a_, unit_a_, p) <= converged() &&
         outside(b_, unit_b_, R_.transpose() * (p - offset_)) <= converged();
}

/// The widest slab and nearest points where Newton's method alone didn't get there: when it knows
/// no slab to start from, or creeps along the kinks of very uneven volumes.
// The algorithm of Gilbert, Johnson and Keerthi converges for all convex bodies, if slowly where
// these are round and close; it gives Newton's method new places to start from, and takes its
// support points in turn.
VolumePair::Slab VolumePair::search(Slab best, NearestPair& result) {
  constexpr int kIterations = 100;
  Simplex simplex;
  Slab last = best;
  for (int i = 0; i < kIterations; ++i) {
    simplex.add(last.x, last.y);
    const Vector3d v = simplex.q() - simplex.p();
    result.p = simplex.p();
    result.q = simplex.q();
    result.upper = v.norm();
    if (result.upper - std::max(0.0, best.height) <= converged()) break;
    last = slab(v);
    if (i % 4 == 3 || (last.height > 0 && !(best.height > 0))) last = widest(last);
    if (last.height > best.height) best = last;
    if (best.height > 0) {
      if (best.tangential().norm() <= converged()) break;
    } else if (i % 4 == 3) {
      const Vector3d middle = (last.x + last.y) / 2;
      if (!inBoth(middle)) continue;
      result.p = result.q = middle;
      result.upper = converged();
      break;
    }
  }
  return best;
}

NearestPair VolumePair::solve() {
  NearestPair result;
  result.exponent = exponent_;
  result.upper = kInfinity;
  Slab best = slab(farthestSpheres());
  if (best.height > 0) best = widest(best);
  if (!(best.height > 0 && best.tangential().norm() <= converged())) best = search(best, result);
  result.probes = probes_;
  result.normal = best.n;
  if (!(best.height > 0)) return result;
  result.lower = provenHeight(best);
  // Had the spheres that hold x and y grown by what these lie outside of them, x and y would be
  // feasible; the distance would change by that times the spheres' shares in n.
  double outside = 0;
  for (int i = 0; i < best.on_a.active; ++i) {
    outside += unit_a_ * best.on_a.part[i].norm() * std::max(0.0, best.on_a.violation);
  }
  for (int i = 0; i < best.on_b.active; ++i) {
    outside += unit_b_ * best.on_b.part[i].norm() * std::max(0.0, best.on_b.violation);
  }
  const double between = best.between().norm() + outside;
  if (between < result.upper) {
    result.upper = between;
    result.p = best.x;
    result.q = best.y;
  }
  result.q_arm = result.q - offset_;
  return result;
}

}  // namespace

NearestPair nearestPair(const SphereIntersection& a, const SphereIntersection& b, const Matrix3d& R,
                        const Vector3d& offset) {
  return VolumePair(a, b, R, offset).solve();
}

}  // namespace kios::exact
