// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "search/prepared_pair.h"

// Checks a prepared tree against its mesh: all of it is there, and nothing sticks out. What else
// leaves hold of features is what searches find: search/brute_force_test.cpp, audit_test.cpp.

namespace kios::testing {

using engine::Box;
using engine::FeatureId;
using engine::kLanes;
using engine::Leaf;
using engine::Node;
using engine::Tree;
using Exact = boost::multiprecision::cpp_bin_float_100;

/// Coordinates as they are compared: -0 and 0 are equal.
using Coordinates = std::tuple<double, double, double>;

template <typename S>
Coordinates coordinates(const Point<S>& p) {
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

/// Calls visit(row, half, sign) for each of a node's spheres, which is row + sign half.
template <typename Visit>
void forSpheres(const Visit& visit) {
  visit(engine::kCentral, engine::kHalf1, 0);
  for (const int sign : {-1, 1}) {
    visit(engine::kMiddle2, engine::kHalf2, sign);
    visit(engine::kMiddle1, engine::kHalf1, sign);
  }
}

/// Returns true if a node's five spheres hold the point, without rounding.
inline bool spheresHold(const Node& node, const Eigen::Vector3f& p) {
  bool all = true;
  forSpheres([&](int row, int half, int sign) {
    const auto at = [&](const float* v) { return Exact(v[row]) + sign * Exact(v[half]); };
    const Exact x = p[0] - at(node.x), y = p[1] - at(node.y), z = p[2] - at(node.z), r = at(node.r);
    all &= r >= 0 && x * x + y * y + z * z <= r * r;
  });
  return all;
}

/// Returns how far the point sticks out of the box, at most 0 if it is inside.
inline double outside(const Box& box, const Eigen::Vector3f& p) {
  double worst = -1;
  for (int i = 0; i < 3; ++i) {
    const Exact along = Exact(box.x[i]) * (Exact(p[0]) - box.x[engine::kCenter]) +
                        Exact(box.y[i]) * (Exact(p[1]) - box.y[engine::kCenter]) +
                        Exact(box.z[i]) * (Exact(p[2]) - box.z[engine::kCenter]);
    worst = std::max(worst, static_cast<double>(Exact(abs(along) - box.half[i])));
  }
  return worst;
}

/// Returns how far the box's axes are from being orthonormal.
inline double skew(const Box& box) {
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double dot =
          double{box.x[i]} * box.x[j] + double{box.y[i]} * box.y[j] + double{box.z[i]} * box.z[j];
      worst = std::max(worst, std::abs(dot - (i == j)));
    }
  }
  return worst;
}

/// Returns the greatest |centre| + |radius| of the node's spheres.
inline double farthest(const Node& node) {
  double result = 0;
  forSpheres([&](int row, int half, int sign) {
    const auto at = [&](const float* v) { return double{v[row]} + sign * double{v[half]}; };
    const fcl::Vector3d center(at(node.x), at(node.y), at(node.z));
    result = std::max(result, center.norm() + std::abs(at(node.r)));
  });
  return result;
}

/// check() fails the test unless the tree is one of the shape.
template <typename S>
class TreeOf {
 public:
  TreeOf(const MeshIn<S>& shape, const Tree& tree) : shape_(shape), tree_(tree) {}

  void check() {
    ASSERT_FALSE(tree_.nodes.empty());
    int flat = 0;
    for (const Node& node : tree_.nodes) flat += static_cast<int>(node.flat);
    if (!tree_.boxes.empty() || flat > 0) {
      ASSERT_EQ(tree_.boxes.size(), tree_.nodes.size());
    }
    ASSERT_EQ(tree_.box_blocks.size(), tree_.boxes.empty() ? 0 : tree_.blocks.size());
    ASSERT_EQ(tree_.children.size(), tree_.blocks.size());
    leaf_seen_.assign(tree_.leaves.size(), 0);
    EXPECT_EQ(descend(0, 0).first, tree_.depth);
    EXPECT_EQ(nodes_seen_, tree_.nodes.size());
    for (const int seen : leaf_seen_) EXPECT_EQ(seen, 1);
    for (std::size_t t = 0; t < shape_.triangles.size(); ++t) EXPECT_EQ(in_leaf_.count(t), 1u);
    EXPECT_EQ(in_leaf_.size(), shape_.triangles.size());
  }

 private:
  using Points = std::vector<Eigen::Vector3f>;

  /// Returns the depth in blocks, and the stored vertices below the node, which must lie within it.
  std::pair<int, Points> descend(std::uint32_t at, int level) {
    ++nodes_seen_;
    const Node& node = tree_.nodes[at];
    Points points;
    int depth = level;
    if (node.isLeaf()) {
      EXPECT_LT(node.leaf(), tree_.leaves.size());
      ++leaf_seen_[node.leaf()];
      points = checkLeaf(node.leaf());
    } else {
      const auto block = static_cast<std::size_t>(node.child);
      const std::size_t count = tree_.children[block].count;
      EXPECT_GE(count, 2u);
      EXPECT_LE(count, static_cast<std::size_t>(kLanes));
      EXPECT_GT(node.first_child, at);  // no cycles
      for (std::uint32_t i = 0; i < kLanes; ++i) {
        const std::uint32_t child = node.first_child + (i < count ? i : 0);
        expectLane(tree_.blocks[block], static_cast<int>(i), tree_.nodes[child]);
        if (!tree_.boxes.empty()) {
          expectLane(tree_.box_blocks[block], static_cast<int>(i), tree_.boxes[child]);
        }
        if (i >= count) continue;
        EXPECT_EQ(tree_.children[block].flat >> i & 1U, tree_.nodes[child].flat);
        const auto [deepest, below] = descend(child, level + 1);
        depth = std::max(depth, deepest);
        points.insert(points.end(), below.begin(), below.end());
      }
    }
    const auto less = [](const auto& p, const auto& q) {
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    int out_of_spheres = 0;
    double out_of_box = 0;
    for (const Eigen::Vector3f& p : points) {
      out_of_spheres += !spheresHold(node, p);
      if (!tree_.boxes.empty()) out_of_box = std::max(out_of_box, outside(tree_.boxes[at], p));
    }
    EXPECT_EQ(out_of_spheres, 0) << "node " << at;
    EXPECT_LE(out_of_box, 0) << "node " << at;
    EXPECT_EQ(node.size, node.r[engine::kCentral]);
    EXPECT_GE(double{tree_.reach} * (1 + 0x1p-50), farthest(node));
    if (!tree_.boxes.empty()) {
      // Each coordinate of an axis is rounded once.
      EXPECT_LE(skew(tree_.boxes[at]), 2.1 * 0x1p-24);
      EXPECT_EQ(tree_.boxes[at].half[3], 0);
    }
    return {depth, points};
  }

  static void expectLane(const engine::Block& block, int lane, const Node& node) {
    for (int row = 0; row < engine::kSphereRows; ++row) {
      EXPECT_EQ(block.x[row].v[lane], node.x[row]);
      EXPECT_EQ(block.y[row].v[lane], node.y[row]);
      EXPECT_EQ(block.z[row].v[lane], node.z[row]);
      EXPECT_EQ(block.r[row].v[lane], node.r[row]);
    }
  }

  static void expectLane(const engine::BoxBlock& block, int lane, const Box& box) {
    for (int column = 0; column < engine::kBoxColumns; ++column) {
      EXPECT_EQ(block.x[column].v[lane], box.x[column]);
      EXPECT_EQ(block.y[column].v[lane], box.y[column]);
      EXPECT_EQ(block.z[column].v[lane], box.z[column]);
    }
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(block.half[axis].v[lane], box.half[axis]);
  }

  Point<S> cornerOf(FeatureId id, std::uint32_t step = 0) const {
    return shape_.corners(id.triangle())[(id.corner() + step) % 3];
  }
  /// Is relative to the origin, as the tree may store it.
  Eigen::Vector3d relative(const Point<S>& p) const {
    return p.template cast<double>() - Eigen::Map<const Eigen::Vector3d>(tree_.origin);
  }

  /// Returns a leaf's vertex i, from the rows of its chunk.
  Eigen::Vector3f vertex(const Leaf& leaf, std::uint32_t i) const {
    const auto* const rows = tree_.lanes.data() + leaf.offset + 3 * (i / kLanes);
    return {rows[0].v[i % kLanes], rows[1].v[i % kLanes], rows[2].v[i % kLanes]};
  }

  Points checkLeaf(std::size_t index) {
    const Leaf& leaf = tree_.leaves[index];
    const FeatureId* const ids = tree_.features.data() + leaf.feature_offset;
    EXPECT_GE(leaf.num_faces, 1);
    EXPECT_LE(leaf.num_faces, engine::kLeafTriangles);
    EXPECT_LE(leaf.num_owned, leaf.num_vertices);

    std::set<Coordinates> distinct;
    for (std::uint32_t i = 0; i < leaf.num_faces; ++i) {
      EXPECT_EQ(ids[i].corner(), 0u);
      EXPECT_TRUE(in_leaf_.insert(ids[i].triangle()).second);
      for (std::uint32_t k = 0; k < 3; ++k) {
        distinct.insert(coordinates(cornerOf(ids[i], k)));
        EXPECT_EQ(vertex(leaf, leaf.corners[3 * i + k]),
                  relative(cornerOf(ids[i], k)).template cast<float>());
      }
    }
    EXPECT_EQ(leaf.num_vertices, distinct.size());
    Points points;
    for (std::uint32_t i = 0; i < 8u * static_cast<unsigned>(leaf.vertexChunks()); ++i) {
      points.push_back(vertex(leaf, i));
      EXPECT_TRUE(i < leaf.num_vertices || points[i] == points[leaf.num_vertices - 1u]);
    }
    return points;
  }

  const MeshIn<S>& shape_;
  const Tree& tree_;
  std::size_t nodes_seen_ = 0;
  std::vector<int> leaf_seen_;
  std::set<std::size_t> in_leaf_;  ///< triangles
};

}  // namespace kios::testing
