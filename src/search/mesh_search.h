// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "build/mesh_view.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/volume/separation.h"
#include "search/pair_query.h"
#include "search/search.h"

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
  const TreePose& pose;  ///< of the trees
  FloatFrame frames;
  Audit* audit = nullptr;
};

/// Returns that of these pairs of triangles which nearestTriangles() names, if every pair that
/// rounding may make the nearest is among them. None of them may touch. Needs no trees.
template <typename S>
TrianglePairIds nearestOfThese(const std::vector<TrianglePairIds>& pairs, const MeshView<S>& a,
                               const MeshView<S>& b, const RelativePose<S>& X_AB);

/// The answer in the trees. Exact answers don't depend on where the search began.
template <typename S>
PairAnswer<S> nearestTriangles(const PreparedPair<S>& pair, const PairQuery& query,
                               SearchCounts& counts);

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
template <typename S>
std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair, std::size_t limit,
                                                   SearchCounts& counts);

}  // namespace kios::engine
