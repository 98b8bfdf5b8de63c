// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"

// Queries of models that nobody prepared. They walk FCL's trees for as long as it hasn't paid to
// prepare both models: see TreeCache::budget(). Where nothing is returned, the engine is to
// answer.

namespace kios {

/// Up to `limit` pairs of triangles that intersect, all of them if there are no more; by ids.
template <typename S>
std::optional<std::vector<engine::TrianglePairIds>> touchUnprepared(const MeshPair<S>& frame,
                                                                    std::size_t limit,
                                                                    SearchCounts& counts);

/// The nearest triangles of those nearer than query.far_enough, as searchNearest() names them for
/// exact queries that the engine serves; not found if there are none. If triangles touch, they are
/// firstTouching()'s: for models of which prepared queries name others, only with `any_touching`.
template <typename S>
std::optional<engine::PairAnswer<S>> nearestUnprepared(const MeshPair<S>& frame,
                                                       const engine::PairQuery& query,
                                                       SearchCounts& counts);

/// True for models of which exact distance queries name firstTouching()'s triangles at distance 0,
/// prepared or not.
template <typename S>
bool namesFirstTouching(const MeshPair<S>& frame) {
  constexpr int kMost = 256;  // of more triangles the engine names a pair sooner
  return frame.a.num_tris <= kMost && frame.b.num_tris <= kMost - frame.a.num_tris;
}

/// The triangles that FCL's trees lead to first of those that intersect. Some must.
template <typename S>
engine::TrianglePairIds firstTouching(const MeshPair<S>& frame, SearchCounts& counts);

}  // namespace kios
