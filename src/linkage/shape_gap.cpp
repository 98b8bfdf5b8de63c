// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/link_tree.h"

#include <algorithm>

#include <fcl/narrowphase/collision.h>
#include "fcl_kios/detail/fcl_own.h"
#include "shape/simplex.h"
#include "volume/rounding.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;
using fcl::Transform3d;

/// The largest n . x over a bounded shape in the world.
double supportIn(const BodyData& body, const Transform3d& X, const Vector3d& n) {
  return n.dot(X.translation()) + shape::extentAlong(body.own->solid, X.linear().transpose() * n);
}

/// The gap along n, of any length near 1, from a to b.
double slab(const BodyData& a, const Transform3d& X_WA, const BodyData& b, const Transform3d& X_WB,
            const Vector3d& n) {
  const double length = n.norm();
  if (!(length > 0)) return -kInfinity;
  const Vector3d unit = n / length;
  return -supportIn(b, X_WB, -unit) - supportIn(a, X_WA, unit);
}

/// From a half-space or plane to a bounded shape: along its normal, or for a plane against it.
double gapFromPlane(const BodyData& plane, const Transform3d& X_WP, const BodyData& b,
                    const Transform3d& X_WB) {
  const Vector3d n = X_WP.linear() * plane.own->solid.normal;
  const double offset = n.dot(X_WP.translation()) + plane.own->solid.offset;
  const double above = -supportIn(b, X_WB, -n) - offset;
  if (plane.own->solid.kind == shape::Kind::kHalfspace) return above;
  return std::max(above, offset - supportIn(b, X_WB, n));
}

Vector3d coreSupportIn(const BodyData& body, const Transform3d& X, const Vector3d& n) {
  return X.linear() * shape::coreSupport(body.own->solid, X.linear().transpose() * n);
}

/// The nearest points of the cores of two bounded shapes, by GJK; one point if they overlap. Those
/// of cores are known well however small the gap of round shapes is.
struct CorePoints {
  Vector3d a, b;
  Vector3d between() const { return b - a; }
};
CorePoints nearestOfCores(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                          const Transform3d& X_WB) {
  constexpr int kMostSteps = 128;
  const Vector3d way = X_WB.translation() - X_WA.translation();
  shape::Simplex s;
  const auto add = [&](const Vector3d& v) {
    s.add(coreSupportIn(a, X_WA, -v), way + coreSupportIn(b, X_WB, v));
    return s.on_a[s.size - 1].lpNorm<1>() + s.on_b[s.size - 1].lpNorm<1>();
  };
  add(-way);
  const bool apart = shape::descend(s, add, kInfinity, kMostSteps).squared > 0;
  CorePoints points = {X_WA.translation(), X_WA.translation()};
  for (int i = 0; i < s.size; ++i) {
    points.a += s.weight[i] * s.on_a[i];
    points.b += s.weight[i] * s.on_b[i];
  }
  if (!apart) points.b = points.a;
  return points;
}

}  // namespace

double shapeGap(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                const Transform3d& X_WB, Vector3d* direction) {
  if (!a.bounded) return gapFromPlane(a, X_WA, b, X_WB);
  if (!b.bounded) return gapFromPlane(b, X_WB, a, X_WA);
  double gap = -kInfinity;
  const auto attempt = [&](const Vector3d& n) {
    const double along = slab(a, X_WA, b, X_WB, n);
    if (!(along > gap)) return;
    gap = along;
    if (direction) *direction = n.normalized();
  };
  attempt(X_WB.translation() - X_WA.translation());
  attempt(nearestOfCores(a, X_WA, b, X_WB).between());
  for (const auto* X : {&X_WA, &X_WB}) {
    for (int i = 0; i < 3; ++i) {
      attempt(X->linear().col(i));
      attempt(-X->linear().col(i));
    }
  }
  return gap;
}

void nearPoints(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                const Transform3d& X_WB, Vector3d& on_a, Vector3d& on_b) {
  if (!a.bounded) return nearPoints(b, X_WB, a, X_WA, on_b, on_a);
  if (!b.bounded) {
    const Vector3d n = X_WB.linear() * b.own->solid.normal;
    const double offset = n.dot(X_WB.translation()) + b.own->solid.offset;
    const auto extreme = [&](const Vector3d& way) {
      return Vector3d(X_WA.translation() + coreSupportIn(a, X_WA, way) +
                      a.own->solid.margin() * way);
    };
    const Vector3d low = extreme(-n), high = extreme(n);
    const bool above =
        b.own->solid.kind == shape::Kind::kHalfspace || n.dot(low) - offset > offset - n.dot(high);
    on_a = above ? low : high;
    on_b = on_a + (offset - n.dot(on_a)) * n;
    return;
  }
  const CorePoints cores = nearestOfCores(a, X_WA, b, X_WB);
  const double length = cores.between().norm();
  const Vector3d n = length > 0 ? Vector3d(cores.between() / length) : Vector3d::Zero();
  on_a = cores.a + a.own->solid.margin() * n;
  on_b = cores.b - b.own->solid.margin() * n;
  if (length <= a.own->solid.margin() + b.own->solid.margin()) on_b = on_a;
}

bool shapesMeet(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                const Transform3d& X_WB, double within) {
  // Where one is so much larger than the other, libccd's search for a contact has no end.
  constexpr double kMuch = 0x1p26;
  const double size_a = a.content.radius, size_b = b.content.radius;
  const bool unlike = size_a > kMuch * size_b || size_b > kMuch * size_a;
  if (!a.bounded || !b.bounded || unlike) return shapeGap(a, X_WA, b, X_WB) <= within;
  fcl::CollisionResultd contacts;
  if (fcl_own::collide(a.own->geometry.get(), X_WA, b.own->geometry.get(), X_WB,
                       fcl::CollisionRequestd(), contacts) > 0) {
    return true;
  }
  const double margins = a.own->solid.margin() + b.own->solid.margin();
  return within > 0 && nearestOfCores(a, X_WA, b, X_WB).between().norm() <= within + margins;
}

}  // namespace kios::articulated
