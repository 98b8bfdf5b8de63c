// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "query/cell_tree.h"

#if FCL_HAVE_OCTOMAP
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "fcl_kios/detail/counts.h"
#include "query/posed_solid.h"
#include "query/posed_tree.h"
#include "search/cell_search.h"
#include "shape/triangle_shape.h"

// The searches about an octree and a mesh, in the octree's frame and the units of PosedSolid, whose
// solid is the root's cube.

namespace kios {

/// The pair, and the walk of both trees in double.
class OctreePair {
 public:
  using Cell = engine::Cell;

  /// The arguments are as CellTree's.
  template <typename S>
  OctreePair(const fcl::OcTree<S>& octree, const fcl::Transform3<S>& X_WO, const Mesh& mesh,
             const fcl::Transform3<S>& X_WM, bool unknown, CellTree::Matters matters,
             SearchCounts& counts)
      : OctreePair(PosedSolid(rootCube(octree), X_WM, X_WO, mesh), mesh, octree.getRoot(), unknown,
                   std::move(matters), counts) {}

  const PosedSolid& posed() const { return posed_; }
  const CellTree& cells() const { return cells_; }

 protected:
  struct CellAndNode {
    double bound;  ///< of the distance of the cell and what the node contains
    Cell cell;
    std::uint32_t node;
  };

  OctreePair(PosedSolid posed, const Mesh& mesh, const CellTree::Node* root, bool unknown,
             CellTree::Matters matters, SearchCounts& counts);
  ~OctreePair() = default;

  /// Shows leaves of both trees of whose pairs skip(bound) is false, the nearest first, until
  /// test(cell, triangle) returns true.
  template <typename Skip, typename Test>
  void walk(const Skip& skip, const Test& test);
  /// The spheres of a node, grown by all that rounds, so that each contains the posed content
  /// however that is rounded.
  void placeSpheres(std::uint32_t node, Ball (&spheres)[engine::kSphereRows]) const;
  /// A cell about the origin, and a triangle of the mesh relative to the cell's centre.
  const shape::Solid& cubeOf(const Cell& cell);
  shape::Triangle triangleFrom(const Cell& cell, std::uint32_t triangle) const;

  const Mesh mesh_;
  const PosedSolid posed_;
  CellTree cells_;
  SearchCounts& counts_;

 private:
  CellAndNode bounded(const Cell& cell, std::uint32_t node,
                      const Ball (&spheres)[engine::kSphereRows]) const;

  PosedTree tree_;
  double pad_;
  shape::Solid cube_;
};

/// The cells and triangles that meet.
class OctreeContacts final : public OctreePair, engine::CellSide {
 public:
  struct Found {
    Cell cell;
    std::uint32_t triangle;
  };

  using OctreePair::OctreePair;

  /// Up to `limit`; in one order, by triangles, then cells, if these are all.
  const std::vector<Found>& run(std::size_t limit);
  /// In the world, but for the units of the depth.
  shape::TriangleShapeContact contactOf(const Found& found);

 private:
  std::uint32_t open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                     std::uint32_t& leaves) override {
    return cells_.open(node, wanted, children, leaves);
  }
  bool evaluate(const Cell& cell, std::uint32_t triangle, bool sure) override;
  bool makeFrame(engine::CellFrame& frame) const;

  std::size_t limit_ = 0;
  std::vector<Found> found_;
};

/// The search for the nearest cell and triangle.
class OctreeDistance final : public OctreePair {
 public:
  using OctreePair::OctreePair;

  /// Errors and lengths are in units.
  void run(double rel_err, double abs_err, double far_enough);

  int triangle() const { return triangle_; }  ///< -1 if none is nearer than far_enough
  const CellTree::Node* node() const { return static_cast<const CellTree::Node*>(cell_.node); }
  double distance() const { return best_; }
  /// In units.
  const shape::Vec& onCell() const { return on_cell_; }
  const shape::Vec& onTriangle() const { return on_triangle_; }

 private:
  double best_ = 0;
  int triangle_ = -1;
  Cell cell_ = {nullptr, 0, 0, 0, 0, 0};
  shape::Vec on_cell_, on_triangle_;
};

}  // namespace kios
#endif  // FCL_HAVE_OCTOMAP
