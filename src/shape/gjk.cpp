// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/gjk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fcl_kios/triangle/distance.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Points of hull - core with what they are made of; the nearest is sum weight y.
struct Simplex {
  int size = 0;
  std::array<Vec, 4> y, on_core;
  int corner[4];
  double weight[4];
};

/// A candidate for the nearest point of the simplex.
struct Nearest {
  double squared = kInfinity;
  Vec v = Vec::Zero();
  double weight[4] = {};
};

void offer(const Simplex& s, const int* ids, const double* weights, int n, Nearest& best) {
  Vec v = Vec::Zero();
  for (int i = 0; i < n; ++i) v += weights[i] * s.y[ids[i]];
  const double squared = v.squaredNorm();
  if (!(squared < best.squared)) return;
  best.squared = squared;
  best.v = v;
  std::fill_n(best.weight, 4, 0.0);
  for (int i = 0; i < n; ++i) best.weight[ids[i]] = weights[i];
}

double nearestOnSegment(const Vec& a, const Vec& b) {
  const Vec d = b - a;
  const double along = -a.dot(d), length = d.squaredNorm();
  return along <= 0 ? 0.0 : (along >= length ? 1.0 : along / length);
}

/// Weights of the origin's projection on a triangle's plane; false if it isn't strictly inside.
// The second edge is made orthogonal to the first, so that slivers lose accuracy along their length
// only, where the distance hardly depends on it.
bool projectToFace(const Vec& a, const Vec& b, const Vec& c, double weights[3]) {
  const Vec u = b - a, v = c - a;
  const double uu = u.squaredNorm();
  if (!(uu > 0)) return false;
  const Vec w = v - (u.dot(v) / uu) * u;
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

void offerSegment(const Simplex& s, int i, int j, Nearest& best) {
  const int ids[2] = {i, j};
  const double t = nearestOnSegment(s.y[i], s.y[j]);
  const double weights[2] = {1 - t, t};
  offer(s, ids, weights, 2, best);
}

void offerTriangle(const Simplex& s, int i, int j, int k, Nearest& best) {
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
bool insideTetrahedron(const Simplex& s, double weights[4]) {
  const Vec a = s.y[0] - s.y[3], b = s.y[1] - s.y[3], c = s.y[2] - s.y[3];
  const Vec o = -s.y[3];
  const double volume = a.dot(b.cross(c));
  if (!(std::abs(volume) > 16 * kEps * a.norm() * b.norm() * c.norm())) return false;
  weights[0] = o.dot(b.cross(c)) / volume;
  weights[1] = a.dot(o.cross(c)) / volume;
  weights[2] = a.dot(b.cross(o)) / volume;
  weights[3] = 1 - weights[0] - weights[1] - weights[2];
  if (!(*std::min_element(weights, weights + 4) >= 0)) return false;
  const Vec origin = weights[0] * a + weights[1] * b + weights[2] * c - o;
  return origin.lpNorm<1>() <= 0x1p-50 * std::max({a.lpNorm<1>(), b.lpNorm<1>(), c.lpNorm<1>()});
}

Nearest nearest(const Simplex& s) {
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
void reduce(const Nearest& best, Simplex& s) {
  int kept = 0;
  for (int i = 0; i < s.size; ++i) {
    if (!(best.weight[i] > 0)) continue;
    s.y[kept] = s.y[i];
    s.on_core[kept] = s.on_core[i];
    s.corner[kept] = s.corner[i];
    s.weight[kept++] = best.weight[i];
  }
  s.size = kept;
}

}  // namespace

CoreDistance gjkDistance(const Solid& solid, const Vec* hull, int num_points, double enough,
                         int max_iterations) {
  CoreDistance answer;
  answer.lower = -kInfinity;
  Simplex s;
  const auto add = [&](const Vec& v) {  // the extreme point of hull - core against v
    int corner = 0;
    for (int i = 1; i < num_points; ++i) {
      if (v.dot(hull[i]) < v.dot(hull[corner])) corner = i;
    }
    s.corner[s.size] = corner;
    s.on_core[s.size] = coreSupport(solid, v);
    s.y[s.size] = hull[corner] - s.on_core[s.size];
    s.weight[s.size] = s.size == 0 ? 1.0 : 0.0;
    return s.y[s.size++];
  };
  Vec v = hull[0];
  for (int i = 1; i < num_points; ++i) v += hull[i];
  add(v);
  v = s.y[0];
  double squared = v.squaredNorm();
  for (answer.iterations = 1; answer.iterations < max_iterations; ++answer.iterations) {
    const double length = std::sqrt(squared);
    if (!(length > 0)) break;
    Simplex before = s;
    const Vec y = add(v);
    answer.lower = std::max(answer.lower, v.dot(y) / length);
    if (answer.lower > enough) {
      s = before;
      break;
    }
    const double size = hull[s.corner[s.size - 1]].lpNorm<1>() + s.on_core[s.size - 1].lpNorm<1>();
    bool known = false;  // a point that is there already: nothing is nearer
    for (int i = 0; i < before.size; ++i) known |= before.y[i] == y;
    if (known || length - answer.lower <= 0x1p-48 * length + 0.25 * kEps * size) {
      s = before;
      break;
    }
    const Nearest best = nearest(s);
    if (!(best.squared < squared)) {
      s = before;
      break;
    }
    reduce(best, s);
    squared = best.squared;
    v = best.v;
  }
  answer.point = answer.on_core = Vec::Zero();
  for (int i = 0; i < s.size; ++i) {
    answer.point += s.weight[i] * hull[s.corner[i]];
    answer.on_core += s.weight[i] * s.on_core[i];
  }
  answer.upper = (answer.point - answer.on_core).norm();
  answer.inside = !(squared > 0);
  return answer;
}

// A candidate of plain arithmetic is taken if a slab between the origin and the triangle certifies
// it. The slab lies across the candidate's feature, whose direction keeps its digits where the
// candidate itself, nearly 0, has lost them. Else the kernel of two triangles answers.
Vec nearestToOrigin(const TriangleVertices<double>& t) {
  Simplex s;
  s.size = 3;
  for (int i = 0; i < 3; ++i) s.y[i] = t[i];
  const Nearest best = nearest(s);
  int on[3], corners = 0;
  for (int i = 0; i < 3; ++i) {
    if (best.weight[i] > 0) on[corners++] = i;
  }
  Vec n = best.v;
  if (corners == 2) {
    const Vec edge = t[on[1]] - t[on[0]];
    n -= n.dot(edge) / edge.squaredNorm() * edge;
  } else if (corners == 3) {
    n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (n.dot(best.v) < 0) n = -n;
  }
  const double length = n.norm(), distance = std::sqrt(best.squared);
  const double tolerance =
      0x1p-49 * std::max({t[0].lpNorm<1>(), t[1].lpNorm<1>(), t[2].lpNorm<1>()});
  const double low = std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
  if (distance <= tolerance || (distance - tolerance) * length < low) return best.v;
  const Vec origin = Vec::Zero();
  return triangleDistance<double>(t, {origin, origin, origin}).point_a;
}

}  // namespace kios::shape
