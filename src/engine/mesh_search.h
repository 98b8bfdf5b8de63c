// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/mesh.h"
#include "engine/search.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/volume/separation.h"

namespace kios::engine {

/// A mesh with its tree.
template <typename S>
struct PreparedMesh {
  const Tree& tree;
  MeshView<S> mesh;
};

/// Two meshes at a pose, in the frame of the first.
template <typename S>
struct PreparedPair {
  PreparedMesh<S> a, b;
  const RelativePose<S>& X_AB;
  FramePair frames;
  Audit* audit = nullptr;
};

/// Which distance is asked for.
template <typename S>
struct DistanceBounds {
  S at_most;  ///< only pairs nearer than this count
  S rel_err = 0, abs_err = 0;
};

/// A pair of triangles, by index; -1 if there is none.
struct TrianglePairIds {
  int a = -1, b = -1;

  bool operator<(const TrianglePairIds& o) const { return a != o.a ? a < o.a : b < o.b; }
  bool operator==(const TrianglePairIds& o) const { return a == o.a && b == o.b; }
};

/// The nearest triangles: d - d_exact <= max(rel_err * d_exact, abs_err), and 16 eps L where both
/// are 0. None if no pair is nearer than at_most. Of equally near pairs that with the least ids,
/// at distance 0 any.
template <typename S>
TrianglePairIds nearestTriangles(const PreparedPair<S>& pair, const DistanceBounds<S>& bounds,
                                 TriangleDistance<S>& nearest, SearchCounts& counts);

/// A bracket of the distance, and when the search for it may end.
template <typename S>
struct BracketQuery {
  double rel_err = 0, abs_err = 0;
  double near_enough = 0;                                       ///< a pair so near ends it
  double far_enough = std::numeric_limits<double>::infinity();  ///< pairs so far don't matter
  long long max_expansions = std::numeric_limits<long long>::max();
  TrianglePairIds start;  ///< triangles to begin with, if any; exact answers don't depend on them

  bool isExact() const { return rel_err == 0 && abs_err == 0; }
  /// The search of exact answers is then as fast as that of brackets.
  bool isNearlyExact() const { return rel_err <= 0.01 && abs_err == 0; }
  bool hasBudget() const { return max_expansions != std::numeric_limits<long long>::max(); }
  bool endsEarly() const { return near_enough > 0 || hasBudget(); }
};

/// Why a search ended.
enum class SearchEnd {
  kDone,   ///< nothing that matters is left
  kNear,   ///< the triangles of the answer are at most near_enough apart
  kBudget  ///< max_expansions were spent
};

template <typename S>
struct BracketResult {
  TrianglePairIds ids;               ///< the nearest that were found, if any were looked at
  TriangleDistance<S> nearest = {};  ///< of ids
  /// The least distance that was evaluated, right to 16 eps of the extent of any two triangles.
  double least_evaluated = std::numeric_limits<double>::infinity();
  double least_other = 0;  ///< proven of all pairs that were not evaluated
  SearchEnd end = SearchEnd::kDone;
};

/// The distance as far as it was asked for. Exact answers are those of nearestTriangles().
template <typename S>
BracketResult<S> bracketDistance(const PreparedPair<S>& pair, const BracketQuery<S>& query,
                                 SearchCounts& counts);

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
template <typename S>
std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair, std::size_t limit,
                                                   SearchCounts& counts);

}  // namespace kios::engine
