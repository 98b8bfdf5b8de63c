// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/triangle/intersection.h"
#include "search/mesh_search.h"
#include "volume/rounding.h"

// The triangles that a search asks the exact kernels about, and what it remembers of the answers.

namespace kios::engine {

/// Features in the common frame, whose coordinates are rounded to S.
template <typename S>
class Corners {
 public:
  Corners(const MeshView<S>& a, const MeshView<S>& b, const RelativePose<S>& X_AB)
      : a_(a), b_(b), X_AB_(X_AB) {}
  explicit Corners(const PreparedPair<S>& pair) : Corners(pair.a.mesh, pair.b.mesh, pair.X_AB) {}

  Eigen::Vector3d ofA(FeatureId id, std::uint32_t step = 0) const {
    return a_.corner(id.triangle(), next(id, step)).template cast<double>();
  }
  Eigen::Vector3d ofB(FeatureId id, std::uint32_t step = 0) const {
    const fcl::Vector3<S> q = X_AB_ * b_.corner(id.triangle(), next(id, step));
    return q.template cast<double>();
  }
  TriangleVertices<S> triangleOfA(std::uint32_t t) const {
    return {a_.corner(t, 0), a_.corner(t, 1), a_.corner(t, 2)};
  }
  TriangleVertices<S> triangleOfB(std::uint32_t t) const {
    return {X_AB_ * b_.corner(t, 0), X_AB_ * b_.corner(t, 1), X_AB_ * b_.corner(t, 2)};
  }
  TriangleDistance<S> distanceOf(const TrianglePairIds& ids) const {
    return triangleDistance(triangleOfA(static_cast<std::uint32_t>(ids.a)),
                            triangleOfB(static_cast<std::uint32_t>(ids.b)));
  }
  std::size_t numTriangles() const { return a_.num_triangles + b_.num_triangles; }
  /// How far all of b lies beyond all of a along n, of any length, from `origin`; less than what
  /// rounding may have made of it. A difference, three products and two sums: each height is off by
  /// at most 6 u of the sum of its terms' absolute values.
  double gapAlong(const Eigen::Vector3d& n, const Eigen::Vector3d& origin) const {
    const auto least = [&](std::size_t num_triangles, double sign, const auto& triangleOf) {
      double height = kInfinity, terms = 0;
      for (std::uint32_t t = 0; t < num_triangles; ++t) {
        for (const auto& p : triangleOf(t)) {
          const Eigen::Vector3d v = n.cwiseProduct(p.template cast<double>() - origin);
          height = std::min(height, sign * (v[0] + v[1] + v[2]));
          terms = std::max(terms, v.template lpNorm<1>());
        }
      }
      return height - 8 * kUlpDouble * terms;
    };
    const double of_b = least(b_.num_triangles, 1, [&](std::uint32_t t) { return triangleOfB(t); }),
                 of_a =
                     least(a_.num_triangles, -1, [&](std::uint32_t t) { return triangleOfA(t); });
    return (of_b + of_a) / n.norm() * (1 - 8 * kUlpDouble);
  }
  bool intersect(const TrianglePairIds& ids) const {
    return trianglesIntersect(triangleOfA(static_cast<std::uint32_t>(ids.a)),
                              triangleOfB(static_cast<std::uint32_t>(ids.b)));
  }

 private:
  static std::uint32_t next(FeatureId id, std::uint32_t step) {
    const std::uint32_t k = id.corner() + step;
    return k < 3 ? k : k - 3;
  }
  const MeshView<S> a_, b_;
  const RelativePose<S>& X_AB_;
};

/// Remembers some triangles that don't intersect: those that nearly touch are named by many of
/// their features, and by edges that may cross faces.
class PairsApart {
 public:
  /// Asks the triangles, unless they are known.
  template <typename S>
  bool intersect(const Corners<S>& corners, const TrianglePairIds& ids) {
    if (!known_) known_.emplace();
    const auto a = static_cast<std::uint32_t>(ids.a), b = static_cast<std::uint32_t>(ids.b);
    TrianglePairIds& known = (*known_)[(a * 0x9E3779B1U + b * 0x85EBCA6BU) >> (32 - kBits)];
    if (known == ids) return false;
    if (corners.intersect(ids)) return true;
    known = ids;
    return false;
  }

 private:
  static constexpr std::uint32_t kBits = 6, kNumber = 1U << kBits;
  std::optional<std::array<TrianglePairIds, kNumber>> known_;  // most searches need none
};

}  // namespace kios::engine
