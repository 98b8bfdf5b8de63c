// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/box_tree.h"

#include <algorithm>
#include <cmath>

namespace kios::scene {
namespace {

// Infinite boxes have no centre; they sort as if around the origin.
double centre(const Box& box, int axis) {
  const double sum = box.lower[axis] + box.upper[axis];
  return std::isfinite(sum) ? sum : 0.0;
}

}  // namespace

void BoxTree::build(std::vector<Leaf> leaves) {
  nodes_.clear();
  if (leaves.empty()) return;
  nodes_.reserve(2 * leaves.size() - 1);
  buildRange(leaves, 0, static_cast<int>(leaves.size()));
  built_cost_ = cost();
}

int BoxTree::buildRange(std::vector<Leaf>& leaves, int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin == 1) {
    const Leaf& leaf = leaves[begin];
    nodes_[index] = {leaf.box, -1, -1, leaf.object, 1, leaf.obstacle ? 0 : 1};
    return index;
  }
  double lower[3], upper[3];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = upper[axis] = centre(leaves[begin].box, axis);
    for (int i = begin + 1; i < end; ++i) {
      lower[axis] = std::min(lower[axis], centre(leaves[i].box, axis));
      upper[axis] = std::max(upper[axis], centre(leaves[i].box, axis));
    }
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (upper[other] - lower[other] > upper[axis] - lower[axis]) axis = other;
  }
  const int middle = (begin + end) / 2;
  std::nth_element(leaves.begin() + begin, leaves.begin() + middle, leaves.begin() + end,
                   [axis](const Leaf& a, const Leaf& b) {
                     const double ca = centre(a.box, axis), cb = centre(b.box, axis);
                     return ca != cb ? ca < cb : a.object < b.object;
                   });
  const int left = buildRange(leaves, begin, middle);
  const int right = buildRange(leaves, middle, end);
  Node& node = nodes_[index];
  node.left = left;
  node.right = right;
  node.count = nodes_[left].count + nodes_[right].count;
  node.bodies = nodes_[left].bodies + nodes_[right].bodies;
  node.box = nodes_[left].box;
  node.box.grow(nodes_[right].box);
  return index;
}

// The cost of a node is the number of others that its box meets, estimated by the sum of its sides.
double BoxTree::cost() const {
  double sum = 0;
  for (const Node& node : nodes_) {
    if (node.isLeaf()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = node.box.upper[axis] - node.box.lower[axis];
      if (std::isfinite(side)) sum += side;
    }
  }
  return sum;
}

}  // namespace kios::scene
