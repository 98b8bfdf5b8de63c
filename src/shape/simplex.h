// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// GJK's simplex, which addons use as well: no symbols of the library.

namespace kios::shape {

/// Up to four points y = on_a - on_b of the difference of two convex sets. Its point nearest to the
/// origin is sum weight y.
struct Simplex {
  int size = 0;
  std::array<Eigen::Vector3d, 4> y, on_a, on_b;
  double weight[4] = {};

  /// Weighs nothing but the first.
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    on_a[size] = a;
    on_b[size] = b;
    y[size] = a - b;
    weight[size] = size == 0 ? 1.0 : 0.0;
    ++size;
  }
};

/// A candidate for the nearest point of the simplex.
struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  double weight[4] = {};
};

inline void offer(const Simplex& s, const int* ids, const double* weights, int n, Nearest& best) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i) v += weights[i] * s.y[ids[i]];
  const double squared = v.squaredNorm();
  if (!(squared < best.squared)) return;
  best.squared = squared;
  best.v = v;
  std::fill_n(best.weight, 4, 0.0);
  for (int i = 0; i < n; ++i) best.weight[ids[i]] = weights[i];
}

inline double nearestOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  const double along = -a.dot(d), length = d.squaredNorm();
  return along <= 0 ? 0.0 : (along >= length ? 1.0 : along / length);
}

/// Weights of the origin's projection on a triangle's plane; false if it isn't strictly inside.
// The second edge is made orthogonal to the first, so that slivers lose accuracy along their length
// only, where the distance hardly depends on it.
inline bool projectToFace(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, double weights[3]) {
  const Eigen::Vector3d u = b - a, v = c - a;
  const double uu = u.squaredNorm();
  if (!(uu > 0)) return false;
  const Eigen::Vector3d w = v - (u.dot(v) / uu) * u;
  const double ww = w.squaredNorm();
  if (!(ww > 0)) return false;
  const double t = -a.dot(w) / ww;
  const double s = -(a + t * v).dot(u) / uu;
  if (!(s > 0 && t > 0 && s + t < 1)) return false;
  weights[0] = 1 - s - t;
  weights[1] = s;
  weights[2] = t;
  return true;
}

inline void offerSegment(const Simplex& s, int i, int j, Nearest& best) {
  const int ids[2] = {i, j};
  const double t = nearestOnSegment(s.y[i], s.y[j]);
  const double weights[2] = {1 - t, t};
  offer(s, ids, weights, 2, best);
}

inline void offerTriangle(const Simplex& s, int i, int j, int k, Nearest& best) {
  const int ids[3] = {i, j, k};
  double weights[3];
  if (projectToFace(s.y[i], s.y[j], s.y[k], weights)) {
    offer(s, ids, weights, 3, best);
    return;
  }
  offerSegment(s, i, j, best);
  offerSegment(s, j, k, best);
  offerSegment(s, k, i, best);
}

/// Weights of the origin in a tetrahedron; false if it is outside, or the tetrahedron so flat that
/// the weights don't give the origin to rounding.
inline bool insideTetrahedron(const Simplex& s, double weights[4]) {
  const Eigen::Vector3d a = s.y[0] - s.y[3], b = s.y[1] - s.y[3], c = s.y[2] - s.y[3];
  const Eigen::Vector3d o = -s.y[3];
  const double volume = a.dot(b.cross(c));
  if (!(std::abs(volume) >
        16 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm() * c.norm()))
    return false;
  weights[0] = o.dot(b.cross(c)) / volume;
  weights[1] = a.dot(o.cross(c)) / volume;
  weights[2] = a.dot(b.cross(o)) / volume;
  weights[3] = 1 - weights[0] - weights[1] - weights[2];
  if (!(*std::min_element(weights, weights + 4) >= 0)) return false;
  const Eigen::Vector3d origin = weights[0] * a + weights[1] * b + weights[2] * c - o;
  return origin.lpNorm<1>() <= 0x1p-50 * std::max({a.lpNorm<1>(), b.lpNorm<1>(), c.lpNorm<1>()});
}

inline Nearest nearest(const Simplex& s) {
  Nearest best;
  const int first[1] = {0};
  const double one[1] = {1};
  switch (s.size) {
    case 1:
      offer(s, first, one, 1, best);
      break;
    case 2:
      offerSegment(s, 0, 1, best);
      break;
    case 3:
      offerTriangle(s, 0, 1, 2, best);
      break;
    default:
      if (insideTetrahedron(s, best.weight)) {
        best.squared = 0;
        break;
      }
      for (int i = 0; i < 4; ++i) offerTriangle(s, i, (i + 1) % 4, (i + 2) % 4, best);
  }
  return best;
}

/// Keeps the points that the nearest one is made of.
inline void reduce(const Nearest& best, Simplex& s) {
  int kept = 0;
  for (int i = 0; i < s.size; ++i) {
    if (!(best.weight[i] > 0)) continue;
    s.y[kept] = s.y[i];
    s.on_a[kept] = s.on_a[i];
    s.on_b[kept] = s.on_b[i];
    s.weight[kept++] = best.weight[i];
  }
  s.size = kept;
}

/// Holds what a descent came to: the square of the distance of the simplex from the origin, and a
/// lower bound of the sets' distance by a slab between them.
struct Descent {
  double squared;
  double lower = -std::numeric_limits<double>::infinity();
};

/// Moves a simplex of one point towards the origin by GJK. add(v) adds the extreme point against v,
/// and returns the size by which that point is rounded. Ends when the bracket is closed to
/// rounding, when nothing improves any more, once `lower` exceeds `required`, or after `max_steps`.
template <typename Add>
Descent descend(Simplex& s, const Add& add, double required, int max_steps) {
  Eigen::Vector3d v = s.y[0];
  Descent found{v.squaredNorm()};
  for (int step = 0; step < max_steps; ++step) {
    const double length = std::sqrt(found.squared);
    if (!(length > 0)) break;
    const int before = s.size;
    const double size = add(v);
    const Eigen::Vector3d y = s.y[before];
    found.lower = std::max(found.lower, v.dot(y) / length);
    bool known = false;  // a point that is there already: nothing is nearer
    for (int i = 0; i < before; ++i) known |= s.y[i] == y;
    const double closed = 0x1p-48 * length + 0.25 * std::numeric_limits<double>::epsilon() * size;
    Nearest best;
    const bool ends = found.lower > required || known || length - found.lower <= closed;
    if (!ends) best = nearest(s);
    if (!(best.squared < found.squared)) {
      s.size = before;
      break;
    }
    reduce(best, s);
    found.squared = best.squared;
    v = best.v;
  }
  return found;
}

}  // namespace kios::shape
