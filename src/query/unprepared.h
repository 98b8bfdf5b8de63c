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
/// exact queries that the engine serves; not found if there are none. Nothing is returned of more
/// than few triangles that touch, unless any may be named: which it is only the engine knows.
template <typename S>
std::optional<engine::PairAnswer<S>> nearestUnprepared(const MeshPair<S>& frame,
                                                       const engine::PairQuery& query,
                                                       SearchCounts& counts);

}  // namespace kios
