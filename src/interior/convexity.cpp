// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "interior/convexity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interior/extent_along.h"
#include "model/prepared.h"
#include "query/ray_walk.h"

namespace kios {

template <typename S>
Convexity measureConvexity(const Model<S>& model) {
  constexpr double kMost = 0x1p-20;
  // About the root's centre, so that models far from their origin lose no digits.
  const kIOS<S>& root = model.getBV(0).bv;
  const fcl::Vector3d center = root.center0.template cast<double>();
  const double size = 2 * double{root.radius0}, largest = largestOf(model);
  double above = 0, below = std::numeric_limits<double>::infinity(), farthest = 0;
  fcl::Vector3d asked = fcl::Vector3d::Zero();
  for (int t = 0; t < model.num_tris; ++t) {
    const fcl::Triangle& ids = model.tri_indices[t];
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) continue;
    fcl::Vector3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = model.vertices[ids[k]].template cast<double>();
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;  // passed once each way
    const fcl::Vector3d u = p[1] - p[0], v = p[2] - p[0], w = p[2] - p[1];
    const double longest = std::max({u.norm(), v.norm(), w.norm()});
    const fcl::Vector3d cross = (u / longest).cross(v / longest);
    const double thin = cross.norm();  // the height over the longest edge, relative to it
    if (!(thin > 0)) return {};
    const fcl::Vector3d n = cross / thin;
    // Edges are right to a rounding, so that the normal is off by less than 2^-48 / thin, and
    // heights over the centre by that of the size, and by the rounding of coordinates.
    const double error = 0x1p-48 / thin * size + 0x1p-46 * largest;
    const double at = n.dot(p[0] - center);
    // A flat face has many triangles, and along its normal all its vertices are farthest: what was
    // found for nearly the same normal holds, but for the turn.
    const double turned = (n - asked).norm() * 0.5 * size;
    if (!(turned <= error)) {
      asked = n;
      farthest = farthestAlong(model, n).height - n.dot(center);
    }
    const double found = farthest + (turned <= error ? turned : 0.0);
    above = std::max(above, found - at + error);
    below = std::min(below, at - error);  // the root's centre is at height 0
    if (!(below > 0) || !(above <= kMost * below)) return {};
  }
  if (!std::isfinite(below)) return {};  // sheets and needles: no inside
  Convexity result;
  result.convex = true;
  result.moved = 1.01 * above / (above + below) * size;
  result.graph = VertexGraph(viewOf(model));
  return result;
}

template Convexity measureConvexity(const Model<double>&);
template Convexity measureConvexity(const Model<float>&);

}  // namespace kios
