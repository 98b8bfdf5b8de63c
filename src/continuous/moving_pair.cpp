// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/moving_pair.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fcl/config.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#endif

#include "continuous/mesh_and_solids.h"
#include "continuous/meshes.h"
#include "model/kios_model.h"
#include "solid/mesh_and_other.h"

namespace kios::continuous {

using fcl::CollisionGeometryd;

namespace {

#if FCL_HAVE_OCTOMAP
using Eigen::Vector3d;

struct Sphere {
  Vector3d center;
  double radius;
};

/// Returns spheres in the octree's frame that contain the mesh at all times: one for each part of
/// the time.
std::vector<Sphere> sweptBy(const Modeld& mesh, const RelativeMotion& motion) {
  constexpr int kParts = 64;
  const kIOSd& root = mesh.getBV(0).bv;
  std::vector<Sphere> spheres;
  for (int i = 0; i < kParts; ++i) {
    const double duration = 1.0 / kParts;
    const RelativeVelocities v = motion.at(i * duration, duration);
    const Vector3d center = v.pose() * root.center0;
    const auto drift = v.driftFromA(center, 0, duration);
    const double way = duration * std::min(drift.most, drift.speed + 0.5 * duration * drift.change);
    const double lengths = center.norm() + way + root.radius0;
    spheres.push_back(
        {center, root.radius0 * (1 + v.stretch()) + way + v.pad() + 0x1p-40 * lengths});
  }
  return spheres;
}

/// Collects the cells that matter.
class Collector {
 public:
  Collector(const fcl::OcTree<double>& octree, std::vector<Sphere> swept)
      : octree_(octree), swept_(std::move(swept)) {}

  std::vector<ShapeNode> collect() {
    const auto* root = octree_.getRoot();
    const fcl::AABB<double> box = octree_.getRootBV();
    if (root && matters(root, box)) {
      nodes_.push_back(nodeOf(box));
      expand(0, root, box);
    }
    return std::move(nodes_);
  }

 private:
  using Cell = fcl::OcTree<double>::OcTreeNode;

  static ShapeNode nodeOf(const fcl::AABB<double>& box) {
    ShapeNode node;
    node.solid.kind = shape::Kind::kBox;
    node.solid.half = 0.5 * (box.max_ - box.min_);
    node.center = 0.5 * (box.max_ + box.min_);
    return node;
  }

  bool matters(const Cell* cell, const fcl::AABB<double>& box) const {
    if (!octree_.isNodeOccupied(cell)) return false;
    const Vector3d half = 0.5 * (box.max_ - box.min_), center = 0.5 * (box.max_ + box.min_);
    return std::any_of(swept_.begin(), swept_.end(), [&](const Sphere& s) {
      const Vector3d outside = ((s.center - center).cwiseAbs() - half).cwiseMax(0.0);
      return outside.norm() <= s.radius;
    });
  }

  void expand(int index, const Cell* cell, const fcl::AABB<double>& box) {
    if (!octree_.nodeHasChildren(cell)) return;
    std::pair<const Cell*, fcl::AABB<double>> children[8];
    int count = 0;
    for (unsigned int i = 0; i < 8; ++i) {
      if (!octree_.nodeChildExists(cell, i)) continue;
      auto& [child, child_box] = children[count];
      child = octree_.getNodeChild(cell, i);
      fcl::computeChildBV(box, i, child_box);
      if (matters(child, child_box)) ++count;
    }
    const int first = static_cast<int>(nodes_.size());
    if (count == 0) {  // not a leaf of the octree: a solid that nothing is in
      nodes_[index].empty = true;
      return;
    }
    nodes_[index].first = first;
    nodes_[index].count = count;
    for (int i = 0; i < count; ++i) nodes_.push_back(nodeOf(children[i].second));
    for (int i = 0; i < count; ++i) expand(first + i, children[i].first, children[i].second);
  }

  const fcl::OcTree<double>& octree_;
  const std::vector<Sphere> swept_;
  std::vector<ShapeNode> nodes_;
};

/// Returns the occupied cells of an octree that the moving mesh may come near to, as a tree of
/// boxes in the octree's frame. Occupied as in FCL's collision: every cell down to a leaf is.
std::vector<ShapeNode> cellsNear(const fcl::OcTree<double>& octree, const Motion& octree_motion,
                                 const Modeld& mesh, const Motion& mesh_motion) {
  const Vector3d corner = octree.getRootBV().max_;
  const RelativeMotion motion(octree_motion, mesh_motion, corner.norm(), reachOf(mesh));
  return Collector(octree, sweptBy(mesh, motion)).collect();
}

#endif  // FCL_HAVE_OCTOMAP

/// Finds the solids of a geometry that is no mesh; false if it can't be served.
bool solidsOf(const CollisionGeometryd& geometry, const Motion& motion, const Modeld& mesh,
              const Motion& mesh_motion, std::vector<ShapeNode>& solids) {
  if (isShape(geometry)) {
    solids.resize(1);
    solids[0].solid = toSolid(geometry);
    shape::makeRows(solids[0].solid);
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
    return MeshAndOther<double>{mesh, X_mesh, geometry, X_solids, nullptr}.touch();
  };
  return std::make_unique<MovingMeshAndSolids>(mesh, mesh_motion, std::move(solids), motion,
                                               touching, counts);
}

}  // namespace kios::continuous
