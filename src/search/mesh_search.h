// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
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

/// The answer in the trees. Exact answers don't depend on where the search began.
template <typename S>
PairAnswer<S> nearestTriangles(const PreparedPair<S>& pair, const PairQuery& query,
                               SearchCounts& counts);

/// Shows every pair of triangles that may touch, once, until visit(ids) returns true.
using VisitPair = std::function<bool(const TrianglePairIds&)>;
template <typename S>
void visitTouching(const PreparedPair<S>& pair, const VisitPair& visit, SearchCounts& counts);

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
template <typename S>
std::vector<TrianglePairIds> intersectingTriangles(const PreparedPair<S>& pair, std::size_t limit,
                                                   SearchCounts& counts);

}  // namespace kios::engine
