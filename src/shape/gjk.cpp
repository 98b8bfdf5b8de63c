// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/gjk.h"

#include <algorithm>
#include <cmath>

#include "shape/nearest_point.h"
#include "shape/simplex.h"
#include "volume/unit_vector.h"

namespace kios::shape {
namespace {

/// Points without repetitions.
struct Feature {
  int size = 0;
  Vec corner[3];

  void add(const Vec& p) {
    for (int i = 0; i < size; ++i) {
      if (corner[i] == p) return;
    }
    corner[size++] = p;
  }
  Vec edge() const { return corner[1] - corner[0]; }
  Vec normal() const { return faceNormal({corner[0], corner[1], corner[2]}); }
};

/// A direction across the two features that a simplex of up to three points lies on: that keeps its
/// digits where the difference of their nearest points has lost them. Not of length 1.
Vec across(const Simplex& s, const Vec& between) {
  Feature a, b;
  for (int i = 0; i < s.size; ++i) {
    a.add(s.on_a[i]);
    b.add(s.on_b[i]);
  }
  if (a.size == 3) return a.normal();
  if (b.size == 3) return b.normal();
  if (a.size == 1 && b.size == 1) return between;
  const Vec edge = a.size == 2 ? a.edge() : b.edge();
  const double square = edge.squaredNorm();
  if (a.size == 2 && b.size == 2) {
    const Vec other = b.edge(), n = edge.cross(other);
    if (n.squaredNorm() > 0x1p-40 * square * other.squaredNorm()) return n;
  }
  if (!(square > 0)) return between;
  return between - between.dot(edge) / square * edge;
}

}  // namespace

CoreDistance gjkDistance(const Solid& solid, const Vec* hull, int num_points, double required,
                         int max_iterations) {
  Simplex s;
  const auto add = [&](const Vec& v) {  // the extreme point of hull - core against v
    int corner = 0;
    for (int i = 1; i < num_points; ++i) {
      if (v.dot(hull[i]) < v.dot(hull[corner])) corner = i;
    }
    s.add(hull[corner], coreSupport(solid, v));
    return s.on_a[s.size - 1].lpNorm<1>() + s.on_b[s.size - 1].lpNorm<1>();
  };
  Vec sum = hull[0];
  for (int i = 1; i < num_points; ++i) sum += hull[i];
  add(sum);
  const Descent found = descend(s, add, required, max_iterations - 1);
  CoreDistance answer;
  answer.lower = found.lower;
  answer.point = answer.on_core = Vec::Zero();
  for (int i = 0; i < s.size; ++i) {
    answer.point += s.weight[i] * s.on_a[i];
    answer.on_core += s.weight[i] * s.on_b[i];
  }
  answer.upper = (answer.point - answer.on_core).norm();
  answer.inside = !(found.squared > 0);
  const bool decided = answer.inside || answer.lower > required || s.size > 3;
  if (decided || num_points < 3) return answer;
  const double size = std::max({hull[0].lpNorm<1>(), hull[1].lpNorm<1>(), hull[2].lpNorm<1>()}) +
                      answer.on_core.lpNorm<1>();
  if (answer.upper - answer.lower <= 0x1p-49 * size) return answer;
  const Vec between = answer.point - answer.on_core;
  Vec n = unitVector(across(s, between));
  if (n.dot(between) < 0) n = -n;
  const double low = std::min({n.dot(hull[0]), n.dot(hull[1]), n.dot(hull[2])});
  answer.lower = std::max(answer.lower, low - n.dot(coreSupport(solid, n)));
  return answer;
}

}  // namespace kios::shape
