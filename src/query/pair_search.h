// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"

// The searches about a pair of meshes, behind every call that asks for a distance or a first
// contact. They prepare the models if need be. Pairs that the engine can't serve (models whose
// BVFitter is not ours, lengths beyond the range of floats) are searched in FCL's tree, with the
// same answers: exact distances, and of equally near triangles the least ids.

namespace kios {

/// The nearest triangles. Throws nothing of its own, as the pair was checked when its frame was
/// built.
template <typename S>
engine::PairAnswer<S> searchNearest(const MeshPair<S>& frame, const engine::PairQuery& query,
                                    SearchCounts& counts);

/// Returns true if both models are prepared as they are now.
template <typename S>
bool arePrepared(const MeshPair<S>& frame);

/// Returns true if both models are prepared, or queries that charge() noted have cost as much.
template <typename S>
bool treesPay(const MeshPair<S>& frame);

/// Charges both models, where they aren't prepared, for a query that looked at a few triangles
/// instead of trees, which took as long as so many tests of volumes.
template <typename S>
void charge(const MeshPair<S>& frame, long long tests);

/// True only if the engine serves the pair, told without its trees; false says nothing.
template <typename S>
bool engineServes(const MeshPair<S>& frame);

/// Up to `limit` pairs of triangles that intersect, by ids. False if the engine can't serve the
/// pair; `found` is then as it was.
template <typename S>
bool searchContacts(const MeshPair<S>& frame, std::size_t limit,
                    std::vector<engine::TrianglePairIds>& found, SearchCounts& counts);

/// Lists up to `limit` > 0 pairs of triangles that intersect, by whatever is fastest for models of
/// their sizes. Which pairs a list of exactly `limit` holds doesn't depend on what was prepared,
/// unless `any` will do. Gives nothing if the engine can't serve the models: FCL's tree must.
template <typename S>
std::optional<std::vector<engine::TrianglePairIds>> intersectingPairs(const MeshPair<S>& frame,
                                                                      std::size_t limit, bool any,
                                                                      SearchCounts& counts);

}  // namespace kios
