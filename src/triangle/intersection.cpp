// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle.h"

#include <algorithm>

#include "triangle/pair_intersection.h"
#include "triangle/plain_intersection.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

[[gnu::hot]] bool boxesApart(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  for (int c = 0; c < 3; ++c) {
    const auto low = [c](const auto& t) { return std::min(std::min(t[0][c], t[1][c]), t[2][c]); };
    const auto high = [c](const auto& t) { return std::max(std::max(t[0][c], t[1][c]), t[2][c]); };
    if (high(a) < low(b) || high(b) < low(a)) return true;
  }
  return false;
}

}  // namespace

template <typename S>
[[gnu::hot]] bool trianglesIntersect(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const TriangleVerticesd& of_a = widened(a);
  const TriangleVerticesd& of_b = widened(b);
  if (boxesApart(of_a, of_b)) return false;
  const Plainly plain = plainlyMeet(of_a, of_b);
  if (plain != Plainly::kUnclear) return plain == Plainly::kMeet;
  return PairIntersection(coordinatesOf(of_a, of_b)).intersect();
}

template <typename S>
Point<S> intersectionPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const auto point = PairIntersection(coordinatesOf(widened(a), widened(b))).middle();
  return {roundedTo<S>(point[0]), roundedTo<S>(point[1]), roundedTo<S>(point[2])};
}

KIOS_INSTANTIATE_FUNCTION(trianglesIntersect);
KIOS_INSTANTIATE_FUNCTION(intersectionPoint);

}  // namespace kios
