// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_kios/distance.h"
#include "search/mesh_pair.h"
#include "search/mesh_search.h"
#include "search/pair_query.h"

// The searches about a pair of meshes, behind every call that asks for a distance or a first
// contact: by the kernels, or in double where lengths are beyond the range of floats.

namespace kios {

/// The nearest triangles. Throws nothing of its own, as the pair was checked when its frame was
/// built.
engine::PairAnswer searchNearest(const MeshPair& frame, const engine::PairQuery& query,
                                 SearchCounts& counts);

/// Shows every pair of triangles that may touch, once, until visit(ids) returns true.
void visitTouching(const MeshPair& frame, const engine::VisitPair& visit, SearchCounts& counts);

/// Up to `limit` > 0 pairs of triangles that intersect, by ids.
std::vector<engine::TrianglePairIds> searchContacts(const MeshPair& frame, std::size_t limit,
                                                    SearchCounts& counts);

/// The answer of kios::distanceBracket(), but for the nearest points: in A's frame, set if a pair
/// was found.
DistanceBracketResultd bracketDistance(const MeshPair& frame, const engine::PairQuery& query);

}  // namespace kios
