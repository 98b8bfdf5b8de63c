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

std::unique_ptr<MovingPair> movingPair(const CollisionGeometryd& a, const Motion& motion_a,
                                       const CollisionGeometryd& b, const Motion& motion_b,
                                       ContinuousCounts& counts) {
  const Modeld *mesh_a = asModel(&a), *mesh_b = asModel(&b);
  if (mesh_a && mesh_b) {
    return std::make_unique<continuous::MovingMeshes>(*mesh_a, motion_a, *mesh_b, motion_b, counts);
  }
  if (!mesh_a && !mesh_b) refusePair("continuousCollide", a, b);
  const Modeld& mesh = mesh_a ? *mesh_a : *mesh_b;
  const Motion &mesh_motion = mesh_a ? motion_a : motion_b, &motion = mesh_a ? motion_b : motion_a;
  const CollisionGeometryd& geometry = mesh_a ? b : a;
  requireFinished(mesh);
  std::vector<continuous::SolidNode> solids;
  if (!solidsOf(geometry, motion, mesh, mesh_motion, solids)) {
    refusePair("continuousCollide", a, b);
  }
  const auto touching = [&mesh, &geometry](const fcl::Transform3d& X_mesh,
                                           const fcl::Transform3d& X_solids) {
    fcl::CollisionResultd result;
    return collideOther(mesh, X_mesh, geometry, X_solids, fcl::CollisionRequestd(), result) > 0;
  };
  return std::make_unique<continuous::MovingMeshAndSolids>(mesh, mesh_motion, std::move(solids),
                                                           motion, touching, counts);
}

double firstContact(const CollisionGeometryd& a, const Motion& motion_a,
                    const CollisionGeometryd& b, const Motion& motion_b, double toc_err,
                    fcl::ContinuousCollisionResultd& result, ContinuousCounts* counts) {
  ContinuousCounts unused;
  ContinuousCounts& count = counts ? *counts : unused;
  const auto pair = movingPair(a, motion_a, b, motion_b, count);
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
