// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "linkage/body_queries.h"
#include "volume/rounding.h"

namespace kios::articulated {

/// Balls in lanes of floats. Radii are grown by what rounds: 2^-24 of coordinates in the centre,
/// less than 2^-21 relatively in the rest, and squares that underflow.
class BallLanes {
 public:
  void clear() { count_ = 0; }

  /// Calls visit(index) for every ball added before that may touch this one, and adds it.
  template <typename Visit>
  void add(const Eigen::Vector3d& center, double radius, const Visit& visit) {
    using lanes::Float4;
    constexpr std::size_t kLanes = 4;
    const double grown = (radius + 0x1p-23 * center.lpNorm<1>()) * (1 + 0x1p-20) + 0x1p-60;
    const float ball[4] = {static_cast<float>(center[0]), static_cast<float>(center[1]),
                           static_cast<float>(center[2]), roundUp<float>(grown)};
    for (std::size_t first = 0; first < count_; first += kLanes) {
      const float* const block = &rows_[4 * first];
      Float4 square = lanes::broadcast(0);
      for (std::size_t i = 0; i < 3; ++i) {
        const Float4 off = lanes::load(block + kLanes * i) - lanes::broadcast(ball[i]);
        square += off * off;
      }
      const Float4 reach = lanes::load(block + 3 * kLanes) + lanes::broadcast(ball[3]);
      const std::size_t here = std::min(kLanes, count_ - first);
      unsigned int near = ~lanes::bits(square > reach * reach) & ((1U << here) - 1);
      for (; near != 0; near &= near - 1) {
        visit(first + static_cast<std::size_t>(__builtin_ctz(near)));
      }
    }
    if (4 * count_ == rows_.size()) rows_.resize(rows_.size() + 4 * kLanes);
    float* const block = &rows_[4 * (count_ - count_ % kLanes)];
    for (std::size_t i = 0; i < 4; ++i) block[kLanes * i + count_ % kLanes] = ball[i];
    ++count_;
  }

 private:
  std::vector<float> rows_;  // x, y, z and radius of four balls, then those of the next four
  std::size_t count_ = 0;
};

/// Finds the pairs of a linkage that its balls and boxes don't prove apart.
class NearPairs {
 public:
  /// Calls visit(pair) for every pair that may be within `distance` of each other at most `time` to
  /// both sides of a configuration, until it has visited more than `most`.
  template <typename Visit>
  void forEach(const Path& path, const Configuration& c, double distance, double time,
               std::size_t most, const Visit& visit) {
    const Linkage::Impl& linkage = path.linkage();
    const ObstacleTree& obstacles = linkage.obstacle_tree.of(linkage.obstacles);
    balls_.clear();
    std::size_t visited = 0;
    for (const CarriedBody& carried : linkage.carried) {
      if (visited > most) return;
      const int id = carried.body;
      const BodyData& body = linkage.bodies[id];
      const Eigen::Vector3d& center = c.center(id);
      const double moved = time > 0 ? c.motion(id, 0).during(time) : 0;
      const double reach = body.bounded ? body.content.radius + moved : kInfinity;
      if (body.meets) {
        obstacles.forNear(center, distance + reach + path.padOfObstacles(id), [&](int obstacle) {
          if (!std::binary_search(carried.allowed.begin(), carried.allowed.end(), obstacle)) {
            ++visited;
            visit(Pair{std::min(id, obstacle), std::max(id, obstacle), 0});
          }
        });
      }
      balls_.add(center, 0.5 * distance + reach + path.padShare(id), [&](std::size_t slot) {
        const int shared = carried.shared[slot], other = linkage.carried[slot].body;
        if (shared == CarriedBody::kNever) return;
        const Pair pair{std::min(id, other), std::max(id, other), shared};
        if (time > 0 && apart(path, c, pair, distance, time)) return;
        ++visited;
        visit(pair);
      });
    }
  }

 private:
  /// Tells two bodies on links apart, by the motion of one against the other.
  static bool apart(const Path& path, const Configuration& c, const Pair& pair, double distance,
                    double time) {
    const BodyData &a = path.linkage().bodies[pair.a], &b = path.linkage().bodies[pair.b];
    if (!a.bounded || !b.bounded) return false;
    const double least = distance + a.content.radius + b.content.radius + path.pad(pair.a, pair.b) +
                         c.motion(pair.a, pair.shared).during(time) +
                         c.motion(pair.b, pair.shared).during(time);
    return (c.center(pair.a) - c.center(pair.b)).squaredNorm() > least * least;
  }

  BallLanes balls_;
};

}  // namespace kios::articulated
