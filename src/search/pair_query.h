// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "fcl_kios/triangle.h"
#include "volume/rounding.h"

// The question about the distance of two meshes, and its answer: the same for both kinds of trees.

namespace kios::engine {

/// A pair of triangles, by index; -1 if there is none.
struct TrianglePairIds {
  int a = -1, b = -1;

  bool operator<(const TrianglePairIds& o) const { return a != o.a ? a < o.a : b < o.b; }
  bool operator==(const TrianglePairIds& o) const { return a == o.a && b == o.b; }
};

/// Once a pair `distance` apart was found, those that are at least so far apart don't matter.
inline double cullDistance(double distance, double rel_err, double abs_err) {
  return std::max(0.0, std::min(distance - abs_err, distance / (1 + rel_err)));
}

/// A question about the distance of two meshes, and when its search may end. The defaults ask for
/// the exact distance.
struct PairQuery {
  double rel_err = 0, abs_err = 0;
  double near_enough = 0;         ///< a pair so near ends the search
  double far_enough = kInfinity;  ///< pairs so far don't matter
  long long max_expansions = std::numeric_limits<long long>::max();
  TrianglePairIds start;  ///< triangles to begin with, if any; exact answers don't depend on them
  bool any_touching = false;  ///< of triangles that touch, any may be named, of all models

  bool isExact() const { return rel_err == 0 && abs_err == 0; }
  bool hasBudget() const { return max_expansions != std::numeric_limits<long long>::max(); }
  bool endsEarly() const { return near_enough > 0 || hasBudget(); }
  double cullDistance(double distance) const {
    return engine::cullDistance(distance, rel_err, abs_err);
  }
};

/// The reason why a search ended.
enum class SearchEnd {
  kDone,   ///< nothing that matters is left
  kNear,   ///< the triangles of the answer are at most near_enough apart
  kBudget  ///< max_expansions were spent
};

/// The nearest triangles that were found: distance - exact <= max(rel_err * exact, abs_err), and 16
/// eps of their extent where both are 0, if the search was done and the pair is nearer than
/// far_enough. Of equally near pairs that with the least ids, at distance 0 any.
struct PairAnswer {
  TrianglePairIds ids;             ///< none if no pair was looked at
  TriangleDistanced nearest = {};  ///< of ids, in A's frame
  /// The least distance that was evaluated, right to 16 eps of the extent of any two triangles.
  double least_evaluated = kInfinity;
  double least_other = 0;  ///< proven of all pairs that were not evaluated
  /// Proven of those that were, if their volumes told more than their distances.
  double proven_evaluated = -kInfinity;
  double roots = 0;  ///< proven of all by the roots, where these were looked at
  SearchEnd end = SearchEnd::kDone;

  bool found() const { return ids.a >= 0; }
};

}  // namespace kios::engine
