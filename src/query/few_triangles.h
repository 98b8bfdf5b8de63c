// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/search/counts.h"
#include "query/mesh_pair.h"
#include "search/pair_query.h"

// Small bodies are looked at triangle by triangle or vertex by vertex: trees, and their
// preparation, would take longer.

namespace kios {

constexpr int kFewTriangles = 64, kVeryFewPairs = 64, kMostPairByPair = 128, kFewestPairs = 4;

/// True for models of so few triangles that all pairs are looked at for contacts faster than any
/// tree is walked: boxes against spheres of 40 triangles, a quadrilateral among four posts. Found
/// by trying.
template <typename S>
bool areFew(const Model<S>& a, const Model<S>& b) {
  constexpr int kFewPairs = 512, kFewOfEach = 32, kFewOfOne = 2;
  const bool a_fewer = a.num_tris < b.num_tris;
  const Model<S>&fewer = a_fewer ? a : b, &other = a_fewer ? b : a;
  if (other.num_tris <= kFewOfEach) return fewer.num_tris * other.num_tris <= kFewPairs;
  // What is smaller than the other model lies near few of its triangles.
  return fewer.num_tris <= kFewOfOne && other.num_tris <= kFewTriangles &&
         fewer.getBV(0).bv.radius0 < other.getBV(0).bv.radius0;
}

/// Tells it for distances, which take more of each pair: of two boxes they take ten times as long
/// as the engine's.
template <typename S>
bool areVeryFew(const Model<S>& a, const Model<S>& b) {
  return areFew(a, b) && a.num_tris * b.num_tris <= kVeryFewPairs;
}

/// Tells it for so few pairs that no tree tells their distance sooner than their triangles.
template <typename S>
bool arePairByPair(const Model<S>& a, const Model<S>& b) {
  return areFew(a, b) && a.num_tris * b.num_tris <= kMostPairByPair;
}

/// Tells it for so few pairs that no bound of the models takes less than their triangles.
template <typename S>
bool areFewest(const Model<S>& a, const Model<S>& b) {
  return areFew(a, b) && a.num_tris * b.num_tris <= kFewestPairs;
}

/// Returns up to `limit` pairs of few triangles that intersect, all of them if there are no more,
/// by ids.
template <typename S>
std::vector<engine::TrianglePairIds> intersectingOfFew(const MeshPair<S>& frame, std::size_t limit,
                                                       SearchCounts& counts);

/// Returns the nearest of very few triangles that the engine serves, and of which touchingOfFew()
/// found none, of those nearer than query.far_enough, as searchNearest() names them for exact
/// queries; not found if there are none.
template <typename S>
engine::PairAnswer<S> nearestOfFew(const MeshPair<S>& frame, const engine::PairQuery& query,
                                   SearchCounts& counts);

/// Returns the nearest triangles of models that are looked at pair by pair, of those nearer than
/// query.far_enough, for exact queries, whatever their scale and budget. Where they touch, the
/// least ids; of pairs that are equally near but for rounding, the first that is found.
template <typename S>
engine::PairAnswer<S> nearestPairByPair(const MeshPair<S>& frame, const engine::PairQuery& query,
                                        SearchCounts& counts);

/// Returns the answer of exact queries about few triangles that touch: the least ids that do,
/// prepared or not, with points unless any_touching; an answer without ids if none do, and nothing
/// where a search tells it sooner.
template <typename S>
std::optional<engine::PairAnswer<S>> touchingOfFew(const MeshPair<S>& frame,
                                                   const engine::PairQuery& query,
                                                   SearchCounts& counts);

/// True only if a plane between the vertices of two models proves their triangles, as placed in the
/// common frame, more than `margin` >= 0 apart; false says nothing. Planes are tried in a few
/// directions, and only for models of few vertices.
template <typename S>
bool verticesApart(const MeshPair<S>& frame, double margin);

}  // namespace kios
