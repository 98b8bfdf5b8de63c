// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/step_search.h"

#include <memory>
#include <utility>
#include <vector>

#include <fcl/config.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#endif

#include "continuous/mesh_and_solids.h"
#include "continuous/meshes.h"
#include "continuous/occupied_box.h"
#include "model/kios_model.h"

namespace kios::continuous {

using fcl::CollisionGeometryd;

namespace {

#if FCL_HAVE_OCTOMAP
/// The occupied cells of an octree as boxes in its frame, each made when it is first looked into.
/// Occupied as in FCL's collision: every cell down to a leaf is.
class Cells {
 public:
  explicit Cells(const fcl::OcTreed& octree) : octree_(octree), box_(occupiedBox(octree)) {}

  std::vector<ShapeNode> root() {
    if (box_.isEmpty()) return {};
    return {nodeOf(octree_.getRoot(), octree_.getRootBV())};
  }

  void operator()(int index, std::vector<ShapeNode>& nodes) {
    const auto [cell, bounds] = cells_[static_cast<std::size_t>(index)];
    nodes[index].first = static_cast<int>(nodes.size());
    for (unsigned int i = 0; i < 8; ++i) {
      if (!octree_.nodeChildExists(cell, i)) continue;
      const auto* const child = octree_.getNodeChild(cell, i);
      if (!octree_.isNodeOccupied(child)) continue;
      Box child_bounds;
      fcl::computeChildBV(bounds, i, child_bounds);
      nodes.push_back(nodeOf(child, child_bounds));
      ++nodes[index].count;
    }
    nodes[index].state = nodes[index].count > 0 ? ShapeNode::kInner : ShapeNode::kEmpty;
  }

 private:
  using Box = fcl::AABB<double>;

  // Nothing is occupied beyond the box, in which inner cells need not reach farther than it.
  ShapeNode nodeOf(const fcl::OcTreed::OcTreeNode* cell, const Box& bounds) {
    const Eigen::Vector3d low = bounds.min_.cwiseMax(box_.min()),
                          high = bounds.max_.cwiseMin(box_.max());
    ShapeNode node;
    node.solid.kind = shape::Kind::kBox;
    node.solid.half = (0.5 * (high - low)).cwiseMax(0.0);
    node.center = 0.5 * (low + high);
    if (octree_.nodeHasChildren(cell)) node.state = ShapeNode::kClosed;
    cells_.emplace_back(cell, bounds);
    return node;
  }

  const fcl::OcTreed& octree_;
  const Eigen::AlignedBox3d box_;
  std::vector<std::pair<const fcl::OcTreed::OcTreeNode*, Box>> cells_;  // by node
};
#endif

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
  MovingMeshAndSolids::Open open;
  if (isShape(geometry)) {
    solids.resize(1);
    solids[0].solid = toSolid(geometry);
    shape::makeRows(solids[0].solid);
#if FCL_HAVE_OCTOMAP
  } else if (geometry.getObjectType() == fcl::OT_OCTREE) {
    const auto cells = std::make_shared<Cells>(static_cast<const fcl::OcTreed&>(geometry));
    solids = cells->root();
    open = [cells](int node, std::vector<ShapeNode>& nodes) { (*cells)(node, nodes); };
#endif
  } else {
    refusePair("continuousCollide", a, b);
  }
  return std::make_unique<MovingMeshAndSolids>(mesh, mesh_motion, std::move(solids), motion,
                                               std::move(open), counts);
}

}  // namespace kios::continuous
