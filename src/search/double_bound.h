// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "search/float_frame.h"
#include "search/search.h"
#include "tree/tree.h"
#include "volume/rounding.h"

// Bounds by boxes in double, of a pair at a time, where those in floats leave open whether there is
// anything between the contents, as where bodies all but lie on each other.

namespace kios::engine {

// In double, content is within a box but for the rounding of stored vertices, of kStored times what
// extentOf() gives; all else is 2^-53 of the lengths that enter, some sixty times.
inline constexpr double kStored = 1.01 * kUlpFloat, kDouble = 0x1p-44;

inline Eigen::Vector3d columnOf(const Box& box, int column) {
  return {box.x[column], box.y[column], box.z[column]};
}
/// How far a box reaches from its tree's origin, and more.
inline double extentOf(const Box& box) {
  return columnOf(box, kCenter).lpNorm<1>() +
         1.01 * (double{box.half[0]} + box.half[1] + box.half[2]);
}
/// How far it reaches along `w`, of any length, from its centre.
double reachAlong(const Box& box, const Eigen::Vector3d& w);

/// Lower bounds of the distance of what two boxes hold; not positive where they prove nothing.
class DoubleBound {
 public:
  DoubleBound(const Box& a, const Box& b, const TreePose& X_AB);

  /// Along an axis of a, of b, or the product of two.
  double alongA(int i) const;
  double alongB(int j) const;
  double acrossEdges(int i, int j) const;

 private:
  double along(const Eigen::Vector3d& w) const;
  double along(const Eigen::Vector3d& w, double reach_a, double reach_b) const;

  const Box &a_, &b_;
  const Eigen::Matrix3d& R_;
  Eigen::Vector3d way_;
  double pad_;
};

/// Where a point lies along the axes of a box from its centre, and how far out of it: below 0
/// inside.
struct OutOfBox {
  OutOfBox(const Box& box, const Eigen::Vector3d& point) {
    const Eigen::Vector3d v = point - columnOf(box, kCenter);
    for (int i = 0; i < 3; ++i) {
      along[i] = v[0] * box.x[i] + v[1] * box.y[i] + v[2] * box.z[i];
      heights[i] = std::abs(along[i]) - box.half[i];
    }
    height = std::max(std::max(heights[0], heights[1]), heights[2]);
  }
  /// The axis along which it is farthest out.
  int axis() const { return heights[0] == height ? 0 : heights[1] == height ? 1 : 2; }

  double along[3], heights[3], height;
};

/// Lower bound of the distance of what a box of a tree holds from a point in the tree's frame.
double boxBound(const Box& box, const Eigen::Vector3d& point, const OutOfBox& out);
inline double boxBound(const Box& box, const Eigen::Vector3d& point) {
  return boxBound(box, point, OutOfBox(box, point));
}

/// Points as a leaf stores them: rows x, y, z by chunk.
struct StoredPoints {
  const Lanes* rows;
  int count;
};

/// Lower bound of the distance of points of a and of b along a direction in a's frame, of any
/// length, from a to b.
double boundAlong(const float (&w)[3], const StoredPoints& a, const StoredPoints& b,
                  const TreePose& X_AB);

/// Lower bound of the distance of two nodes, or triangles of leaves: by boxes, along an axis of
/// either, or by the central sphere of a node whose tree has none; by both of such a root. Not the
/// best; not positive where it proves nothing.
double boundInDouble(const Search& search, std::uint32_t node_a, std::uint32_t node_b);

}  // namespace kios::engine
