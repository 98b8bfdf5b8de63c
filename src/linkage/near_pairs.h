// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "linkage/body_queries.h"
#include "volume/ball_lanes.h"
#include "volume/rounding.h"

namespace kios::articulated {

/// Finds the pairs of a linkage that its balls and boxes don't prove apart.
class NearPairs {
 public:
  /// Calls visit(pair) for every pair that may be within `distance` of each other at most `time` to
  /// both sides of a configuration.
  template <typename Visit>
  void forEach(const Path& path, const Configuration& c, double distance, double time,
               const Visit& visit) {
    const Linkage::Impl& linkage = path.linkage();
    const ObstacleTree& obstacles = linkage.obstacles;
    balls_.clear();
    for (const CarriedBody& carried : linkage.carried) {
      const int id = carried.body;
      const BodyData& body = linkage.bodies[id];
      const Eigen::Vector3d& center = c.center(id);
      // How far the body moves is measured only where something is near enough to need it.
      const double swept = !body.bounded ? kInfinity : time > 0 ? time * path.swept(id, 0) : 0;
      const double reach = body.content.radius + swept;
      if (body.meets) {
        const double still = distance + body.content.radius + path.padOfObstacles(id);
        const auto found = [&](int obstacle) {
          if (linkage.bodies[obstacle].ignores(id)) {
            return false;
          }
          visit(Pair{std::min(id, obstacle), std::max(id, obstacle), 0});
          return false;
        };
        if (!(swept > 0) || !body.bounded) {
          obstacles.forNear(center, still + swept, found);
        } else if (obstacles.forNear(center, still + swept, [](int /*body*/) { return true; })) {
          obstacles.forNear(center, still + c.motion(id, 0).during(time), found);
        }
      }
      balls_.add(center, 0.5 * distance + reach + path.padShare(id), [&](std::size_t slot) {
        const int shared = carried.shared[slot], other = linkage.carried[slot].body;
        if (shared == CarriedBody::kNever) return false;
        const Pair pair{std::min(id, other), std::max(id, other), shared};
        if (!(time > 0 && apart(path, c, pair, distance, time))) visit(pair);
        return false;
      });
    }
  }

 private:
  /// Tells two bodies on links apart, by the motion of one against the other.
  static bool apart(const Path& path, const Configuration& c, const Pair& pair, double distance,
                    double time) {
    const BodyData &a = path.linkage().bodies[pair.a], &b = path.linkage().bodies[pair.b];
    if (!a.bounded || !b.bounded) return false;
    const double still = distance + a.content.radius + b.content.radius + path.pad(pair.a, pair.b);
    const double square = (c.center(pair.a) - c.center(pair.b)).squaredNorm();
    const auto isFarther = [&](double moved) { return square > (still + moved) * (still + moved); };
    const double swept = path.swept(pair.a, pair.shared) + path.swept(pair.b, pair.shared);
    return isFarther(time * swept) ||
           (swept > 0 && isFarther(c.motion(pair.a, pair.shared).during(time) +
                                   c.motion(pair.b, pair.shared).during(time)));
  }

  BallLanes balls_;
};

}  // namespace kios::articulated
