// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/node_layout.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tree/leaf_layout.h"
#include "tree/tuning.h"
#include "volume/balls.h"
#include "volume/large_arrays.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

float widthOf(const Tree& tree, const Leaf& leaf) {
  const Eigen::Vector3f centroid(leaf.centroid[0], leaf.centroid[1], leaf.centroid[2]);
  const auto fromCentroid = [&](int i) -> Eigen::Vector3f {
    return vertexOf(tree, leaf, i) - centroid;
  };
  Eigen::Vector3f along = Eigen::Vector3f::Zero();
  float farthest = 0;
  for (int i = 0; i < leaf.num_vertices; ++i) {
    const Eigen::Vector3f v = fromCentroid(i);
    const float square = v.squaredNorm();
    if (!(square > farthest)) continue;
    farthest = square;
    along = v;
  }
  if (!(farthest > 0)) return 0;
  along /= std::sqrt(farthest);
  float widest = 0;
  for (int i = 0; i < leaf.num_vertices; ++i) {
    const Eigen::Vector3f v = fromCentroid(i);
    widest = std::max(widest, (v - v.dot(along) * along).squaredNorm());
  }
  return std::sqrt(widest);
}

}  // namespace

void writeSpheres(const Eigen::Vector3f (&centers)[kSphereRows], const double (&radii)[kSphereRows],
                  Node& node) {
  float* const rows[3] = {node.x, node.y, node.z};
  for (int c = 0; c < 3; ++c) rows[c][kCentral] = centers[0][c];
  node.r[kCentral] = node.size = roundUpFloat(radii[0]);
  for (int pair = 0; pair < 2; ++pair) {
    const int middle = pair == 0 ? kMiddle2 : kMiddle1, half = middle + 1;
    const int plus = 1 + 2 * pair, minus = plus + 1;
    double shift = 0;  // of either centre by the rounding of middle and half, in the 1-norm
    for (int c = 0; c < 3; ++c) {
      const double p = centers[plus][c], m = centers[minus][c];
      rows[c][middle] = roundedTo<float>(0.5 * (p + m));
      rows[c][half] = roundedTo<float>(0.5 * (p - m));
      const double sum = double{rows[c][middle]} + rows[c][half];
      const double difference = double{rows[c][middle]} - rows[c][half];
      shift += std::max(std::abs(sum - p), std::abs(difference - m));
    }
    // The half difference rounds by at most 2^-24 of itself, which the middle takes.
    const double sum = radii[plus] + radii[minus], difference = radii[plus] - radii[minus];
    node.r[half] = roundedTo<float>(0.5 * difference);
    node.r[middle] = roundUpFloat(0.5 * sum + shift + kUlpFloat * 0.5 * std::abs(difference));
  }
}

void writeLane(const Node& node, int lane, Block& block) {
  for (int row = 0; row < kSphereRows; ++row) {
    block.x[row].v[lane] = node.x[row];
    block.y[row].v[lane] = node.y[row];
    block.z[row].v[lane] = node.z[row];
    block.r[row].v[lane] = node.r[row];
  }
}

void fillBlock(const Node& node, Tree& tree) {
  Block& block = tree.blocks[static_cast<std::size_t>(node.child)];
  const int count = tree.children[static_cast<std::size_t>(node.child)].count;
  for (int lane = 0; lane < kLanes; ++lane) {
    writeLane(tree.nodes[node.first_child + (lane < count ? lane : 0)], lane, block);
  }
}

void writeBoxBlocks(Tree& tree) {
  reserveLarge(tree.box_blocks, tree.children.size());
  tree.box_blocks.resize(tree.children.size());
  for (const Node& node : tree.nodes) {
    if (node.isLeaf()) continue;
    const auto at = static_cast<std::size_t>(node.child);
    BoxBlock& block = tree.box_blocks[at];
    tree.children[at].flat = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool used = lane < tree.children[at].count;
      const std::size_t child = node.first_child + static_cast<std::uint32_t>(used ? lane : 0);
      if (used) tree.children[at].flat |= static_cast<std::uint8_t>(tree.nodes[child].flat << lane);
      const Box& box = tree.boxes[child];
      for (int column = 0; column < kBoxColumns; ++column) {
        block.x[column].v[lane] = box.x[column];
        block.y[column].v[lane] = box.y[column];
        block.z[column].v[lane] = box.z[column];
      }
      for (int axis = 0; axis < 3; ++axis) block.half[axis].v[lane] = box.half[axis];
    }
  }
}

bool isFlat(const Box& box) {
  const auto [least, largest] = std::minmax({box.half[0], box.half[1], box.half[2]});
  return least < tuning::kFlat * largest;
}

float reachOf(const Node& node) {
  const auto length = [&](int row) { return norm(node.x[row], node.y[row], node.z[row]); };
  const auto pair = [&](int middle) {
    return length(middle) + length(middle + 1) + double{node.r[middle]} +
           std::abs(double{node.r[middle + 1]});
  };
  return roundUpFloat(
      std::max({length(kCentral) + double{node.r[kCentral]}, pair(kMiddle2), pair(kMiddle1)}) *
      (1 + 8 * kUlpDouble));
}

double searchCost(const Tree& tree) {
  const double unit = tree.nodes[0].size > 0 ? 1 / double{tree.nodes[0].size} : 0;
  double sum = 0;
  for (const Node& node : tree.nodes) {
    const double size = node.size * unit;
    sum += size * std::sqrt(size);
  }
  return sum;
}

void measureLeaves(Tree& tree) {
  double sum = 0;
  tree.widest_leaf = 0;
  for (Node& node : tree.nodes) {
    if (!node.isLeaf()) continue;
    node.width = widthOf(tree, tree.leaves[node.leaf()]);
    sum += double{node.size};
    tree.widest_leaf = std::max(tree.widest_leaf, node.width);
  }
  tree.mean_leaf = roundedTo<float>(sum / static_cast<double>(tree.leaves.size()));
}

}  // namespace kios::engine
