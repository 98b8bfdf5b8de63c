// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "fcl_kios/detail/counts.h"
#include "tree/tree.h"
#include "volume/ray_interval.h"

// The types that the SIMD search for a ray's hits shares with the exact stage.

namespace kios::engine {

/// A line in a tree's frame: lengths s from its point nearest to the tree's origin.
///
/// u = 2^-24, R = tree.reach, e the error of that point in double. A line that meets the model
/// comes within R of the origin, so that |s| <= 2 R at every point x of the model on it. In float:
/// - the point and the direction are rounded, x by u R: x is within e + 4 u R of the line's point
/// s;
/// - spheres: as in volume/ray_interval.cpp, with sums for centres and radii: 26 u R for the
/// radius,
///   20 u R for the ends, all in all below 40 u R;
/// - boxes: heights of x over a slab's middle 22 u R + e, the ends 12 u R;
/// - faces: x lies within 4 u R of the plane n and above the edge planes m as they are stored
///   (heights of vertices; see leaf_layout.cpp). With H = height of the near point over n, D = n .
///   f, M and E likewise for m: |H + s D| <= 10 u R + e, and M D - H E has D's sign to 16 u R + 2
///   e, as computed to 42 u R more. D may have the wrong sign below 8 u; but then |H| <= 26 u R +
///   e, and both are below 58 u R + 2 e in magnitude. Faces too thin for planes have H = D = E = 0.
/// 2^-18 R = 64 u R, and twice the pad for faces, cover each.
struct FloatRay {
  float origin[3], direction[3];  ///< the near point; a unit vector
  float pad;
  float begin, end;  ///< of s, within the model
};

enum class RayFit { kServed, kMiss, kBlind };

/// kMiss: the ray is proven to miss the model. kBlind: it comes from so far that floats tell
/// nothing of it, and the ray meets all.
RayFit makeFloatRay(const Tree& tree, const RayLine& line, double t_min, double t_max,
                    RayLine::Near& near, FloatRay& ray);

/// A length for a FloatRay: rounded, what is beyond the model cut off.
float toLength(const Tree& tree, double s);

/// The exact side of a search.
class RayEvaluator {
 public:
  /// Evaluates a triangle, which may lower `end`. Returns true to end the search.
  virtual bool evaluate(std::uint32_t triangle) = 0;

  float end;  ///< hits at a larger s don't matter

 protected:
  ~RayEvaluator() = default;
};

struct RaySearch {
  const Tree& tree;
  const FloatRay& ray;
  RayEvaluator& evaluator;
  SearchCounts& counts;
};

}  // namespace kios::engine
