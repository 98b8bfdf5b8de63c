// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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
class AllPairs {
 public:
  using Ids = std::pair<int, int>;
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
  /// Below the scalar's normal numbers, results are rounded absolutely.
  static constexpr double kLeast = std::numeric_limits<S>::min();

  AllPairs(Triangles<S> a, Triangles<S> b, const RelativePose<S>& pose)
      : X_AB(pose), a_(std::move(a)), b_in_b_(std::move(b)), b_(b_in_b_) {
    for (auto& q : b_) q = {X_AB * q[0], X_AB * q[1], X_AB * q[2]};
    distances_.reserve(a_.size() * b_.size());
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        const S d = triangleDistance(a_[i], b_[j]).distance;
        const Ids ids = {static_cast<int>(i), static_cast<int>(j)};
        distances_.push_back(d);
        if (distances_.size() == 1 || d < distance) {
          distance = d;
          nearest = ids;
        }
        if (trianglesIntersect(a_[i], b_[j])) hits.push_back(ids);
      }
    }
    if (!distances_.empty()) extent = extentOf(nearest);
  }

  bool contains(const Ids& ids) const {
    return ids.first >= 0 && ids.first < static_cast<int>(a_.size()) && ids.second >= 0 &&
           ids.second < static_cast<int>(b_.size());
  }
  S distanceOf(const Ids& ids) const {
    return distances_[static_cast<std::size_t>(ids.first) * b_.size() +
                      static_cast<std::size_t>(ids.second)];
  }
  /// Returns L of the contract.
  double extentOf(const Ids& ids) const {
    return testing::extentOf(a_[static_cast<std::size_t>(ids.first)],
                             b_[static_cast<std::size_t>(ids.second)]);
  }
  /// The largest difference of two right answers, one for these triangles and one for the nearest:
  /// 16 eps L each.
  double tolerance(const Ids& ids) const {
    return 16 * kEps * (extentOf(ids) + extentOf(nearest)) + 2 * kLeast;
  }
  /// Bounds the error of the place of b's triangle in the common frame (docs/guarantees.md).
  double frameError(int b) const {
    double most = 0;
    for (const auto& p : b_in_b_[static_cast<std::size_t>(b)]) {
      most = std::max(most, p.template cast<double>().stableNorm());
    }
    const auto& bounds = detail::boundsOf(X_AB);
    return 4 * 1.8 * kEps * ((1 + bounds.stretch) * most + bounds.T_norm1);
  }
  const std::vector<S>& distances() const { return distances_; }  ///< [a][b]
  const Triangles<S>& trianglesOfA() const { return a_; }
  const Triangles<S>& trianglesOfB() const { return b_; }  ///< in A
  const Triangles<S>& trianglesInB() const { return b_in_b_; }

  const RelativePose<S> X_AB;
  S distance = std::numeric_limits<S>::infinity();
  Ids nearest{-1, -1};  ///< the least ids at that distance
  double extent = 0;    ///< of that pair
  std::vector<Ids> hits;

 private:
  const Triangles<S> a_, b_in_b_;
  Triangles<S> b_;
  std::vector<S> distances_;
};

}  // namespace kios::testing
