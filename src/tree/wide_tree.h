// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tree/tree.h"

namespace kios::engine {

/// A node of a binary tree over ranges of triangles.
struct BinaryNode {
  int first, count;
  int left = -1;   ///< its right child follows; -1: a leaf
  float size = 0;  ///< of inner nodes: a length
  int volume = 0;  ///< which of the model's nodes it is

  bool isLeaf() const { return left < 0; }
};

/// Chooses the nodes of a binary tree that become nodes of the wide tree.
class Collapse {
 public:
  /// Minimises the sum of size^1.5 over the blocks that a query may have to test, by dynamic
  /// programming bottom-up over the number of roots that a subtree is dissolved into.
  explicit Collapse(const std::vector<BinaryNode>& nodes);

  /// The up to kLanes nodes that become the children of inner node n.
  void children(int n, std::vector<int>& out) const;

 private:
  void dissolve(int n, int roots, std::vector<int>& out) const;

  const std::vector<BinaryNode>& nodes_;
  struct Costs {
    float at_most[kLanes + 1] = {};       ///< [i]: as at most i nodes
    unsigned char left[kLanes + 1] = {};  ///< [i]: how many of i nodes are under the left child
  };
  std::vector<Costs> costs_;
};

}  // namespace kios::engine
