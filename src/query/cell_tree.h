// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/contact.h"

#if FCL_HAVE_OCTOMAP
#include <cstdint>
#include <functional>
#include <limits>

#include "search/cell_search.h"
#include "shape/solid.h"
#include "volume/balls.h"

namespace kios {

/// The cube of an octree's root, about the origin.
template <typename S>
shape::Solid rootCube(const fcl::OcTree<S>& octree) {
  shape::Solid cube;
  cube.kind = shape::Kind::kBox;
  cube.half = octree.getRootBV().max_.template cast<double>();
  return cube;
}

/// An octree of either scalar as searches see it: only what matters, by integer coordinates, which
/// times the unit are octomap's own, rounded once. Nothing is kept beyond a query, as octrees
/// change in place.
class CellTree {
 public:
  using Node = octomap::OcTreeNode;
  using Cell = engine::Cell;
  /// Depends on the node's value alone.
  using Matters = std::function<bool(const Node&)>;

  /// `root_half` is in the units of the query; `unknown` tells whether cells matter that the octree
  /// knows nothing about.
  CellTree(const Node* root, double root_half, bool unknown, Matters matters);

  double unit() const { return unit_; }
  /// Where the search's origin is, in the octree's frame.
  Eigen::Vector3d origin() const { return {at(0, 0), at(1, 0), at(2, 0)}; }
  Eigen::Vector3d centerOf(const Cell& cell) const {
    return {at(0, cell.x), at(1, cell.y), at(2, cell.z)};
  }
  double halfOf(const Cell& cell) const { return cell.half * unit_; }

  /// As engine::CellSide::open().
  std::uint32_t open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                     std::uint32_t& leaves);

  /// False if nothing matters.
  bool rootMatters() { return matters(root_); }
  Cell root() const;
  /// Sets the origin near the centre of the first of some spheres. False if nothing matters, or the
  /// box around their intersection is off the root.
  bool startNear(const Ball* spheres, int count);

 private:
  bool matters(const Node* node);
  double at(int axis, std::int32_t x) const { return (origin_[axis] + x) * unit_; }

  const Node* const root_;
  const double unit_;
  const bool unknown_;
  const Matters matters_;
  std::int32_t origin_[3] = {};
  float known_value_ = std::numeric_limits<float>::quiet_NaN();
  bool known_to_matter_ = false;
};

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
