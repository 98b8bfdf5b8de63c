// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <limits>

#include "solid/hull.h"
#include "solid/intersection.h"
#include "solid/nearest_point.h"
#include "solid/triangle_shape.h"

namespace kios::shape {
namespace {

/// Returns how far the triangle must move along the unit vector n to leave the solid.
double depthAlong(const Solid& s, const Triangle& t, const Vec& n) {
  return extentAlong(s, n) - std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
}

/// The direction of least depth so far.
struct Exit {
  const Solid& solid;
  const Triangle& triangle;
  Vec normal = Vec::UnitZ();
  double depth = std::numeric_limits<double>::infinity();

  bool offer(const Vec& direction) {
    const double length = direction.norm();
    if (!(length > 0 && length < std::numeric_limits<double>::infinity())) return false;
    const Vec n = direction / length;
    const double d = depthAlong(solid, triangle, n);
    if (!(d < depth)) return false;
    depth = d;
    normal = n;
    return true;
  }
  void offerBoth(const Vec& direction) {
    offer(direction);
    offer(-direction);
  }
};

/// Descent on the sphere of directions, by steps that halve: 2^-7 rad is the last.
void descend(Exit& exit) {
  double step = 0.25;
  for (int i = 0; i < 24 && step >= 0x1p-7; ++i) {
    const Vec n = exit.normal, u = n.unitOrthogonal(), v = n.cross(u);
    const bool better = exit.offer(n + step * u) || exit.offer(n - step * u) ||
                        exit.offer(n + step * v) || exit.offer(n - step * v);
    if (!better) step *= 0.5;
  }
}

TriangleShapeContact solidContact(const Solid& s, const Triangle& t) {
  Exit exit{s, t};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CoreDistance core = gjkDistance(s, t.data(), 3, kInfinity);
  if (s.margin() > 0) core = closedBracket(s, t, kInfinity, core);
  Vec position = core.point;
  if (s.margin() == 0 && !core.inside) meetsAt(s, t, core, &position);
  exit.offer(core.point - core.on_core);  // a capsule's segment and the triangle, if apart
  exit.offerBoth(faceNormal(t));
  if (s.kind == Kind::kConvex && s.num_faces > 0) {
    exit.offer(leastFaceExit(s, t));  // whose depth is that of all points, not of thin faces
    return {position, exit.normal, std::max(0.0, exit.depth)};
  }
  const Vec edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  for (int c = 0; c < 3; ++c) {
    const Vec axis = Vec::Unit(c);
    exit.offerBoth(axis);
    for (const Vec& edge : edges) exit.offerBoth(axis.cross(edge));
  }
  // These are all the directions that a box and a capsule need.
  if (s.kind != Kind::kBox && s.kind != Kind::kCapsule) {
    exit.offer(position);  // away from the solid's origin
    exit.offer({position.x(), position.y(), 0});
    descend(exit);
  }
  return {position, exit.normal, std::max(0.0, exit.depth)};
}

TriangleShapeContact planeContact(const Solid& s, const Triangle& t) {
  double height[3];
  for (int i = 0; i < 3; ++i) height[i] = s.normal.dot(t[i]) - s.offset;
  const auto low = std::min_element(height, height + 3),
             high = std::max_element(height, height + 3);
  if (s.kind == Kind::kHalfspace) {
    return {t[low - height] - 0.5 * *low * s.normal, s.normal, std::max(0.0, -*low)};
  }
  // FCL: the middle of the crossing segment, and the normal of the side that has more.
  Vec sum = Vec::Zero();
  int crossings = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (height[i] == 0) {
      sum += t[i];
      ++crossings;
    } else if ((height[i] < 0 && height[j] > 0) || (height[i] > 0 && height[j] < 0)) {
      const double way = height[i] / (height[i] - height[j]);
      sum += (1 - way) * t[i] + way * t[j];
      ++crossings;
    }
  }
  const Vec normal = *high > -*low ? s.normal : Vec(-s.normal);
  return {sum / std::max(1, crossings), normal, std::max(0.0, std::min(*high, -*low))};
}

}  // namespace

TriangleShapeContact contact(const Solid& s, const Triangle& t) {
  if (!s.bounded()) return planeContact(s, t);
  if (s.kind != Kind::kSphere) return solidContact(s, t);
  const Vec q = nearestToOrigin(t);
  const double length = q.norm();
  Vec normal = length > 0 ? Vec(q / length) : faceNormal(t);
  if (!(normal.squaredNorm() > 0)) normal = Vec::UnitZ();
  return {q, normal.normalized(), std::max(0.0, s.radius - length)};
}

}  // namespace kios::shape
