// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle/intersection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "triangle/common_point.h"
#include "triangle/pair_intersection.h"
#include "triangle/plain_intersection.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
[[gnu::hot]] bool boxesApart(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
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
  if (boxesApart(a, b)) return false;
  const Plainly plain = plainlyMeet(a, planeOf(a), b, planeOf(b));
  if (plain != Plainly::kUnclear) return plain == Plainly::kMeet;
  return exactlyIntersect(a, b);
}

template <typename S>
bool exactlyIntersect(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  return PairIntersection(coordinatesOf(a, b)).common(nullptr);
}

bool commonPoint(const TriangleVertices<double>& a, const TriangleVertices<double>& b,
                 Point<double>& point) {
  if (boxesApart(a, b)) return false;
  std::array<double, 3> found;
  if (!PairIntersection(coordinatesOf(a, b)).common(&found)) return false;
  point = {found[0], found[1], found[2]};
  return true;
}

template <typename S>
Point<S> intersectionPoint(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const auto point = PairIntersection(coordinatesOf(a, b)).middle();
  return {roundedTo<S>(point[0]), roundedTo<S>(point[1]), roundedTo<S>(point[2])};
}

KIOS_INSTANTIATE_FUNCTION(trianglesIntersect);
KIOS_INSTANTIATE_FUNCTION(exactlyIntersect);
KIOS_INSTANTIATE_FUNCTION(intersectionPoint);

}  // namespace kios
