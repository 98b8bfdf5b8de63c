// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/intersecting_pairs.h"

#include <utility>

#include "fcl_kios/triangle/intersection.h"
#include "query/few_triangles.h"
#include "query/pair_search.h"
#include "query/unprepared.h"
#include "query/vertices_apart.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

using PairIds = std::vector<engine::TrianglePairIds>;

/// Returns true if one model is so much larger than the other, as a floor than a link, that its
/// spheres are of no use near it: where both balls don't prove the models apart, boxes must.
template <typename S>
bool areUnlike(const MeshPair<S>& frame) {
  constexpr S kMuch = 16;
  const S a = frame.rootA().radius0, b = frame.rootB().radius0;
  return a > kMuch * b || b > kMuch * a;
}

}  // namespace

template <typename S>
[[gnu::hot]] std::optional<PairIds> intersectingPairs(const MeshPair<S>& frame, std::size_t limit,
                                                      bool any, SearchCounts& counts) {
  if (frame.a.num_tris == 1 && frame.b.num_tris == 1) {  // bounds would take longer
    ++counts.exact;
    return trianglesIntersect(frame.triangleA(0), frame.triangleB(0)) ? PairIds{{0, 0}} : PairIds();
  }
  const bool few = areFew(frame.a, frame.b);
  if ((few || !areUnlike(frame)) && frame.rootBound(0) > 0) return PairIds();
  if (verticesApart(frame, 0)) return PairIds();
  if (few) return intersectingOfFew(frame, limit, counts);
  auto walked = touchUnprepared(frame, limit, counts);
  if (walked && (any || walked->size() < limit)) return walked;
  PairIds found;
  if (!searchContacts(frame, limit, found, counts)) return std::nullopt;
  return found;
}

KIOS_INSTANTIATE_FUNCTION(intersectingPairs);

}  // namespace kios
