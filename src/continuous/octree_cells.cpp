// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/octree_cells.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <utility>

namespace kios::continuous {
namespace {

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

}  // namespace

std::vector<ShapeNode> cellsNear(const fcl::OcTree<double>& octree, const Motion& octree_motion,
                                 const Modeld& mesh, const Motion& mesh_motion) {
  const Vector3d corner = octree.getRootBV().max_;
  const RelativeMotion motion(octree_motion, mesh_motion, corner.norm(), reachOf(mesh));
  return Collector(octree, sweptBy(mesh, motion)).collect();
}

}  // namespace kios::continuous
#endif  // FCL_HAVE_OCTOMAP
