// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "search/mesh_pair.h"
#include "search/pair_query.h"
#include "search/search.h"

namespace kios::engine {

// Searches by the kernels, of pairs whose lengths are in the range of floats.

/// The answer in the trees. Exact answers don't depend on where the search began.
PairAnswer nearestTriangles(const MeshPair& pair, const PairQuery& query, SearchCounts& counts,
                            Audit* audit = nullptr);

/// Shows every pair of triangles that may touch, once, until visit(ids) returns true.
using VisitPair = std::function<bool(const TrianglePairIds&)>;
void visitTouching(const MeshPair& pair, const VisitPair& visit, SearchCounts& counts,
                   Audit* audit = nullptr);

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
std::vector<TrianglePairIds> intersectingTriangles(const MeshPair& pair, std::size_t limit,
                                                   SearchCounts& counts, Audit* audit = nullptr);

}  // namespace kios::engine
