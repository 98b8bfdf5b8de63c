// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/gjk.h"
#include "shape/hull.h"
#include "shape/nearest_point.h"

namespace kios::shape {
namespace {

constexpr double kTiny = std::numeric_limits<double>::min();

Vec pointOf(const Triangle& t, const double weights[3]) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
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

/// Where GJK left a gap: the same by features, if that is nearer.
void refine(const Solid& s, const Triangle& t, TriangleShapeDistance& answer) {
  const bool curved =
      s.kind == Kind::kCylinder || s.kind == Kind::kCone || s.kind == Kind::kEllipsoid;
  TriangleShapeDistance exact;
  if (curved) {
    exact = distanceByFeatures(s, t);
  } else if (s.kind == Kind::kConvex && s.num_faces > 0) {
    exact = distanceToHull(s, t);
  } else {
    return;
  }
  if (exact.distance <= answer.distance) answer = exact;
}

}  // namespace

TriangleShapeDistance distance(const Solid& s, const Triangle& t, double enough) {
  if (s.kind == Kind::kSphere) return sphereDistance(s, t);
  if (!s.bounded()) return planeDistance(s, t);
  const double margin = s.margin(), clear = 0x1p-40 * sizeOf(t);
  const CoreDistance core = gjkDistance(s, t.data(), 3, margin + std::max(enough, clear));
  TriangleShapeDistance answer;
  answer.lower = core.lower - margin;
  answer.distance = core.upper - margin;
  answer.on_triangle = core.point;
  answer.on_shape = core.on_core;
  if (margin > 0 ? answer.distance <= 0 : answer.lower <= clear && intersects(s, t)) {
    answer.distance = answer.lower = 0;
    answer.on_shape = answer.on_triangle;
    return answer;
  }
  if (margin > 0) {
    answer.on_shape += margin / core.upper * (core.point - core.on_core);
  } else if (answer.lower <= enough && answer.distance - answer.lower > 0x1p-44 * sizeOf(t)) {
    refine(s, t, answer);
  }
  answer.distance = std::max(answer.distance, kTiny);
  return answer;
}

}  // namespace kios::shape
