// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <fcl/common/types.h>

// Which boxes and balls may be near a ball: many at a time, in floats, of which compilers make
// lanes. Poses round to 2^-24 of their entries, and what is computed of them to less than 16 times
// that of the lengths |x|_1 from the world's origin and of the boxes' sizes: kRounding of these is
// added to the reach, so that nothing that is near is left out.

namespace kios::robot {

namespace near_lanes {
constexpr int kLanes = 8;
constexpr double kRounding = 0x1p-19;
constexpr double kLeast = 0x1p-60;  // squares underflow

/// Calls visit(first + i) for the lanes that are near, in order, until one returns true.
template <typename Visit>
bool visitNear(const int* near, std::size_t first, std::size_t count, const Visit& visit) {
  for (std::size_t i = 0; i < kLanes && first + i < count; ++i) {
    if (near[i] != 0 && visit(first + i)) return true;
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
      block.center[i][lane] = static_cast<float>(center[i]);
      block.half[i][lane] = static_cast<float>(half[i]);
      if (std::isfinite(half[i])) size += half[i];
      for (int k = 0; k < 3; ++k) {
        block.axes[3 * i + k][lane] = static_cast<float>(X_WB.linear()(k, i));
      }
    }
    block.margin[lane] =
        static_cast<float>((margin + near_lanes::kRounding * size) * (1 + 0x1p-20));
  }

  /// Calls visit(number) for each box that may be within `reach` of a point, in the order in which
  /// they were added, until one returns true, which is returned.
  template <typename Visit>
  bool forNear(const fcl::Vector3d& point, double reach, const Visit& visit) const {
    const double grown = reach + near_lanes::kRounding * point.lpNorm<1>() + near_lanes::kLeast;
    const float x = static_cast<float>(point[0]), y = static_cast<float>(point[1]),
                z = static_cast<float>(point[2]), r = static_cast<float>(grown * (1 + 0x1p-20));
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      int near[near_lanes::kLanes];
      for (int i = 0; i < near_lanes::kLanes; ++i) {
        const float dx = x - block.center[0][i], dy = y - block.center[1][i],
                    dz = z - block.center[2][i];
        const auto out = [&](int axis) {
          const float along = block.axes[3 * axis][i] * dx + block.axes[3 * axis + 1][i] * dy +
                              block.axes[3 * axis + 2][i] * dz;
          const float beyond = std::abs(along) - block.half[axis][i];
          return beyond > 0 ? beyond : 0.0F;
        };
        const float u = out(0), v = out(1), w = out(2), most = r + block.margin[i];
        near[i] = u * u + v * v + w * w > most * most ? 0 : 1;
      }
      if (near_lanes::visitNear(near, b * near_lanes::kLanes, count_, visit)) return true;
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
    const double grown =
        (radius + near_lanes::kRounding * center.lpNorm<1>()) * (1 + 0x1p-20) + near_lanes::kLeast;
    const float x = static_cast<float>(center[0]), y = static_cast<float>(center[1]),
                z = static_cast<float>(center[2]), r = static_cast<float>(grown);
    for (std::size_t b = 0; b * near_lanes::kLanes < count_; ++b) {
      const Block& block = blocks_[b];
      int near[near_lanes::kLanes];
      for (int i = 0; i < near_lanes::kLanes; ++i) {
        const float dx = x - block.x[i], dy = y - block.y[i], dz = z - block.z[i],
                    most = r + block.radius[i];
        near[i] = dx * dx + dy * dy + dz * dz > most * most ? 0 : 1;
      }
      if (near_lanes::visitNear(near, b * near_lanes::kLanes, count_, visit)) return true;
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
