// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/link_tree.h"

#include <algorithm>

#include <fcl/narrowphase/collision.h>
#include "fcl_kios/fcl_own.h"
#include "shape/simplex.h"
#include "volume/rounding.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;
using fcl::Transform3d;

/// The largest n . x over a bounded shape in the world.
double supportIn(const BodyData& body, const Transform3d& X, const Vector3d& n) {
  return n.dot(X.translation()) + shape::extentAlong(body.solid, X.linear().transpose() * n);
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
  const Vector3d n = X_WP.linear() * plane.solid.normal;
  const double offset = n.dot(X_WP.translation()) + plane.solid.offset;
  const double above = -supportIn(b, X_WB, -n) - offset;
  if (plane.solid.kind == shape::Kind::kHalfspace) return above;
  return std::max(above, offset - supportIn(b, X_WB, n));
}

/// From the core of a bounded shape to that of another, by GJK; zero if they overlap. The nearest
/// points of cores are known well however small the gap of round shapes is.
Vector3d betweenCores(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                      const Transform3d& X_WB) {
  constexpr int kMostSteps = 128;
  const auto support = [](const BodyData& body, const Transform3d& X, const Vector3d& n) {
    return Vector3d(X.linear() * shape::coreSupport(body.solid, X.linear().transpose() * n));
  };
  const Vector3d way = X_WB.translation() - X_WA.translation();
  shape::Simplex s;
  const auto add = [&](const Vector3d& v) {
    s.add(support(a, X_WA, -v), way + support(b, X_WB, v));
    return s.on_a[s.size - 1].lpNorm<1>() + s.on_b[s.size - 1].lpNorm<1>();
  };
  add(-way);
  if (!(shape::descend(s, add, kInfinity, kMostSteps).squared > 0)) return Vector3d::Zero();
  Vector3d between = Vector3d::Zero();
  for (int i = 0; i < s.size; ++i) between -= s.weight[i] * s.y[i];
  return between;
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
  attempt(betweenCores(a, X_WA, b, X_WB));
  for (const auto* X : {&X_WA, &X_WB}) {
    for (int i = 0; i < 3; ++i) {
      attempt(X->linear().col(i));
      attempt(-X->linear().col(i));
    }
  }
  return gap;
}

bool shapesMeet(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                const Transform3d& X_WB, double within) {
  // Where one is so much larger than the other, libccd's search for a contact has no end.
  constexpr double kMuch = 0x1p26;
  const double size_a = a.content.radius, size_b = b.content.radius;
  const bool unlike = size_a > kMuch * size_b || size_b > kMuch * size_a;
  if (!a.bounded || !b.bounded || unlike) return shapeGap(a, X_WA, b, X_WB) <= within;
  fcl::CollisionResultd contacts;
  if (fcl_own::collide(a.geometry.get(), X_WA, b.geometry.get(), X_WB, fcl::CollisionRequestd(),
                       contacts) > 0) {
    return true;
  }
  const double margins = a.solid.margin() + b.solid.margin();
  return within > 0 && betweenCores(a, X_WA, b, X_WB).norm() <= within + margins;
}

}  // namespace kios::articulated
