// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/continuous.h"

#include <memory>

#include "continuous/fcl_motion.h"
#include "continuous/mesh_and_solid.h"
#include "continuous/meshes.h"
#include "fcl/dispatch.h"

namespace kios {
namespace {

using continuous::Motion;
using continuous::MovingPair;
using fcl::CollisionGeometryd;

std::unique_ptr<MovingPair> movingPair(const CollisionGeometryd& o1, const Motion& motion1,
                                       const CollisionGeometryd& o2, const Motion& motion2,
                                       ContinuousCounts& counts) {
  using continuous::MovingMeshAndSolid;
  using continuous::MovingMeshes;
  const Modeld *model1 = asModel(&o1), *model2 = asModel(&o2);
  if (model1 && model2) {
    return std::make_unique<MovingMeshes>(*model1, motion1, *model2, motion2, counts);
  }
  if (model1 && isShape(o2)) {
    return std::make_unique<MovingMeshAndSolid>(*model1, motion1, o2, toSolid(o2), motion2, counts);
  }
  if (model2 && isShape(o1)) {
    return std::make_unique<MovingMeshAndSolid>(*model2, motion2, o1, toSolid(o1), motion1, counts);
  }
  refusePair("continuousCollide", o1, o2);
}

double firstContact(const CollisionGeometryd& o1, const Motion& motion1,
                    const CollisionGeometryd& o2, const Motion& motion2, double toc_err,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  const auto pair = movingPair(o1, motion1, o2, motion2, count);
  const continuous::FirstContact contact = continuous::advance(*pair, toc_err, count);
  result.is_collide = contact.found;
  result.time_of_contact = contact.time;
  result.contact_tf1 = motion1.pose(contact.time);
  result.contact_tf2 = motion2.pose(contact.time);
  return contact.time;
}

}  // namespace

double firstContact(const CollisionGeometryd& o1, const fcl::MotionBased* motion1,
                    const CollisionGeometryd& o2, const fcl::MotionBased* motion2,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  return firstContact(o1, continuous::motionOf(motion1), o2, continuous::motionOf(motion2),
                      request.toc_err, result, counts);
}

double firstContact(const CollisionGeometryd& o1, const fcl::Transform3d& tf1_beg,
                    const fcl::Transform3d& tf1_end, const CollisionGeometryd& o2,
                    const fcl::Transform3d& tf2_beg, const fcl::Transform3d& tf2_end,
                    const fcl::ContinuousCollisionRequestd& request,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  const auto between = [&](const fcl::Transform3d& X_0, const fcl::Transform3d& X_1) {
    return continuous::motionBetween(X_0, X_1, request.ccd_motion_type);
  };
  return firstContact(o1, between(tf1_beg, tf1_end), o2, between(tf2_beg, tf2_end), request.toc_err,
                      result, counts);
}

}  // namespace kios
