// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "all_pairs.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "fcl_kios/volume/separation.h"
#include "fuzz/mesh_fuzz/fuzz_case.h"
#include "shapes.h"

// The judge of the searches: the triangle kernels over all pairs of triangles, in the common frame.
// The kernels themselves are judged by the question "kernel".

namespace kios::fuzz {

/// Holds all pairs of triangles of two meshes, in the frame of the first: in double, as S holds the
/// meshes, but for the distances, which are rounded to S as answers are.
template <typename S>
class BruteForce {
 public:
  using Ids = std::pair<int, int>;
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
  static constexpr double kEpsInDouble = std::numeric_limits<double>::epsilon();  ///< the search's
  /// Below the scalar's normal numbers, results are rounded absolutely.
  static constexpr double kLeast = std::numeric_limits<S>::min();

  BruteForce(const Mesh& a, const fcl::Transform3<S>& X_WA, const Mesh& b,
             const fcl::Transform3<S>& X_WB)
      : X_AB(X_WA, X_WB), a_(trianglesOf(a)), b_in_b_(trianglesOf(b)), b_(b_in_b_) {
    for (auto& t : b_) t = {X_AB * t[0], X_AB * t[1], X_AB * t[2]};
    distances_.reserve(a_.size() * b_.size());
    for (std::size_t i = 0; i < a_.size(); ++i) {
      for (std::size_t j = 0; j < b_.size(); ++j) {
        const double d = triangleDistance(a_[i], b_[j]).distance;
        const Ids ids = {static_cast<int>(i), static_cast<int>(j)};
        distances_.push_back(testing::roundedAnswer<S>(d));
        if (d < in_double) {
          in_double = d;
          distance = distances_.back();
          nearest = ids;
        }
        if (trianglesIntersect(a_[i], b_[j])) hits.push_back(ids);
      }
    }
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
      most = std::max(most, p.stableNorm());
    }
    const auto& bounds = detail::boundsOf(X_AB);
    return 4 * 1.8 * kEpsInDouble * ((1 + bounds.stretch) * most + bounds.T_norm1);
  }
  const std::vector<S>& distances() const { return distances_; }
  const std::vector<TriangleVerticesd>& trianglesOfA() const { return a_; }
  const std::vector<TriangleVerticesd>& trianglesOfB() const { return b_; }  ///< in A
  const std::vector<TriangleVerticesd>& trianglesInB() const { return b_in_b_; }

  const RelativePosed X_AB;
  double in_double = std::numeric_limits<double>::infinity();  ///< the distance before rounding
  S distance = 0;
  Ids nearest;  ///< the least ids at that distance
  std::vector<Ids> hits;

  static std::vector<TriangleVerticesd> trianglesOf(const Mesh& mesh) {
    std::vector<TriangleVerticesd> triangles;
    for (const fcl::Triangle& t : mesh.triangles) {
      const auto held = [&](int k) {
        return Pointd(mesh.vertices[t[k]].template cast<S>().template cast<double>());
      };
      triangles.push_back({held(0), held(1), held(2)});
    }
    return triangles;
  }

 private:
  const std::vector<TriangleVerticesd> a_, b_in_b_;
  std::vector<TriangleVerticesd> b_;
  std::vector<S> distances_;  ///< [a][b]
};

}  // namespace kios::fuzz
