// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include <fcl/common/types.h>
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::articulated {

/// A box around an obstacle's content in the world; the whole world around an unbounded one.
struct ObstacleBox {
  double low[3], high[3];
  int body;
  double length = 0;  ///< how far the obstacle reaches from the world's origin
};

/// The boxes of obstacles, four a node in lanes. It may change: a box comes to the lane that grows
/// least of those that don't hold most boxes, and the tree is built anew by one that comes once
/// half as many came or went as it holds.
class ObstacleTree {
 public:
  ObstacleTree() = default;
  explicit ObstacleTree(const std::vector<ObstacleBox>& boxes) {
    for (const ObstacleBox& box : boxes) insert(box);
  }

  /// The body must not be there.
  void insert(const ObstacleBox& box);
  bool remove(int body);  ///< false if it isn't there
  long long size() const { return size_; }
  /// The largest length.
  double farthest() const { return lengths_.empty() ? 0 : *lengths_.rbegin(); }

  /// Calls visit(body) for every box that is at most `far` from the point, and maybe for others
  /// that are farther by rounding alone, until it returns true, which is returned.
  template <typename Visit>
  bool forNear(const fcl::Vector3d& center, double far, const Visit& visit) const;

 private:
  static constexpr int kLanes = 4;
  static constexpr int kDeepest = 20;  ///< for forNear(), where a level leaves three nodes behind
  struct Box {
    float low[3], high[3];  ///< rounded outwards
    double length;
    int place = -1;  ///< node * kLanes + lane; -1: not there
  };
  struct Node {
    float low[3][kLanes], high[3][kLanes];
    int count[kLanes];      ///< of boxes
    int child[kLanes];      ///< a node, or ~body
    unsigned int used = 0;  ///< lanes, as bits
    int parent = -1;        ///< its lane, as a place; -1: the root

    Node() {
      for (int lane = 0; lane < kLanes; ++lane) clear(lane);
    }
    void clear(int lane);
  };
  /// The lane of a full node that another box comes to.
  static int laneFor(const Node& node, const Box& added);
  int addNode(int parent);
  /// Puts a body into the first lane that is free.
  void put(int body, int node);
  void gather(int place);  ///< sets a lane's box to that of its node's lanes
  void refit(int node);    ///< does so above a node
  void rebuild();
  /// Builds a node of bodies, and returns it.
  int build(int* begin, int* end, int parent);
  int* halve(int* begin, int* end) const;

  std::vector<Box> boxes_;   // by body
  std::vector<Node> nodes_;  // the root is the first one
  long long size_ = 0, changes_ = 0;
  std::multiset<double> lengths_;
};

template <typename Visit>
bool ObstacleTree::forNear(const fcl::Vector3d& center, double far, const Visit& visit) const {
  using lanes::Float4;
  if (nodes_.empty()) return false;
  // The point rounds by 2^-24 of its coordinates, differences, squares and sums by less than 2^-21
  // relatively, and squares that underflow by less than the least normal number. Points beyond all
  // floats are moved in, nearer to everything.
  const double reach = far + 0x1p-23 * center.lpNorm<1>();
  const Float4 zero = lanes::broadcast(0),
               limit = lanes::broadcast(roundUp<float>(reach * reach * (1 + 0x1p-20) + 0x1p-126));
  int waiting[64] = {0};
  for (int count = 1; count > 0;) {
    const Node& node = nodes_[waiting[--count]];
    Float4 square = zero;
    for (int i = 0; i < 3; ++i) {
      const Float4 p = lanes::broadcast(lanes::toFloat(center[i]));
      const Float4 off = lanes::max(p - lanes::load(node.high[i]), lanes::load(node.low[i]) - p);
      const Float4 outside = lanes::max(off, zero);
      square += outside * outside;
    }
    for (unsigned int near = ~lanes::bits(square > limit) & node.used; near != 0;
         near &= near - 1) {
      const int child = node.child[__builtin_ctz(near)];
      if (child >= 0) {
        waiting[count++] = child;
      } else if (visit(~child)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace kios::articulated
