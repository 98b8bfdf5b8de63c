// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/containment.h"

#include <vector>

#include "query/ray_walk.h"
#include "solid/nearest_surface.h"
#include "solid/solid_mark.h"
#include "solid/winding.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Finds the place of p, in a's frame, in b as posed there: by all of b's triangles.
bool liesInPosed(const fcl::Vector3d& p, const MeshPair& frame) {
  const double largest =
      p.cwiseAbs().maxCoeff() + 2 * (frame.b.center().cwiseAbs().maxCoeff() + frame.b.radius());
  const RayCrossing ray(p, windingDirection(), largest);
  PointPlace place;
  const int num_triangles = static_cast<int>(frame.b.numTriangles());
  for (int t = 0; t < num_triangles && !place.on_surface; ++t) {
    place.add(ray.cross(frame.triangleB(t)));
  }
  return place.inside();
}

}  // namespace

fcl::Vector3d toB(const RelativePose<double>& X_AB, const fcl::Vector3d& p) {
  return detail::rotate<double>(X_AB.R().transpose(), p - X_AB.T());
}

// R y = R R^T (p - T), where R R^T differs from 1 by |E|, at most twice the stretch and a little
// more; |y - x| is that by at most |p - T|. Products and sums round by 2^-50 of their terms.
double inverseError(const RelativePose<double>& X_AB, double norm1) {
  const auto& bounds = detail::boundsOf(X_AB);
  return 2 * (norm1 + bounds.T_norm1) * (2.1 * bounds.stretch + 0x1p-48);
}

template <typename S>
std::optional<fcl::Vector3d> containedPoint(const Model<S>& a, const Model<S>& b,
                                            const MeshPair& frame, SearchCounts& counts) {
  const auto vertexOf = [](const Mesh& mesh, int i) {
    return mesh.vertex(static_cast<std::size_t>(i));
  };
  for (const auto& component : requireSolid(b).components()) {
    const fcl::Vector3d p = frame.X_AB * vertexOf(frame.b, component[0]);
    if (placeOf(p, a, counts).inside()) return p;
  }
  // b's tree lies in b's frame, where a's vertices are known but for rounding: that doesn't matter
  // unless b's surface is as near.
  for (const auto& component : requireSolid(a).components()) {
    bool decided = false, inside = false;
    fcl::Vector3d p;
    for (std::size_t i = 0; i < component.size() && !decided; ++i) {
      p = vertexOf(frame.a, component[i]);
      const fcl::Vector3d y = toB(frame.X_AB, p);
      const double error = inverseError(frame.X_AB, p.lpNorm<1>()) +
                           error_bounds::frameError<double>(2 * y.lpNorm<1>() + 4 * largestOf(b),
                                                            detail::boundsOf(frame.X_AB).T_norm1);
      const double required = error + 2 * surfaceError(b, y);
      decided = nearestSurface(b, y, 0, required).lower > error;
      if (decided) inside = placeOf(y, b, counts).inside();
    }
    if (!decided) inside = liesInPosed(p, frame);
    if (inside) return p;
  }
  return std::nullopt;
}

KIOS_INSTANTIATE_FUNCTION(containedPoint);

}  // namespace kios
