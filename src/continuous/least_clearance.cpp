// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/motion.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "continuous/step_search.h"
#include "continuous/threshold_search.h"
#include "continuous/tuning.h"
#include "model/kios_model.h"
#include "shape/solid.h"
#include "solid/mesh_and_other.h"

namespace kios {
namespace {

using continuous::Motion;
using continuous::Sight;
using fcl::CollisionGeometryd;

/// Two objects, one of them a mesh, on motions of their own.
class MovingTwo final : public continuous::MovingBodies {
 public:
  MovingTwo(const CollisionGeometryd& a, const Motion& motion_a, const CollisionGeometryd& b,
            const Motion& motion_b, const RangeRequest& request)
      : a_(a), b_(b), motion_a_(motion_a), motion_b_(motion_b), request_(request) {
    continuous::movingPair(a, motion_a, b, motion_b, counts_);  // refuses what isn't served
    for (const CollisionGeometryd* g : {&a, &b}) {
      if (const Modeld* const mesh = asModel(g)) reach_ += continuous::reachOf(*mesh);
      if (isShape(*g)) shape_ = toSolid(*g);
    }
  }

  Sight look(double s, double far, double rel_err) override {
    ++queries;
    const fcl::Transform3d X_WA = motion_a_.pose(s), X_WB = motion_b_.pose(s);
    const MeshAndOther<double> pair = meshAndOther(a_, X_WA, b_, X_WB);
    fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    request.enable_nearest_points = true;
    request.rel_err = rel_err;
    result.min_distance = std::min(far, result.min_distance);
    Sight sight;
    const double distance = pair.distanceSurfaces(request, result), error = rounding(s, distance);
    const bool may_touch = !(distance > error) || areSolids(pair.mesh, pair.other, pair.other_mesh);
    if (!(distance > 0) || (may_touch && pair.touch())) {
      sight.distance = 0;
    } else if (distance < far) {
      sight.distance = distance + error;
      const int first = result.o1 == &a_ ? 0 : 1;
      sight.point_a = result.nearest_points[first];
      sight.point_b = result.nearest_points[1 - first];
    }
    return sight;
  }

  // Conservative advancement, as in firstContact(), of bodies that are wider by the separation.
  Proof prove(double separation, double& place) override {
    const Motion wide = motion_a_.widened(separation * (1 + 0x1p-50));
    const auto pair = continuous::movingPair(a_, wide, b_, motion_b_, counts_);
    if (motion_a_.still() && motion_b_.still()) {
      place = 0;
      const double far = (separation + rounding(0, separation)) * (1 + 0x1p-40) + 0x1p-500;
      return look(0, far, 0).distance < kInfinity ? Proof::kRefuted : Proof::kClear;
    }
    // Those of two whole bodies take as long as a hundred tests of moving volumes, and longer.
    constexpr long long kOfQuery =
        continuous::tuning::kTestsOfQuery * continuous::tuning::kTestsOfMoving;
    for (double t = 0; t < 1;) {
      pair->setLimits(1, kOfQuery * std::max(1LL, request_.max_queries - queries));
      const long long before = pair->cost();
      const double h = pair->apartFor(t);
      queries += 1 + (pair->cost() - before) / kOfQuery;
      place = t;
      if (h >= 1 - t) break;
      if (queries >= request_.max_queries) return Proof::kSpent;
      if (!(h >= 0x1p-30)) return Proof::kRefuted;
      t = t + h - 0x1p-52;
    }
    return Proof::kClear;
  }

 private:
  /// Motions and a distance round by no more. A mesh lies within its reach of its origin, and what
  /// is so near to it within the length, seen from both origins and the world's.
  double rounding(double s, double distance) const {
    const double length = 2 * (motion_a_.pose(s).translation().lpNorm<1>() +
                               motion_b_.pose(s).translation().lpNorm<1>() + reach_) +
                          distance;
    return motion_a_.rounding(length) + motion_b_.rounding(length) +
           kernelError(shape_ ? &*shape_ : nullptr, length);
  }

  const CollisionGeometryd &a_, &b_;
  const Motion motion_a_, motion_b_;
  const RangeRequest& request_;
  double reach_ = 0;  ///< the sum of the meshes'
  std::optional<shape::Solid> shape_;
  ContinuousCounts counts_;
};

}  // namespace

RangeResult leastClearance(const CollisionGeometryd& a, const fcl::MotionBased* motion_a,
                           const CollisionGeometryd& b, const fcl::MotionBased* motion_b,
                           const RangeRequest& request) {
  const continuous::Seen nothing(request);
  MovingTwo bodies(a, continuous::motionOf(motion_a), b, continuous::motionOf(motion_b), request);
  if (a.isOccupied() && b.isOccupied()) return continuous::searchThresholds(bodies, request);
  return nothing.result(nothing.ceiling(), 0);
}

}  // namespace kios
