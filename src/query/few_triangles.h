// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"

namespace kios {

/// True for models of so few triangles that all pairs are looked at for contacts faster than any
/// tree is walked: boxes against spheres of 40 triangles. Found by trying.
template <typename S>
bool areFew(const Model<S>& a, const Model<S>& b) {
  constexpr int kMost = 32, kMostPairs = 512;
  return a.num_tris <= kMost && b.num_tris <= kMost && a.num_tris * b.num_tris <= kMostPairs;
}

/// Tells it for distances, which take more of each pair: of two boxes they take ten times as long
/// as the engine's.
template <typename S>
bool areVeryFew(const Model<S>& a, const Model<S>& b) {
  return areFew(a, b) && a.num_tris * b.num_tris <= 64;
}

/// Returns up to `limit` pairs of few triangles that intersect, all of them if there are no more,
/// by ids.
template <typename S>
std::vector<engine::TrianglePairIds> intersectingOfFew(const MeshPair<S>& frame, std::size_t limit,
                                                       SearchCounts& counts);

/// Returns the nearest of very few triangles that the engine serves, of those nearer than
/// `far_enough`, as searchNearest() names them for exact queries; not found if there are none.
template <typename S>
engine::PairAnswer<S> nearestOfFew(const MeshPair<S>& frame, double far_enough,
                                   SearchCounts& counts);

}  // namespace kios
