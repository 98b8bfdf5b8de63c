// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "search/prepared_pair.h"

// The triangle kernels over all pairs of triangles, whose answer a search must find.

namespace kios::testing {

template <typename S>
struct AllPairs {
  S distance = std::numeric_limits<S>::infinity();
  engine::TrianglePairIds nearest;  ///< the least ids at that distance
  double extent = 0;                ///< of that pair
  std::vector<engine::TrianglePairIds> hits;
};

template <typename S>
AllPairs<S> allPairs(const PosedPair<S>& posed) {
  AllPairs<S> all;
  std::vector<TriangleVertices<S>> of_b;
  for (std::size_t j = 0; j < posed.b.triangles.size(); ++j) of_b.push_back(posed.cornersOfB(j));
  for (std::size_t i = 0; i < posed.a.triangles.size(); ++i) {
    const TriangleVertices<S> p = posed.a.corners(i);
    for (std::size_t j = 0; j < of_b.size(); ++j) {
      const engine::TrianglePairIds ids = {static_cast<int>(i), static_cast<int>(j)};
      const S distance = triangleDistance(p, of_b[j]).distance;
      if (distance < all.distance) {
        all.distance = distance;
        all.nearest = ids;
        all.extent = extentOf(p, of_b[j]);
      }
      if (trianglesIntersect(p, of_b[j])) all.hits.push_back(ids);
    }
  }
  return all;
}

}  // namespace kios::testing
