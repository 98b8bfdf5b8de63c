// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/gjk.h"

namespace kios::shape {
namespace {

constexpr double kTiny = std::numeric_limits<double>::min();

Vec pointOf(const Triangle& t, const double weights[3]) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

double sizeOf(const Triangle& t) {
  return std::max({t[0].lpNorm<1>(), t[1].lpNorm<1>(), t[2].lpNorm<1>()});
}

TriangleShapeDistance sphereDistance(const Solid& s, const Triangle& t) {
  double weights[3];
  nearestToOrigin(t, weights);
  TriangleShapeDistance answer;
  answer.on_triangle = pointOf(t, weights);
  const double length = answer.on_triangle.norm();
  if (length <= s.radius) {
    answer.distance = answer.lower = 0;
    answer.on_shape = answer.on_triangle;
    return answer;
  }
  const Vec n = answer.on_triangle / length;
  answer.distance = length - s.radius;
  answer.lower = std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])}) - s.radius;
  answer.on_shape = s.radius * n;
  return answer;
}

/// Half-space and plane: the lowest corner, or for a plane that is crossed a point of the crossing.
TriangleShapeDistance planeDistance(const Solid& s, const Triangle& t) {
  double height[3];
  for (int i = 0; i < 3; ++i) height[i] = s.normal.dot(t[i]) - s.offset;
  const auto low = std::min_element(height, height + 3),
             high = std::max_element(height, height + 3);
  TriangleShapeDistance answer;
  if (s.kind == Kind::kPlane && *low <= 0 && *high >= 0) {
    const double way = *high > *low ? -*low / (*high - *low) : 0.0;
    answer.on_triangle = (1 - way) * t[low - height] + way * t[high - height];
    answer.distance = answer.lower = 0;
  } else {
    const bool below = s.kind == Kind::kPlane && *high < 0;
    answer.on_triangle = t[below ? high - height : low - height];
    answer.distance = answer.lower = below ? -*high : std::max(0.0, *low);
    answer.on_shape = answer.on_triangle - (below ? *high : answer.distance) * s.normal;
  }
  if (answer.distance == 0) answer.on_shape = answer.on_triangle;
  return answer;
}

}  // namespace

TriangleShapeDistance distance(const Solid& s, const Triangle& t, double enough) {
  if (s.kind == Kind::kSphere) return sphereDistance(s, t);
  if (!s.bounded()) return planeDistance(s, t);
  const double margin = s.margin();
  const CoreDistance core = gjkDistance(s, t.data(), 3, enough + margin);
  TriangleShapeDistance answer;
  answer.lower = core.lower - margin;
  answer.distance = core.upper - margin;
  answer.on_triangle = core.point;
  // GJK decides only where it is clear; what is close is for the direct tests.
  const double size = sizeOf(t) + core.on_core.lpNorm<1>() + margin;
  const bool apart = answer.lower > 0x1p-40 * size;
  if (!apart && (margin > 0 || s.kind == Kind::kConvex ? answer.distance <= 0x1p-50 * size
                                                       : intersects(s, t))) {
    answer.distance = answer.lower = 0;
    answer.on_shape = answer.on_triangle;
    return answer;
  }
  answer.distance = std::max(answer.distance, kTiny);
  answer.on_shape = core.on_core;
  if (margin > 0) answer.on_shape += margin / core.upper * (core.point - core.on_core);
  return answer;
}

}  // namespace kios::shape
