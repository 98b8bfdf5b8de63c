// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "tree/tree.h"

namespace kios {

/// A mesh's tree in another frame, in double, for searches that floats can't serve: x -> R (unit x)
/// + t of coordinates as they are stored.
struct PosedTree {
  const engine::Tree& tree;
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  double unit;

  const engine::Node& node(std::uint32_t n) const { return tree.nodes[n]; }
  bool isLeaf(std::uint32_t n) const { return node(n).isLeaf(); }
  /// The central sphere.
  double radius(std::uint32_t n) const { return double{node(n).r[engine::kCentral]} * unit; }
  Eigen::Vector3d center(std::uint32_t n) const { return rotated(n, engine::kCentral) + t; }
  Eigen::Vector3d rotated(std::uint32_t n, int row) const {
    const engine::Node& at = node(n);
    return R * (unit * Eigen::Vector3d(at.x[row], at.y[row], at.z[row]));
  }

  template <typename Visit>
  void forChildren(std::uint32_t n, const Visit& visit) const {
    const std::uint32_t first = node(n).first_child;
    const int count = tree.children[static_cast<std::size_t>(node(n).child)].count;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) visit(first + i);
  }
  /// Shows the triangles of a leaf until test() returns true, which is returned.
  template <typename Test>
  bool anyTriangle(std::uint32_t n, const Test& test) const {
    const engine::Leaf& leaf = tree.leaves[node(n).leaf()];
    for (std::uint32_t i = 0; i < leaf.num_faces; ++i) {
      if (test(tree.features[leaf.feature_offset + i].triangle())) return true;
    }
    return false;
  }
};

}  // namespace kios
