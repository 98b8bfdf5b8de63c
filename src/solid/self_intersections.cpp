// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/repair.h"

#include <algorithm>
#include <utility>

#include "model/prepared.h"
#include "query/pair_search.h"
#include "volume/instantiate.h"

namespace kios {

template <typename S>
std::vector<SelfIntersection> selfIntersections(const Model<S>& model, std::size_t limit) {
  const Mesh mesh = meshOf(model);
  const fcl::Transform3d X = fcl::Transform3d::Identity();
  const MeshPair itself(mesh, X, mesh, X);
  SearchCounts unused;
  std::vector<SelfIntersection> found;
  visitTouching(
      itself,
      [&](const engine::TrianglePairIds& ids) {  // each pair in both orders
        if (ids.a >= ids.b) return false;
        const Meeting meeting = meetingOf(itself.triangleA(ids.a), itself.triangleA(ids.b));
        if (meeting != Meeting::kNone) found.push_back({ids.a, ids.b, meeting});
        return false;
      },
      unused);
  const auto byIds = [](const SelfIntersection& p, const SelfIntersection& q) {
    return std::pair(p.triangle_a, p.triangle_b) < std::pair(q.triangle_a, q.triangle_b);
  };
  std::sort(found.begin(), found.end(), byIds);
  if (found.size() > limit) found.resize(limit);
  return found;
}

KIOS_INSTANTIATE_FUNCTION(selfIntersections);

}  // namespace kios
