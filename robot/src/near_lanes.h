// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fcl/common/types.h>
#include "volume/lanes.h"

// Which boxes and balls may be near a ball: four at a time, in floats. Poses round to 2^-24 of
// their entries, and what is computed of them to less than 16 times that of the lengths |x|_1 from
// the world's origin and of the boxes' sizes: kRounding of these is added to the reach, so that
// nothing that is near is left out.

namespace kios::robot {

namespace near_lanes {
using lanes::Float4;
constexpr std::size_t kLanes = 4;
constexpr double kRounding = 0x1p-19;
constexpr double kLeast = 0x1p-60;  // squares underflow

/// Lengths beyond what floats hold square to infinity on both sides, which is near.
inline float toFloat(double x) { return static_cast<float>(std::clamp(x, -3e38, 3e38)); }

/// Calls visit(first + i) for each lane in which the squared distance isn't above the square of the
/// reach, in order, until one returns true.
template <typename Visit>
bool visitNear(Float4 square, Float4 reach, std::size_t first, std::size_t count,
               const Visit& visit) {
  const std::size_t here = std::min(kLanes, count - first);
  unsigned int near = ~lanes::bits(square > reach * reach) & ((1U << here) - 1);
  for (; near != 0; near &= near - 1) {
    if (visit(first + static_cast<std::size_t>(__builtin_ctz(near)))) return true;
  }
  return false;
}
}  // namespace near_lanes

/// Boxes that stand in the world.
class BoxLanes {
 public:
  /// Half sizes may be infinite. The box counts as near if it is within `margin` more.
  void add(const fcl::Transform3d& X_WB, const fcl::Vector3d& middle, const fcl::Vector3d& half,
           double margin) {
    const std::size_t lane = count_++ % near_lanes::kLanes;
    if (lane == 0) blocks_.emplace_back();
    Block& block = blocks_.back();
    const fcl::Vector3d center = X_WB * middle;
    double size = center.lpNorm<1>();
    for (int i = 0; i < 3; ++i) {
      block.center[i][lane] = near_lanes::toFloat(center[i]);
      block.half[i][lane] = near_lanes::toFloat(half[i]);
      if (std::isfinite(half[i])) size += half[i];
      for (int k = 0; k < 3; ++k) {
        block.axes[3 * i + k][lane] = near_lanes::toFloat(X_WB.linear()(k, i));
      }
    }
    block.margin[lane] =
        near_lanes::toFloat((margin + near_lanes::kRounding * size) * (1 + 0x1p-20));
  }

  /// Calls visit(number) for each box that may be within `reach` of a point, in the order in which
  /// they were added, until one returns true, which is returned.
  template <typename Visit>
  bool forNear(const fcl::Vector3d& point, double reach, const Visit& visit) const {
    using lanes::broadcast, lanes::load, lanes::Float4;
    const double grown = reach + near_lanes::kRounding * point.lpNorm<1>() + near_lanes::kLeast;
    const Float4 x = broadcast(near_lanes::toFloat(point[0])),
                 y = broadcast(near_lanes::toFloat(point[1])),
                 z = broadcast(near_lanes::toFloat(point[2])),
                 r = broadcast(near_lanes::toFloat(grown * (1 + 0x1p-20)));
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      const Float4 dx = x - load(block.center[0]), dy = y - load(block.center[1]),
                   dz = z - load(block.center[2]);
      Float4 square = broadcast(0);
      for (int axis = 0; axis < 3; ++axis) {
        const Float4 along = load(block.axes[3 * axis]) * dx + load(block.axes[3 * axis + 1]) * dy +
                             load(block.axes[3 * axis + 2]) * dz;
        const Float4 beyond = lanes::max(along, -along) - load(block.half[axis]);
        const Float4 out = lanes::max(beyond, broadcast(0));
        square += out * out;
      }
      const std::size_t first = b * near_lanes::kLanes;
      if (near_lanes::visitNear(square, r + load(block.margin), first, count_, visit)) return true;
    }
    return false;
  }

 private:
  struct Block {
    float center[3][near_lanes::kLanes] = {}, half[3][near_lanes::kLanes] = {},
          axes[9][near_lanes::kLanes] = {}, margin[near_lanes::kLanes] = {};
  };
  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

/// Balls of one configuration.
class BallLanes {
 public:
  void clear() { count_ = 0; }

  /// Calls visit(number) for each ball added before that may touch this one, as BoxLanes, and adds
  /// it. The radius may be infinite.
  template <typename Visit>
  bool add(const fcl::Vector3d& center, double radius, const Visit& visit) {
    using lanes::broadcast, lanes::load, lanes::Float4;
    const double grown =
        (radius + near_lanes::kRounding * center.lpNorm<1>()) * (1 + 0x1p-20) + near_lanes::kLeast;
    const float x = near_lanes::toFloat(center[0]), y = near_lanes::toFloat(center[1]),
                z = near_lanes::toFloat(center[2]), r = near_lanes::toFloat(grown);
    for (std::size_t b = 0; b * near_lanes::kLanes < count_; ++b) {
      const Block& block = blocks_[b];
      const Float4 dx = broadcast(x) - load(block.x), dy = broadcast(y) - load(block.y),
                   dz = broadcast(z) - load(block.z);
      const Float4 square = dx * dx + dy * dy + dz * dz;
      const std::size_t first = b * near_lanes::kLanes;
      if (near_lanes::visitNear(square, broadcast(r) + load(block.radius), first, count_, visit)) {
        return true;
      }
    }
    const std::size_t lane = count_ % near_lanes::kLanes, b = count_ / near_lanes::kLanes;
    if (b == blocks_.size()) blocks_.emplace_back();
    blocks_[b].x[lane] = x;
    blocks_[b].y[lane] = y;
    blocks_[b].z[lane] = z;
    blocks_[b].radius[lane] = r;
    ++count_;
    return false;
  }

 private:
  struct Block {
    float x[near_lanes::kLanes] = {}, y[near_lanes::kLanes] = {}, z[near_lanes::kLanes] = {},
          radius[near_lanes::kLanes] = {};
  };
  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

}  // namespace kios::robot
