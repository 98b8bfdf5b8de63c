// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "shape/convex_faces.h"
#include "shape/hull.h"
#include "shape/meets.h"
#include "shape/nearest_point.h"
#include "shape/polygon.h"
#include "shape/triangle_shape.h"
#include "volume/rounding.h"

namespace kios::shape {
namespace {

/// The direction of least depth so far: how far the triangle must move along it to leave the solid.
class Exit {
 public:
  Exit(const Solid& solid, const Triangle& triangle)
      : solid_(solid),
        t_(triangle),
        symmetric_(solid.kind != Kind::kCone && solid.kind != Kind::kConvex),
        margin_(solid.margin()) {}

  const Vec& normal() const { return normal_; }
  double depth() const { return depth_; }

  /// Takes a direction of length 1.
  bool offerUnit(const Vec& n) { return offerSlab(n, extent(n)); }
  bool offerSlab(const Vec& n, double extent) {
    const double depth = extent - std::min({n.dot(t_[0]), n.dot(t_[1]), n.dot(t_[2])});
    if (!(depth < depth_)) return false;
    depth_ = depth;
    normal_ = n;
    return true;
  }
  void offer(const Vec& direction) {
    const double length = direction.norm();
    if (isLength(length)) offerUnit(direction / length);
  }
  /// The direction and its opposite. Only those that are better are made unit.
  void offerBoth(const Vec& n) {
    const double length = n.norm();
    if (!isLength(length)) return;
    const double a = n.dot(t_[0]), b = n.dot(t_[1]), c = n.dot(t_[2]);
    const double along = extent(n) + (length - 1) * margin_;
    const double against = symmetric_ ? along : extent(-n) + (length - 1) * margin_;
    take(n, along - std::min({a, b, c}), length);
    take(-n, against + std::max({a, b, c}), length);
  }

 private:
  static bool isLength(double length) { return length > 0 && length < kInfinity; }
  void take(const Vec& n, double depth, double length) {
    if (!(depth < depth_ * length)) return;
    depth_ = depth / length;
    normal_ = n / length;
  }
  double extent(const Vec& n) const { return extentAlong(solid_, n); }

  const Solid& solid_;
  const Triangle& t_;
  const bool symmetric_;
  const double margin_;
  Vec normal_ = Vec::UnitZ();
  double depth_ = kInfinity;
};

/// Descent on the sphere of directions, by steps that shrink: 2^-7 rad is the last.
void descend(Exit& exit) {
  double step = 0.25;
  for (int i = 0; i < 24 && step >= 0x1p-7; ++i) {
    const Vec n = exit.normal(), u = n.unitOrthogonal(), v = n.cross(u);
    const double to_unit = 1 / std::sqrt(1 + step * step);
    const Vec along = to_unit * n, su = (to_unit * step) * u, sv = (to_unit * step) * v;
    const bool better = exit.offerUnit(along + su) || exit.offerUnit(along - su) ||
                        exit.offerUnit(along + sv) || exit.offerUnit(along - sv);
    if (!better) step *= 0.5;
  }
}

/// A point of both; for a capsule the pair of nearest points of its segment and the triangle; for a
/// box the middle of what its slabs leave of the triangle, unless rounding leaves nothing.
CoreDistance commonCore(const Solid& s, const Triangle& t, const ConvexFaces* faces) {
  CoreDistance core = {};
  if (s.kind == Kind::kConvex) {
    for (int i = 0; faces && i < 3; ++i) {
      if (!faces->contains(t[i])) continue;
      core.point = core.on_core = t[i];
      return core;
    }
  } else if (s.kind == Kind::kCapsule) {
    if (distanceByCertificate(s, t, kInfinity, core)) return core;
  } else if (s.kind == Kind::kBox) {
    const Polygon polygon(t, s.half);
    if (polygon.size > 0) {
      core.point = core.on_core = polygon.middle();
      return core;
    }
  } else if (meets(s, t, &core.point)) {
    core.on_core = core.point;
    return core;
  }
  core = gjkDistance(s, t.data(), 3, kInfinity);
  if (s.margin() > 0) return closedBracket(s, t, kInfinity, core);
  if (!core.inside) meetsAt(s, t, core, &core.point);
  return core;
}

TriangleShapeContact solidContact(const Solid& s, const Triangle& t, const ConvexFaces* faces) {
  Exit exit(s, t);
  std::optional<ConvexFaces> own;
  if (!faces && s.kind == Kind::kConvex) faces = &own.emplace(s);
  const CoreDistance core = commonCore(s, t, faces);
  const Vec& position = core.point;
  exit.offer(core.point - core.on_core);  // a capsule's segment and the triangle, if apart
  exit.offerBoth(faceNormal(t));
  if (faces && faces->known()) {  // the depth is that of all points, not of thin faces
    const ConvexFaces::Slab slab = faces->leastExit(t);
    exit.offerSlab(slab.normal, slab.offset);
    return {position, exit.normal(), std::max(0.0, exit.depth())};
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
  return {position, exit.normal(), std::max(0.0, exit.depth())};
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

TriangleShapeContact contact(const Solid& s, const Triangle& t, const ConvexFaces* faces) {
  if (!s.bounded()) return planeContact(s, t);
  if (s.kind != Kind::kSphere) return solidContact(s, t, faces);
  const Vec q = nearestToOrigin(t);
  const double length = q.norm();
  Vec normal = length > 0 ? Vec(q / length) : faceNormal(t);
  if (!(normal.squaredNorm() > 0)) normal = Vec::UnitZ();
  return {q, normal.normalized(), std::max(0.0, s.radius - length)};
}

}  // namespace kios::shape
