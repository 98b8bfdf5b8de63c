// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>

#include "volume/lanes.h"

namespace kios::engine {

/// Holds the few elements of a mesh of one to four triangles in place: to allocate a dozen arrays
/// takes as long as the rest of its build.
template <typename T>
using SmallVector = boost::container::small_vector<T, 4>;

/// Corners of a triangle in lanes x, y, z, 0, relative to some origin.
struct Corners {
  lanes::Float4 v[3];
};

/// An axis-aligned box in some frame; empty at first.
struct LaneBox {
  lanes::Float4 low, high;

  LaneBox();
  void add(const LaneBox& b) {
    low = lanes::min(low, b.low);
    high = lanes::max(high, b.high);
  }
  void add(lanes::Float4 p) {
    low = lanes::min(low, p);
    high = lanes::max(high, p);
  }
  float squaredDiagonal() const {
    const lanes::Float4 d = high - low, squares = d * d;
    return squares[0] + squares[1] + squares[2];
  }
};

/// Columns of the rotation into a frame.
struct LaneFrame {
  lanes::Float4 columns[3];
};

/// A plane across an axis of a frame: a triangle lies left of it if the sum of its corners is below
/// `value` along the axis.
struct CutPlane {
  int axis = -1;  ///< -1: the centroids are one
  float value = 0;
};

/// Splits a few hundred triangles, again and again, at the least of a cost like the surface area's:
/// the squared diagonal of both sides, each times the number of leaves that its triangles fill.
/// Boxes lie along the principal axes of the triangles' centroids.
class BlockPartition {
 public:
  /// Sets the triangles, in the order 0, 1, ..., n - 1.
  void start(const Corners* triangles, int n);

  /// Splits the n > 1 triangles order()[first], order()[first + 1], ... in two, and orders them so.
  /// Returns how many come first: at least 1, at most n - 1. `in_halves` gives up the cost for
  /// balance.
  int split(int first, int n, bool in_halves);

  const SmallVector<std::uint32_t>& order() const { return order_; }

  /// The best plane for many triangles of which these are a sample, each for `weight` of them, and
  /// the frame that it is meant in.
  CutPlane cut(const Corners* triangles, int n, float weight, LaneFrame& frame);

 private:
  /// A triangle in the frame at hand.
  struct Item {
    LaneBox box;
    lanes::Float4 center;  ///< thrice
  };

  LaneFrame principalFrame(const std::uint32_t* items, int n) const;
  void project(const std::uint32_t* items, int n, const LaneFrame& frame);
  LaneBox centersOf(const std::uint32_t* items, int n) const;
  CutPlane bestBin(const std::uint32_t* items, int n, float weight) const;
  int sweep(std::uint32_t* items, int n) const;
  int halve(std::uint32_t* items, int n) const;

  const Corners* triangles_ = nullptr;
  SmallVector<std::uint32_t> order_;
  SmallVector<Item> items_;        ///< by triangle
  SmallVector<int> frame_shared_;  ///< by triangle: by how many its frame is shared
};

}  // namespace kios::engine
