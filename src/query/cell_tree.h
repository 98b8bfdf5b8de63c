// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/query/octree_queries.h"

#if FCL_HAVE_OCTOMAP
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

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

/// Holds a cell's box about the origin and where its centre lies, in the units of a query.
struct CenteredCell {
  shape::Solid box;
  shape::Vec center;

  CenteredCell() { box.kind = shape::Kind::kBox; }

  template <typename S>
  void set(const fcl::AABB<S>& cell, double units) {
    const shape::Vec low = cell.min_.template cast<double>(),
                     high = cell.max_.template cast<double>();
    center = (0.5 * (low + high)) * units;
    box.half = (0.5 * (high - low)) * units;
  }
  /// A triangle of the octree's frame relative to the centre.
  TriangleVertices<double> relative(const TriangleVertices<double>& t) const {
    return {t[0] - center, t[1] - center, t[2] - center};
  }
};

/// An octree as a search for contacts sees it: only what matters, by integer coordinates. Nothing
/// is kept beyond a query, as octrees change in place.
template <typename S>
class CellTree {
 public:
  using Node = octomap::OcTreeNode;
  using Cell = engine::Cell;

  /// `root_half` is in the units of the query. With `costs` cells matter that are not free, or that
  /// the octree knows nothing about; without, if `occupied`, occupied ones.
  CellTree(const fcl::OcTree<S>& octree, double root_half, bool costs, bool occupied)
      : octree_(octree),
        unit_(std::max(root_half / engine::kRootHalf, std::numeric_limits<double>::min())),
        costs_(costs),
        occupied_(occupied) {}

  double unit() const { return unit_; }
  /// Where the search's origin is, in the octree's frame.
  Eigen::Vector3d origin() const { return {at(0), at(1), at(2)}; }

  /// Tells of a node, null where there is none, what open() tells of the children.
  bool matters(const Node* node);
  static bool isLeaf(const Node* node);
  /// As engine::CellSide::open().
  std::uint32_t open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                     std::uint32_t& leaves);

  /// The cells that matter, touch the box around the intersection of spheres, of which the first is
  /// S0, and are leaves or no larger than that. Sets the origin near S0's centre.
  std::vector<Cell> cellsNear(const Ball* spheres, int count, double error);

  /// The cell's box by FCL's own arithmetic, in FCL's units.
  fcl::AABB<S> boxAt(const Cell& cell) const;

 private:
  void collect(Cell cell, std::vector<Cell>& found);
  double at(int axis) const { return origin_[axis] * unit_; }

  const fcl::OcTree<S>& octree_;
  const double unit_;
  const bool costs_, occupied_;
  std::int32_t origin_[3] = {}, low_[3] = {}, high_[3] = {};  // the last two relative to it
  double least_half_ = 0;
  float known_value_ = std::numeric_limits<float>::quiet_NaN();
  bool known_to_matter_ = false;
};

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
