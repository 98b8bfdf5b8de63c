// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios {

/// Compares balls of one frame with each other, four at a time, in floats. Radii are grown by what
/// rounds: 2^-24 of coordinates in the centre, less than 2^-21 relatively in the rest, and squares
/// that underflow.
class BallLanes {
 public:
  void clear() { count_ = 0; }

  /// Calls visit(index) for every ball added before that may touch this one, in that order, until
  /// it returns true, which is returned; else adds the ball. The radius may be infinite.
  template <typename Visit>
  bool add(const Eigen::Vector3d& center, double radius, const Visit& visit) {
    using lanes::Float4;
    constexpr std::size_t kLanes = 4;
    const double grown = (radius + 0x1p-23 * center.lpNorm<1>()) * (1 + 0x1p-20) + 0x1p-60;
    const float ball[4] = {lanes::toFloat(center[0]), lanes::toFloat(center[1]),
                           lanes::toFloat(center[2]), roundUp<float>(grown)};
    for (std::size_t first = 0; first < count_; first += kLanes) {
      const float* const block = &rows_[4 * first];
      Float4 square = lanes::broadcast(0);
      for (std::size_t i = 0; i < 3; ++i) {
        const Float4 off = lanes::load(block + kLanes * i) - lanes::broadcast(ball[i]);
        square += off * off;
      }
      const Float4 reach = lanes::load(block + 3 * kLanes) + lanes::broadcast(ball[3]);
      const auto touching = [&](std::size_t lane) { return visit(first + lane); };
      if (lanes::visitUnset(square > reach * reach, count_ - first, touching)) return true;
    }
    if (4 * count_ == rows_.size()) rows_.resize(rows_.size() + 4 * kLanes);
    float* const block = &rows_[4 * (count_ - count_ % kLanes)];
    for (std::size_t i = 0; i < 4; ++i) block[kLanes * i + count_ % kLanes] = ball[i];
    ++count_;
    return false;
  }

 private:
  std::vector<float> rows_;  // x, y, z and radius of four balls, then those of the next four
  std::size_t count_ = 0;
};

}  // namespace kios
