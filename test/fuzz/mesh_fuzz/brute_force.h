// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "all_pairs.h"
#include "fuzz/mesh_fuzz/fuzz_case.h"

// The judge of the searches: the triangle kernels over all pairs of triangles, in the common frame.
// The kernels themselves are judged by the question "kernel".

namespace kios::fuzz {

/// Holds all pairs of triangles of two meshes, in the frame of the first: in double, as S holds the
/// meshes; the distance that S answers is that one rounded.
template <typename S>
class BruteForce : public testing::AllPairs {
 public:
  static constexpr double kEps = std::numeric_limits<S>::epsilon();
  static constexpr double kEpsInDouble = std::numeric_limits<double>::epsilon();  ///< the search's
  /// Below the scalar's normal numbers, results are rounded absolutely.
  static constexpr double kLeast = std::numeric_limits<S>::min();

  BruteForce(const Mesh& of_a, const fcl::Transform3<S>& X_WA, const Mesh& of_b,
             const fcl::Transform3<S>& X_WB)
      : AllPairs(trianglesOf(of_a), trianglesOf(of_b), RelativePosed(X_WA, X_WB)),
        X_AB(X_WA, X_WB),
        in_double(AllPairs::distance),
        distance(rounded<S>()),
        b_in_b_(trianglesOf(of_b)) {
    for (const double d : AllPairs::distances) rounded_.push_back(testing::roundedAnswer<S>(d));
  }

  S distanceOf(const Ids& ids) const {
    return testing::roundedAnswer<S>(AllPairs::distanceOf(ids));
  }
  const std::vector<S>& distances() const { return rounded_; }  ///< [a][b]
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
  const testing::Triangles& trianglesInB() const { return b_in_b_; }

  const RelativePosed X_AB;
  double in_double;  ///< the distance before rounding
  S distance;

  static testing::Triangles trianglesOf(const Mesh& mesh) {
    return testing::trianglesOf<S>(testing::MeshIn<S>(mesh));
  }

 private:
  const testing::Triangles b_in_b_;
  std::vector<S> rounded_;
};

}  // namespace kios::fuzz
