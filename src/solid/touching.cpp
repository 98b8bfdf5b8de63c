// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/touching.h"

#include <vector>

#include "query/pair_search.h"
#include "triangle/predicates.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Returns the side of a plane on which a mesh lies: +1 or -1, touching or not, 0 if on both.
template <typename S, typename Corners>
int sideOf(const TriangleVertices<S>& plane, int num_triangles, const Corners& corners_of) {
  int side = 0;
  for (int t = 0; t < num_triangles; ++t) {
    const PairPredicates::Coordinates points = coordinatesOf(plane, corners_of(t));
    const PairPredicates exact(points);
    for (int i = 3; i < 6; ++i) {
      const int sign = exact.orient3d(0, 1, 2, i);
      if (sign == 0) continue;
      if (side == -sign) return 0;
      side = sign;
    }
  }
  return side;
}

}  // namespace

template <typename S>
bool partedByFace(SolidPair<S>& pair, double length) {
  constexpr double kRoundings = 1 << 12;
  if (!(length <= kRoundings * pair.rounding())) return false;
  const MeshPair<S>& frame = pair.frame();
  std::vector<engine::TrianglePairIds> found;
  constexpr std::size_t kContacts = 16;
  if (!searchContacts(frame, kContacts, found, pair.counts())) return false;
  const auto of_a = [&](int t) { return frame.triangleA(t); };
  const auto of_b = [&](int t) { return frame.triangleB(t); };
  for (const auto& ids : found) {
    for (const TriangleVertices<S>& plane : {of_a(ids.a), of_b(ids.b)}) {
      const int side = sideOf(plane, frame.a.num_tris, of_a);
      if (side != 0 && sideOf(plane, frame.b.num_tris, of_b) == -side) return true;
    }
  }
  return false;
}

KIOS_INSTANTIATE_FUNCTION(partedByFace);

}  // namespace kios
