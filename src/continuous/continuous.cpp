// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/continuous/continuous.h"

#include "continuous/fcl_motion.h"
#include "continuous/moving_pair.h"

namespace kios {
namespace {

using continuous::Motion;
using fcl::CollisionGeometryd;

double firstContact(const CollisionGeometryd& a, const Motion& motion_a,
                    const CollisionGeometryd& b, const Motion& motion_b, double toc_err,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  const auto pair = continuous::movingPair(a, motion_a, b, motion_b, count);
  // As in collide(), a geometry that isn't occupied touches nothing.
  const bool occupied = a.isOccupied() && b.isOccupied();
  const continuous::FirstContact contact =
      occupied ? continuous::advance(*pair, toc_err, count) : continuous::FirstContact{false, 1};
  result.is_collide = contact.found;
  result.time_of_contact = contact.time;
  result.contact_tf1 = motion_a.pose(contact.time);
  result.contact_tf2 = motion_b.pose(contact.time);
  return contact.time;
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
