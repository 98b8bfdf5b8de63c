// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/gjk.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle/distance.h"
#include "shape/simplex.h"

namespace kios::shape {
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
