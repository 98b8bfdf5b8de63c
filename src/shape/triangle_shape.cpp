// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/hull.h"
#include "shape/meets.h"
#include "shape/nearest_point.h"

namespace kios::shape {
namespace {

constexpr double kTiny = std::numeric_limits<double>::min();

TriangleShapeDistance sphereDistance(const Solid& s, const Triangle& t) {
  TriangleShapeDistance answer;
  answer.on_triangle = nearestToOrigin(t);
  const double length = answer.on_triangle.norm();
  if (length <= s.radius) {
    answer.distance = answer.lower = 0;
    answer.on_shape = answer.on_triangle;
    return answer;
  }
  const Vec n = answer.on_triangle / length;
  answer.distance = length - s.radius;
  answer.lower = answer.distance;
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

bool isCurved(const Solid& s) {
  return s.kind == Kind::kCylinder || s.kind == Kind::kCone || s.kind == Kind::kEllipsoid;
}

}  // namespace

TriangleShapeDistance distance(const Solid& s, const Triangle& t, double required) {
  if (s.kind == Kind::kSphere) return sphereDistance(s, t);
  if (!s.bounded()) return planeDistance(s, t);
  const double margin = s.margin();
  const double beyond = margin + std::max(required, 0x1p-40 * sizeOf(t));
  CoreDistance core = {};
  TriangleShapeDistance answer;
  if (s.kind == Kind::kConvex || !distanceByCertificate(s, t, beyond, core)) {
    const bool direct = margin == 0 && s.kind != Kind::kConvex;
    bool touching = direct && meets(s, t, &answer.on_triangle);
    if (!touching && isCurved(s)) {
      core = nearestFeature(s, t);
    } else if (!touching) {
      core = gjkDistance(s, t.data(), 3, beyond);
      touching = s.kind == Kind::kConvex && core.lower <= clearOf(t, core) &&
                 meetsAt(s, t, core, &answer.on_triangle);
    }
    if (touching) {
      answer.distance = answer.lower = 0;
      answer.on_shape = answer.on_triangle;
      return answer;
    }
    if (!(core.upper <= margin)) core = closedBracket(s, t, beyond, core);
  }
  answer.lower = core.lower - margin;
  answer.distance = core.upper - margin;
  answer.on_triangle = core.point;
  answer.on_shape = core.on_core;
  if (margin > 0 && answer.distance <= 0) {
    answer.distance = answer.lower = 0;
    answer.on_shape = answer.on_triangle;
    return answer;
  }
  if (margin > 0) answer.on_shape += margin / core.upper * (core.point - core.on_core);
  answer.distance = std::max(answer.distance, kTiny);
  return answer;
}

}  // namespace kios::shape
