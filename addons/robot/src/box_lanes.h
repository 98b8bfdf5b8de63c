// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fcl/common/types.h>
#include "volume/lanes.h"

namespace kios::robot {

/// Finds which boxes that stand in the world may be near a ball: four at a time, in floats. Poses
/// round to 2^-24 of their entries, and what is computed of them to less than 16 times that of the
/// lengths |x|_1 from the world's origin and of the boxes' sizes: kRounding of these is added to
/// the reach, so that nothing that is near is left out. X_WB's rotation is orthonormal to rounding.
class BoxLanes {
 public:
  /// Sets the box of a number, or of the next one. Half sizes may be infinite. The box counts as
  /// near if it is within `margin` more.
  void set(std::size_t number, const fcl::Transform3d& X_WB, const fcl::Vector3d& center,
           const fcl::Vector3d& half, double margin) {
    const std::size_t lane = number % kLanes;
    if (number == count_ && lane == 0) blocks_.emplace_back();
    count_ = std::max(count_, number + 1);
    Block& block = blocks_[number / kLanes];
    double size = center.lpNorm<1>();
    for (int i = 0; i < 3; ++i) {
      block.center[i][lane] = lanes::toFloat(center[i]);
      block.half[i][lane] = lanes::toFloat(half[i]);
      if (std::isfinite(half[i])) size += half[i];
      for (int k = 0; k < 3; ++k) {
        block.axes[3 * i + k][lane] = lanes::toFloat(X_WB.linear()(k, i));
      }
    }
    block.margin[lane] = lanes::toFloat((margin + kRounding * size) * (1 + 0x1p-20));
  }
  void removeLast() {
    if (--count_ % kLanes == 0) blocks_.pop_back();
  }

  /// Calls visit(number) for each box that may be within `reach` of a point, in the order of
  /// numbers, until one returns true, which is returned.
  template <typename Visit>
  bool forNear(const fcl::Vector3d& point, double reach, const Visit& visit) const {
    using lanes::broadcast, lanes::load, lanes::Float4;
    const double grown = reach + kRounding * point.lpNorm<1>() + kLeast;
    const Float4 x = broadcast(lanes::toFloat(point[0])), y = broadcast(lanes::toFloat(point[1])),
                 z = broadcast(lanes::toFloat(point[2])),
                 r = broadcast(lanes::toFloat(grown * (1 + 0x1p-20)));
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
      const Float4 near = r + load(block.margin);
      const std::size_t first = b * kLanes;
      const auto found = [&](std::size_t lane) { return visit(first + lane); };
      if (lanes::visitUnset(square > near * near, count_ - first, found)) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kLanes = 4;
  static constexpr double kRounding = 0x1p-19;
  static constexpr double kLeast = 0x1p-60;  ///< squares underflow

  struct Block {
    float center[3][kLanes] = {}, half[3][kLanes] = {}, axes[9][kLanes] = {}, margin[kLanes] = {};
  };
  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

}  // namespace kios::robot
