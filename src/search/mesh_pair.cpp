// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/mesh_pair.h"

#include "fcl_kios/triangle/intersection.h"

namespace kios {

// Where floats don't serve, by the central spheres, as volume/separation.cpp does.
double MeshPair::rootBound(double enough) const {
  if (floats_serve) {
    return engine::rootBound(engine::rootOf(a), engine::rootOf(b), X_trees, enough);
  }
  const detail::PoseBounds& bounds = detail::boundsOf(X_AB);
  const double error =
      error_bounds::volumeError<double>(
          b.center().lpNorm<1>(), bounds.T_norm1 + a.center().lpNorm<1>(), a.radius(), b.radius()) +
      bounds.stretch * b.radius();
  return (X_AB * b.center() - a.center()).stableNorm() - a.radius() - b.radius() - error;
}

bool MeshPair::intersect(const engine::TrianglePairIds& ids) const {
  return trianglesIntersect(triangleA(ids.a), triangleB(ids.b));
}

double MeshPair::distanceErrorOf(const engine::TrianglePairIds& ids) const {
  const TriangleVerticesd p = triangleA(ids.a), q = triangleB(ids.b);
  double largest = 0;
  Pointd low = p[0], high = p[0];
  for (std::size_t k = 0; k < 3; ++k) {
    low = low.cwiseMin(p[k]).cwiseMin(q[k]);
    high = high.cwiseMax(p[k]).cwiseMax(q[k]);
    largest = std::max(largest, b.corner(static_cast<std::size_t>(ids.b), k).lpNorm<1>());
  }
  return error_bounds::triangleError<double>(1.01 * (high - low).stableNorm()) +
         frameError(largest) + kLeast;
}

}  // namespace kios
