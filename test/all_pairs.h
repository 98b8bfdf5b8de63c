// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "fcl_kios/model.h"
#include "fcl_kios/triangle.h"
#include "fcl_kios/volume.h"
#include "scenes/containment_oracle.h"
#include "shapes.h"

// The triangle kernels over all pairs of triangles, whose answer every search must find.

namespace kios::testing {

using Triangles = std::vector<TriangleVerticesd>;

template <typename S>
TriangleVerticesd inDouble(const TriangleVertices<S>& t) {
  return {t[0].template cast<double>(), t[1].template cast<double>(), t[2].template cast<double>()};
}
template <typename S>
Triangles trianglesOf(const MeshIn<S>& mesh) {
  Triangles triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    triangles.push_back(inDouble<S>(mesh.corners(t)));
  }
  return triangles;
}
template <typename S>
Triangles trianglesOf(const Model<S>& m) {
  Triangles triangles;
  for (int t = 0; t < m.num_tris; ++t) {
    const fcl::Triangle& ids = m.tri_indices[t];
    triangles.push_back(inDouble<S>({m.vertices[ids[0]], m.vertices[ids[1]], m.vertices[ids[2]]}));
  }
  return triangles;
}

/// Returns how often the triangles wind round p: the sum of the angles under which it sees them.
inline long double windingNumber(const Triangles& triangles, const fcl::Vector3d& p) {
  long double sum = 0;
  for (const TriangleVerticesd& t : triangles) sum += scenes::windingOf(t, p);
  return sum;
}

/// Returns a distance as a query in S answers: rounded once, never to 0.
template <typename S>
S roundedAnswer(double distance) {
  const S nearest = static_cast<S>(distance);
  return distance > 0 ? std::max(nearest, std::numeric_limits<S>::denorm_min()) : S(0);
}

/// Holds what the kernels say of all pairs of a and b, whose triangles X_AB moves to A's frame: in
/// double, as queries of float models have it, too.
struct AllPairs {
  using Ids = std::pair<int, int>;

  AllPairs(Triangles of_a, Triangles of_b, const RelativePosed& X_AB)
      : a(std::move(of_a)), b(std::move(of_b)) {
    for (auto& q : b) q = {X_AB * q[0], X_AB * q[1], X_AB * q[2]};
    distances.reserve(a.size() * b.size());
    for (int i = 0; i < static_cast<int>(a.size()); ++i) {
      for (int j = 0; j < static_cast<int>(b.size()); ++j) {
        const double d = triangleDistance(a[i], b[j]).distance;
        distances.push_back(d);
        if (d < distance) {
          distance = d;
          nearest = {i, j};
          extent = extentOf(nearest);
        }
        if (trianglesIntersect(a[i], b[j])) hits.emplace_back(i, j);
      }
    }
  }

  template <typename S>
  S rounded() const {
    return roundedAnswer<S>(distance);
  }
  bool contains(const Ids& ids) const {
    return ids.first >= 0 && ids.first < static_cast<int>(a.size()) && ids.second >= 0 &&
           ids.second < static_cast<int>(b.size());
  }
  double distanceOf(const Ids& ids) const {
    return distances[static_cast<std::size_t>(ids.first) * b.size() +
                     static_cast<std::size_t>(ids.second)];
  }
  /// Returns L of the contract.
  double extentOf(const Ids& ids) const {
    return testing::extentOf(a[static_cast<std::size_t>(ids.first)],
                             b[static_cast<std::size_t>(ids.second)]);
  }

  Triangles a, b;                 ///< in A
  std::vector<double> distances;  ///< [a][b]
  double distance = std::numeric_limits<double>::infinity();
  Ids nearest{-1, -1};  ///< the least ids at that distance
  double extent = 0;    ///< of that pair
  std::vector<Ids> hits;
};

}  // namespace kios::testing
