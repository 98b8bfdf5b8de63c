// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scene/box.h"

namespace kios::scene {

/// Holds a binary tree of boxes over objects, one a leaf, built by halving the
/// centres along the longest side and refitted while objects move.
class BoxTree {
 public:
  struct Node {
    Box box;
    int left = -1, right = -1;  ///< nodes, above this one's index; -1 at a leaf
    int object = -1;            ///< of a leaf
    int count = 0;              ///< leaves below
    int bodies = 0;             ///< of them, those that are no obstacles

    bool isLeaf() const { return object >= 0; }
    /// Returns pairs of objects below, and those with an object below `o`, another part of the
    /// tree.
    long long pairs() const { return static_cast<long long>(count) * (count - 1) / 2; }
    long long pairsWith(const Node& o) const { return static_cast<long long>(count) * o.count; }
  };

  struct Leaf {
    int object;
    Box box;
    bool obstacle;
  };

  /// Node 0 is the root, if there is any.
  const std::vector<Node>& nodes() const { return nodes_; }
  const Node& operator[](int node) const { return nodes_[node]; }

  void build(std::vector<Leaf> leaves);

  /// Takes new boxes by object. Returns false if the tree has become so bad that it should be built
  /// anew.
  template <typename BoxOf>
  bool refit(const BoxOf& box_of) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      if (node.isLeaf()) {
        node.box = box_of(node.object);
      } else {
        node.box = nodes_[node.left].box;
        node.box.grow(nodes_[node.right].box);
      }
    }
    constexpr double kWorn = 1.5;
    return !(cost() > kWorn * built_cost_);
  }

 private:
  int buildRange(std::vector<Leaf>& leaves, int begin, int end);
  double cost() const;

  std::vector<Node> nodes_;
  double built_cost_ = 0;
};

}  // namespace kios::scene
