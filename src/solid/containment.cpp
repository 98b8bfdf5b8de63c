// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/containment.h"

#include <vector>

#include "query/pair_search.h"
#include "query/ray_walk.h"
#include "solid/nearest_surface.h"
#include "solid/solid_mark.h"
#include "solid/winding.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Finds the place of p, in a's frame, in b as posed there: by all of b's triangles.
template <typename S>
bool liesInPosed(const fcl::Vector3d& p, const MeshPair<S>& frame) {
  const double largest = p.cwiseAbs().maxCoeff() + 2 * largestOf(frame.b);
  const RayCrossing ray(p, windingDirection(), largest);
  PointPlace place;
  for (int t = 0; t < frame.b.num_tris && !place.on_surface; ++t) {
    const TriangleVertices<S> corners = frame.triangleB(t);
    place.add(ray.cross({corners[0].template cast<double>(), corners[1].template cast<double>(),
                         corners[2].template cast<double>()}));
  }
  return place.inside();
}

}  // namespace

template <typename S>
bool surfacesMeet(const MeshPair<S>& frame, SearchCounts& counts) {
  return !searchContacts(frame, 1, counts).empty();
}

template <typename S>
fcl::Vector3d toB(const RelativePose<S>& X_AB, const fcl::Vector3d& p) {
  const fcl::Matrix3d R = X_AB.R().template cast<double>();
  return detail::rotate<double>(R.transpose(), p - X_AB.T().template cast<double>());
}

// R y = R R^T (p - T), where R R^T differs from 1 by |E|, at most twice the stretch and a little
// more; |y - x| is that by at most |p - T|. Products and sums round by 2^-50 of their terms.
template <typename S>
double inverseError(const RelativePose<S>& X_AB, double norm1) {
  const auto& bounds = detail::boundsOf(X_AB);
  return 2 * (norm1 + bounds.T_norm1) * (2.1 * bounds.stretch + 0x1p-48);
}

template <typename S>
std::optional<fcl::Vector3d> containedPoint(const MeshPair<S>& frame, SearchCounts& counts) {
  for (const auto& component : requireSolid(frame.b).components()) {
    const fcl::Vector3d p = (frame.X_AB * frame.b.vertices[component[0]]).template cast<double>();
    if (placeOf(p, frame.a, counts).inside()) return p;
  }
  // b's tree lies in b's frame, where a's vertices are known but for rounding: that doesn't matter
  // unless b's surface is as near.
  for (const auto& component : requireSolid(frame.a).components()) {
    bool decided = false, inside = false;
    fcl::Vector3d p;
    for (std::size_t i = 0; i < component.size() && !decided; ++i) {
      p = frame.a.vertices[component[i]].template cast<double>();
      const fcl::Vector3d y = toB(frame.X_AB, p);
      const double error =
          inverseError(frame.X_AB, p.template lpNorm<1>()) +
          error_bounds::frameError<S>(2 * y.template lpNorm<1>() + 4 * largestOf(frame.b),
                                      detail::boundsOf(frame.X_AB).T_norm1);
      const double required = error + 2 * surfaceError(frame.b, y);
      decided = nearestSurface(frame.b, y, 0, required).lower > error;
      if (decided) inside = placeOf(y, frame.b, counts).inside();
    }
    if (!decided) inside = liesInPosed(p, frame);
    if (inside) return p;
  }
  return std::nullopt;
}

KIOS_INSTANTIATE_FUNCTION(surfacesMeet);
KIOS_INSTANTIATE_FUNCTION(toB);
KIOS_INSTANTIATE_FUNCTION(inverseError);
KIOS_INSTANTIATE_FUNCTION(containedPoint);

}  // namespace kios
