// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/link_tree.h"

#include <algorithm>
#include <exception>

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include "fcl_kios/fcl_own.h"
#include "shape/gjk.h"
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

/// From a ball or capsule `a` to another bounded shape, of any length. The nearest point of b to
/// a's centre or axis is known well however small the gap is, unlike one to the surface.
Vector3d fromCore(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                  const Transform3d& X_WB) {
  const double half = a.solid.half_length;  // 0 for a ball
  const Vector3d ends[2] = {{0, 0, -half}, {0, 0, half}};
  Vector3d core[2];
  const int count = half > 0 ? 2 : 1;
  for (int i = 0; i < count; ++i) {
    core[i] = X_WB.linear().transpose() * (X_WA * ends[i] - X_WB.translation());
  }
  const shape::CoreDistance nearest = shape::gjkDistance(b.solid, core, count, kInfinity);
  return X_WB.linear() * (nearest.on_core - nearest.point);
}

/// FCL's nearest points, or none where its solver gives up. Of its two solvers the one that rests
/// on libccd aborts the process by an assertion for some shapes that touch.
bool nearestPoints(const BodyData& a, const Transform3d& X_WA, const BodyData& b,
                   const Transform3d& X_WB, fcl::DistanceResultd& result) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = fcl::GST_INDEP;
  try {
    return fcl_own::distance(a.geometry.get(), X_WA, b.geometry.get(), X_WB, request, result) > 0;
  } catch (const std::exception&) {
    return false;
  }
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
  const auto isRound = [](const BodyData& body) { return body.solid.margin() > 0; };
  fcl::DistanceResultd result;
  if (isRound(a)) {
    attempt(fromCore(a, X_WA, b, X_WB));
  } else if (isRound(b)) {
    attempt(-fromCore(b, X_WB, a, X_WA));
  } else if (nearestPoints(a, X_WA, b, X_WB, result)) {
    attempt(result.nearest_points[1] - result.nearest_points[0]);
  }
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
  if (!(within > 0)) return false;
  fcl::DistanceResultd result;
  return nearestPoints(a, X_WA, b, X_WB, result) && result.min_distance <= within;
}

}  // namespace kios::articulated
