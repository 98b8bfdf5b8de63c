// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/continuous.h"

#include "continuous/fcl_motion.h"
#include "continuous/meshes.h"

namespace kios {
namespace {

using continuous::Motion;

double firstContact(const Modeld& model1, const Motion& motion1, const Modeld& model2,
                    const Motion& motion2, const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  continuous::MovingMeshes pair(model1, motion1, model2, motion2, count);
  const continuous::FirstContact contact = continuous::advance(pair, request.toc_err, count);
  result.is_collide = contact.found;
  result.time_of_contact = contact.time;
  result.contact_tf1 = motion1.pose(contact.time);
  result.contact_tf2 = motion2.pose(contact.time);
  return contact.time;
}

}  // namespace

double continuousCollideMeshes(const Modeld& model1, const fcl::MotionBased* motion1,
                               const Modeld& model2, const fcl::MotionBased* motion2,
                               const fcl::ContinuousCollisionRequestd& request,
                               fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  return firstContact(model1, continuous::motionOf(motion1), model2, continuous::motionOf(motion2),
                      request, result, counts);
}

double continuousCollideMeshes(const Modeld& model1, const fcl::Transform3d& tf1_beg,
                               const fcl::Transform3d& tf1_end, const Modeld& model2,
                               const fcl::Transform3d& tf2_beg, const fcl::Transform3d& tf2_end,
                               const fcl::ContinuousCollisionRequestd& request,
                               fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  const auto between = [&](const fcl::Transform3d& X_0, const fcl::Transform3d& X_1) {
    return continuous::motionBetween(X_0, X_1, request.ccd_motion_type);
  };
  return firstContact(model1, between(tf1_beg, tf1_end), model2, between(tf2_beg, tf2_end), request,
                      result, counts);
}

}  // namespace kios
