// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <fcl/common/types.h>
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios::articulated {

/// A box around an obstacle's content in the world; the whole world around an unbounded one.
struct ObstacleBox {
  double low[3], high[3];
  int body;
};

/// The boxes of obstacles, four a node in lanes.
class ObstacleTree {
 public:
  ObstacleTree() = default;
  explicit ObstacleTree(std::vector<ObstacleBox> boxes);

  /// Calls visit(body) for every box that is at most `far` from the point, and maybe for others
  /// that are farther by rounding alone, until it returns true, which is returned.
  template <typename Visit>
  bool forNear(const fcl::Vector3d& center, double far, const Visit& visit) const;

 private:
  static constexpr int kLanes = 4;
  struct Node {
    float low[3][kLanes], high[3][kLanes];  ///< rounded outwards
    int child[kLanes];                      ///< a node, or ~body
    unsigned int used = 0;                  ///< lanes, as bits
  };

  int build(std::vector<ObstacleBox>& boxes, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;  // the root is the first one
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
  // A node leaves at most three others behind, and halving by counts makes no tree deeper than 16.
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
