// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/moving_pair.h"

#include <utility>
#include <vector>

#include "continuous/mesh_and_solids.h"
#include "continuous/meshes.h"
#include "continuous/octree_cells.h"
#include "model/kios_model.h"
#include "query/mesh_and_other.h"
#include "solid/solid_queries.h"

namespace kios::continuous {

using fcl::CollisionGeometryd;

namespace {

/// Finds the solids of a geometry that is no mesh; false if it can't be served.
bool solidsOf(const CollisionGeometryd& geometry, const Motion& motion, const Modeld& mesh,
              const Motion& mesh_motion, std::vector<ShapeNode>& solids) {
  if (isShape(geometry)) {
    solids.resize(1);
    solids[0].solid = toSolid(geometry);
    return true;
  }
#if FCL_HAVE_OCTOMAP
  if (geometry.getObjectType() == fcl::OT_OCTREE) {
    const auto& octree = static_cast<const fcl::OcTree<double>&>(geometry);
    solids = cellsNear(octree, motion, mesh, mesh_motion);
    return true;
  }
#endif
  return false;
}

}  // namespace

std::unique_ptr<StepSearch> movingPair(const CollisionGeometryd& a, const Motion& motion_a,
                                       const CollisionGeometryd& b, const Motion& motion_b,
                                       ContinuousCounts& counts) {
  const Modeld *mesh_a = asModel(&a), *mesh_b = asModel(&b);
  if (mesh_a && mesh_b) {
    return std::make_unique<MovingMeshes>(*mesh_a, motion_a, *mesh_b, motion_b, counts);
  }
  if (!mesh_a && !mesh_b) refusePair("continuousCollide", a, b);
  const Modeld& mesh = mesh_a ? *mesh_a : *mesh_b;
  const Motion &mesh_motion = mesh_a ? motion_a : motion_b, &motion = mesh_a ? motion_b : motion_a;
  const CollisionGeometryd& geometry = mesh_a ? b : a;
  requireFinished(mesh);
  std::vector<ShapeNode> solids;
  if (!solidsOf(geometry, motion, mesh, mesh_motion, solids)) {
    refusePair("continuousCollide", a, b);
  }
  const auto touching = [&mesh, &geometry](const fcl::Transform3d& X_mesh,
                                           const fcl::Transform3d& X_solids) {
    fcl::CollisionResultd result;
    const fcl::CollisionRequestd request;
    if (marksExist() && solidPair<double>(&mesh, &geometry, nullptr, &mesh)) {
      return collideSolid(mesh, X_mesh, geometry, X_solids, request, result) > 0;
    }
    return collideOther(mesh, X_mesh, geometry, X_solids, request, result) > 0;
  };
  return std::make_unique<MovingMeshAndSolids>(mesh, mesh_motion, std::move(solids), motion,
                                               touching, counts);
}

}  // namespace kios::continuous
