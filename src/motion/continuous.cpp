// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/motion/continuous.h"

#include <memory>
#include <utility>
#include <vector>

#include "model/kios_model.h"
#include "motion/fcl_motion.h"
#include "motion/mesh_and_solids.h"
#include "motion/meshes.h"
#include "motion/octree_cells.h"
#include "query/mesh_and_other.h"

namespace kios {
namespace {

using continuous::Motion;
using continuous::MovingPair;
using fcl::CollisionGeometryd;

/// The solids of a geometry that is no mesh; false if it can't be served.
bool solidsOf(const CollisionGeometryd& geometry, const Motion& motion, const Modeld& mesh,
              const Motion& mesh_motion, std::vector<continuous::SolidNode>& solids) {
  if (isShape(geometry)) {
    solids.resize(1);
    solids[0].solid = toSolid(geometry);
    return true;
  }
#if FCL_HAVE_OCTOMAP
  if (geometry.getObjectType() == fcl::OT_OCTREE) {
    const auto& octree = static_cast<const fcl::OcTree<double>&>(geometry);
    solids = continuous::cellsNear(octree, motion, mesh, mesh_motion);
    return true;
  }
#endif
  return false;
}

std::unique_ptr<MovingPair> movingPair(const CollisionGeometryd& o1, const Motion& motion1,
                                       const CollisionGeometryd& o2, const Motion& motion2,
                                       ContinuousCounts& counts) {
  const Modeld *model1 = asModel(&o1), *model2 = asModel(&o2);
  if (model1 && model2) {
    return std::make_unique<continuous::MovingMeshes>(*model1, motion1, *model2, motion2, counts);
  }
  if (!model1 && !model2) refusePair("continuousCollide", o1, o2);
  const Modeld& mesh = model1 ? *model1 : *model2;
  const Motion &mesh_motion = model1 ? motion1 : motion2, &motion = model1 ? motion2 : motion1;
  const CollisionGeometryd& geometry = model1 ? o2 : o1;
  requireFinished(mesh);
  std::vector<continuous::SolidNode> solids;
  if (!solidsOf(geometry, motion, mesh, mesh_motion, solids)) {
    refusePair("continuousCollide", o1, o2);
  }
  const auto touching = [&mesh, &geometry](const fcl::Transform3d& X_mesh,
                                           const fcl::Transform3d& X_solids) {
    fcl::CollisionResultd result;
    return collideOther(mesh, X_mesh, geometry, X_solids, fcl::CollisionRequestd(), result) > 0;
  };
  return std::make_unique<continuous::MovingMeshAndSolids>(mesh, mesh_motion, std::move(solids),
                                                           motion, touching, counts);
}

double firstContact(const CollisionGeometryd& o1, const Motion& motion1,
                    const CollisionGeometryd& o2, const Motion& motion2, double toc_err,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  const auto pair = movingPair(o1, motion1, o2, motion2, count);
  // As in collide(): what isn't occupied touches nothing.
  const bool occupied = o1.isOccupied() && o2.isOccupied();
  const continuous::FirstContact contact =
      occupied ? continuous::advance(*pair, toc_err, count) : continuous::FirstContact{false, 1};
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
