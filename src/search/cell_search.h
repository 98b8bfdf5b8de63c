// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "fcl_kios/detail/counts.h"
#include "search/float_frame.h"
#include "tree/tree.h"

// The types that the SIMD search for triangles that touch cells of an octree shares with the exact
// stage.

namespace kios::engine {

/// The octree's root is a cube of half size 2^20 units; its corners, and those of all cells down to
/// level 20, have integer coordinates (octomap's keys have 16 bits).
constexpr int kCellLevels = 20;
constexpr std::int32_t kRootHalf = std::int32_t{1} << kCellLevels;

/// A cell: a cube about (x, y, z), in units, relative to the search's origin.
struct Cell {
  const void* node;  ///< what CellSide knows it by
  std::int32_t x, y, z;
  std::uint32_t half : 31;
  std::uint32_t leaf : 1;

  /// Child i lies on the upper side of x, y, z where bit 0, 1, 2 of i is set.
  Cell child(std::uint32_t i, const void* of_node, bool is_leaf) const {
    const auto by = static_cast<std::int32_t>(half / 2U);
    const auto shift = [&](std::uint32_t bit) { return (i >> bit & 1U) != 0 ? by : -by; };
    return {of_node, x + shift(0), y + shift(1), z + shift(2), half / 2U, is_leaf};
  }
};

/// Where a tree lies among the cells: x -> R x + t from the tree's frame to that of the octree's
/// axes about the search's origin, a corner of the finest grid that is near the tree.
///
/// All tests are separations, exact ones but for rounding, of the moved content from a cube of half
/// size g = h (1 + 2^-20) + pad in place of h: along an axis of the octree, along any other w (as
/// it is computed) where the cube takes g |w|_1, or by the distance from the cube. A pair that
/// touches, or that the exact stage takes for one that does, must pass.
///
/// u = 2^-24, S = tree.reach + |t|_1, h of the cell; all lengths along w below are times |w|_1.
/// What touches lies within S of the origin, so that all of the mesh is within h + 2 S of the
/// cube's centre c in each coordinate, and |c| <= h + S.
/// - The cube: c and h are integers times a unit that is rounded: 2 u (h + S), and 2 u h.
/// - Vertices as stored in float, and moved: 9 u S (search/float_frame.h).
/// - Spheres: centres as middle +- half, moved: 10 u S. Differences with c, then with g: 2 u (h +
///   2 S) + u h. Squares, sums and the comparison with r^2: 4 u times a distance that is at most
///   S + r. What vanishes below 2^-126 makes a distance shorter, and r^2 below that belongs to an r
///   far below the pad.
/// - Triangles: differences with c: u (h + 2 S). Edges, 2 u S each, have to be no better than
///   directions, but that the two ends of an edge are taken for one: 2 u |edge| = 4 u S. Products
///   and sums of w . v 3 u (h + 2 S), and of g |w|_1 3 u g.
/// These are below 11 u h + 36 u S: 2^-20 = 16 u and 2^-18 = 64 u cover them.
/// - Boxes: p - c' = sum a_i d_i over the duals d_i of the stored axes, |a_i| <= half_i; the duals
///   are off by 3.5 u and moved axes by 12 u, sum half_i <= 3 r: 48 u S. The moved centre 20 u S.
///   Products and sums with w 3 u (h + 2 S), 3 u g, and 12 u S of the halves. These are below
///   8 u h + 92 u S: 2^-17 S = 128 u S in place of 64.
/// - A corner of a triangle, or the middle of an edge (2 u (h + 2 S) more), lies in the cube if it
///   does so in one of half size h (1 - 2^-20) - pad.
/// A gap counts only above 2^-96, below which products may have vanished: with S >= 2^-36 and
/// lengths up to 2^45 none is far from that and none overflows.
///
/// In `pad` and `box_pad` also: what the exact stage itself rounds, and a rotation that is one only
/// to `stretch`, by which the radii of moved spheres grow: stretch S.
struct CellFrame {
  FloatPose from_mesh;
  float unit;
  float pad, box_pad;

  static constexpr double kLeastReach = 0x1p-36, kLargestReach = 0x1p38, kLargestRoot = 0x1p44;
};

/// The exact side of a search.
class CellSide {
 public:
  /// Returns which of the children `wanted`, as bits, of an inner cell matter, sets their nodes,
  /// and in `leaves` the bits of those that have no children.
  virtual std::uint32_t open(const void* node, std::uint32_t wanted, const void* (&children)[8],
                             std::uint32_t& leaves) = 0;
  /// Tests a leaf and a triangle; `sure` if a point of the triangle lies in the cell by more than
  /// all that rounds. Returns true to end the search.
  virtual bool evaluate(const Cell& cell, std::uint32_t triangle, bool sure) = 0;

 protected:
  ~CellSide() = default;
};

/// Every triangle that may touch a leaf below `start` is evaluated with it, but for leaves that
/// don't matter. Depth first, cells near the middle of a node first.
struct CellSearch {
  const Tree& tree;
  const CellFrame& frame;
  CellSide& cells;
  SearchCounts& counts;
  const Cell* start;
  std::size_t num_start;
};

}  // namespace kios::engine
