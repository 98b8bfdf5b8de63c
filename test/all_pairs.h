// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "fcl_kios/model/model.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "fcl_kios/volume/separation.h"
#include "shapes.h"

// The triangle kernels over all pairs of triangles, whose answer every search must find.

namespace kios::testing {

template <typename S>
using Triangles = std::vector<TriangleVertices<S>>;

template <typename S>
Triangles<S> trianglesOf(const MeshIn<S>& mesh) {
  Triangles<S> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) triangles.push_back(mesh.corners(t));
  return triangles;
}
template <typename S>
Triangles<S> trianglesOf(const Model<S>& m) {
  Triangles<S> triangles;
  for (int t = 0; t < m.num_tris; ++t) {
    const fcl::Triangle& ids = m.tri_indices[t];
    triangles.push_back({m.vertices[ids[0]], m.vertices[ids[1]], m.vertices[ids[2]]});
  }
  return triangles;
}

/// Holds what the kernels say of all pairs of a and b, whose triangles X_AB moves to A's frame.
template <typename S>
struct AllPairs {
  using Ids = std::pair<int, int>;

  AllPairs(const Triangles<S>& a, Triangles<S> b, const RelativePose<S>& X_AB) {
    for (auto& q : b) q = {X_AB * q[0], X_AB * q[1], X_AB * q[2]};
    for (int i = 0; i < static_cast<int>(a.size()); ++i) {
      for (int j = 0; j < static_cast<int>(b.size()); ++j) {
        const S d = triangleDistance(a[i], b[j]).distance;
        if (d < distance) {
          distance = d;
          nearest = {i, j};
          extent = extentOf(a[i], b[j]);
        }
        if (trianglesIntersect(a[i], b[j])) hits.emplace_back(i, j);
      }
    }
  }

  S distance = std::numeric_limits<S>::infinity();
  Ids nearest{-1, -1};  ///< the least ids at that distance
  double extent = 0;    ///< of that pair
  std::vector<Ids> hits;
};

}  // namespace kios::testing
