// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/occupied_box.h"

#if FCL_HAVE_OCTOMAP

namespace kios::continuous {
namespace {

using Cell = fcl::OcTreed::OcTreeNode;
using Box = fcl::AABB<double>;

/// Widens a box until no occupied cell is farther along one axis.
class Widening {
 public:
  Widening(const fcl::OcTreed& octree, int axis, bool up, Eigen::AlignedBox3d& box)
      : octree_(octree), axis_(axis), up_(up), box_(box) {}

  void visit(const Cell* cell, const Box& bounds) {
    if (!octree_.isNodeOccupied(cell) || !exceeds(bounds)) return;
    if (!octree_.nodeHasChildren(cell)) {
      box_.extend(Eigen::AlignedBox3d(bounds.min_, bounds.max_));
      return;
    }
    // Those first that may be farthest: they spare the others.
    const unsigned int side = 1U << static_cast<unsigned int>(axis_);
    for (const bool far : {true, false}) {
      for (unsigned int i = 0; i < 8; ++i) {
        if (((i & side) != 0) != (up_ == far) || !octree_.nodeChildExists(cell, i)) continue;
        Box child;
        fcl::computeChildBV(bounds, i, child);
        visit(octree_.getNodeChild(cell, i), child);
      }
    }
  }

 private:
  bool exceeds(const Box& bounds) const {
    return up_ ? bounds.max_[axis_] > box_.max()[axis_] : bounds.min_[axis_] < box_.min()[axis_];
  }

  const fcl::OcTreed& octree_;
  const int axis_;
  const bool up_;
  Eigen::AlignedBox3d& box_;
};

}  // namespace

Eigen::AlignedBox3d occupiedBox(const fcl::OcTreed& octree) {
  Eigen::AlignedBox3d box;
  const Cell* const root = octree.getRoot();
  if (!root) return box;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool up : {false, true}) {
      Widening(octree, axis, up, box).visit(root, octree.getRootBV());
    }
  }
  return box;
}

}  // namespace kios::continuous
#endif  // FCL_HAVE_OCTOMAP
