// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "tree/tree.h"
#include "volume/rounding.h"

// The types that the SIMD search for the triangles nearest to a point shares with the exact stage.

namespace kios::engine {

/// A point in a tree's frame and unit.
///
/// u = 2^-24, S = reach + |p|_1. Against exact arithmetic on the model's own vertices, in float:
/// - vertices are stored to u reach a coordinate, p is rounded to u |p|: 4 u S;
/// - spheres and caps: |c - p| - r as in float_frame.h, which counts 20 u S with a pose;
/// - boxes: p - c by 2 u S; axes that are orthonormal but for one rounding each, 2 u |p - c|, the
///   dot 7 u |p - c|, and |p - c| <= 2 S; the difference, and the root of the sum of three squares:
///   48 u S in all;
/// - segments of stored vertices: w = p - a and e = b - a are right to u a coordinate, the
///   parameter along e to 11 u max(|w|, |e|) in length, |w - t e| to 10 u S more, the root to 3 u
///   S: 30 u S. It is cut to [0, 1], so that an e whose square vanishes errs by |e| alone;
/// - planes: heights 10 u S over planes that the vertices keep to 4 u reach. A point wrongly taken
///   to be over the face is no nearer to it than to its plane; one wrongly taken to be beside it is
///   within 16 u S of an edge's plane, and so as near to an edge, but for that. A face too thin for
///   a plane, 2^-20 of its longest edge, is within 32 u reach of its edges.
/// All are below 64 u S = `pad`, by at least 2^-20 S where double rounds by 2^-46 S.
struct FloatPoint {
  float at[3];
  float pad;
};

/// Points at most so many reaches away are served: no square overflows. The farther a point is, the
/// more triangles the pad leaves.
constexpr double kFarthestPoint = 0x1p20;

/// False if the point is farther away.
inline bool makeFloatPoint(const Tree& tree, const Eigen::Vector3d& p, FloatPoint& out) {
  const Eigen::Vector3d way = p - Eigen::Map<const Eigen::Vector3d>(tree.origin);
  const double reach = tree.reach;
  if (!(way.cwiseAbs().maxCoeff() <= std::ldexp(kFarthestPoint * reach, tree.exponent)))
    return false;
  const Eigen::Vector3d q(std::ldexp(way[0], -tree.exponent), std::ldexp(way[1], -tree.exponent),
                          std::ldexp(way[2], -tree.exponent));
  for (int c = 0; c < 3; ++c) out.at[c] = roundedTo<float>(q[c]);
  out.pad = roundUpFloat(0x1p-18 * (reach + q.lpNorm<1>()));
  return true;
}

/// The exact side of a search.
class PointEvaluator {
 public:
  /// Evaluates a triangle, which may lower `cull_distance`.
  virtual void evaluate(std::uint32_t triangle) = 0;

  float cull_distance = kInfinityFloat;  ///< triangles at least so far away don't matter

 protected:
  ~PointEvaluator() = default;
};

struct PointSearch {
  const Tree& tree;
  const FloatPoint& point;
  PointEvaluator& evaluator;
};

}  // namespace kios::engine
