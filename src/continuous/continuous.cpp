// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "continuous/motion.h"
#include "continuous/step_search.h"
#include "solid/mesh_and_other.h"
#include "volume/errors.h"

namespace kios {
namespace {

using continuous::Motion;
using fcl::CollisionGeometryd;

/// Returns a time at most that of every contact; none if there is no contact. Conservative
/// advancement: proves one interval after the other free, until the end or until a contact at most
/// toc_err later is known, by touch(t). Where the provable intervals shrink below toc_err / 2^20
/// and no contact is known, it gives up and reports one. Throws std::invalid_argument if toc_err is
/// NaN or negative. Source: Mirtich, "Timewarp rigid body simulation" (2000); Zhang, Redon, Lee &
/// Kim, "Continuous collision detection for articulated models using Taylor models and temporal
/// culling" (2007).
template <typename Touch>
std::optional<double> advance(continuous::StepSearch& pair, const Touch& touch, double toc_err,
                              ContinuousCounts& counts) {
  require(toc_err >= 0, "ContinuousCollisionRequest::toc_err", toc_err, ">= 0");
  constexpr long long kMostSteps = 20000, kMostTests = 1 << 21;  // of short steps
  constexpr double kSmall = 0.25, kShort = 0x1p-13;              // there are few longer steps
  const double tolerance = std::clamp(toc_err, 0x1p-48, 1.0);
  const double least = std::max(0x1p-20 * tolerance, 0x1p-52);

  if (touch(0)) return 0;
  double t = 0, look_from = 0;
  const auto tests = [&] { return counts.volume_tests + counts.leaf_tests; };
  long long short_steps = 0, short_tests = 0;
  while (true) {
    const long long before = tests();
    const double h = pair.apartFor(t);
    ++counts.steps;
    if (h >= 1 - t) return std::nullopt;
    // Small steps: a contact is near, or the two pass each other closely.
    if (h < kSmall * tolerance && t >= look_from) {
      if (touch(std::min(1.0, t + tolerance))) return t;
      look_from = t + 0.5 * tolerance;
    }
    if (h < kShort) {
      ++short_steps;
      short_tests += tests() - before;
    }
    if (h < least || short_steps > kMostSteps || short_tests > kMostTests) return t;
    double next = t + h;
    if (next - t > h) next = std::nextafter(next, 0.0);
    t = next;
  }
}

double firstContact(const CollisionGeometryd& a, const Motion& motion_a,
                    const CollisionGeometryd& b, const Motion& motion_b, double toc_err,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  const auto pair = continuous::movingPair(a, motion_a, b, motion_b, count);
  // As in collide(), a geometry that isn't occupied touches nothing.
  const bool occupied = a.isOccupied() && b.isOccupied();
  const auto touch = [&](double t) {
    ++count.collision_tests;
    const fcl::Transform3d X_WA = motion_a.pose(t), X_WB = motion_b.pose(t);
    return meshAndOther(a, X_WA, b, X_WB).touch();
  };
  const auto contact = occupied ? advance(*pair, touch, toc_err, count) : std::nullopt;
  const double time = contact.value_or(1);
  result.is_collide = contact.has_value();
  result.time_of_contact = time;
  result.contact_tf1 = motion_a.pose(time);
  result.contact_tf2 = motion_b.pose(time);
  return time;
}

}  // namespace

double firstContact(const CollisionGeometryd& a, const fcl::MotionBased* motion_a,
                    const CollisionGeometryd& b, const fcl::MotionBased* motion_b,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  return firstContact(a, continuous::motionOf(motion_a), b, continuous::motionOf(motion_b),
                      request.toc_err, result, counts);
}

double firstContact(const CollisionGeometryd& a, const fcl::Transform3d& X_WA_begin,
                    const fcl::Transform3d& X_WA_end, const CollisionGeometryd& b,
                    const fcl::Transform3d& X_WB_begin, const fcl::Transform3d& X_WB_end,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  const auto between = [&](const fcl::Transform3d& X_0, const fcl::Transform3d& X_1) {
    return continuous::motionBetween(X_0, X_1, request.ccd_motion_type);
  };
  return firstContact(a, between(X_WA_begin, X_WA_end), b, between(X_WB_begin, X_WB_end),
                      request.toc_err, result, counts);
}

}  // namespace kios
