// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "model/prepared.h"
#include "query/mesh_pair.h"
#include "search/mesh_search.h"
#include "volume/rounding.h"

namespace kios {

/// Looks for the nearest triangles of two models without the engine, which would name the same:
/// keeps every pair that rounding may make the nearest, and lets the engine's evaluation of their
/// features decide.
template <typename S>
class NearestCandidates {
 public:
  /// Pairs as far as `far_enough` don't matter.
  NearestCandidates(const MeshPair<S>& frame, double far_enough)
      : frame_(frame), cull_distance_(withRounding(far_enough)) {
    near_.reserve(8);
  }

  /// Pairs farther than this don't matter.
  double cullDistance() const { return cull_distance_; }
  bool touching() const { return best_ == 0; }

  /// True if the triangles touch, which ends a search.
  bool test(const engine::TrianglePairIds& ids) {
    const TriangleDistance<S> found = frame_.distanceOf(ids);
    const double distance = double{found.distance};
    if (!(distance <= cull_distance_)) return false;
    near_.push_back({ids, distance});
    if (distance < best_) {
      best_ = distance;
      best_ids_ = ids;
      nearest_ = found;
      cull_distance_ = std::min(cull_distance_, withRounding(distance));
    }
    return distance == 0;
  }

  /// Names the first that were tested, where triangles touch.
  engine::PairAnswer<S> answer() const {
    engine::PairAnswer<S> answer;
    if (near_.empty()) return answer;
    answer.ids = best_ids_;
    answer.nearest = nearest_;
    if (touching()) return answer;
    std::vector<engine::TrianglePairIds> nearest;
    for (const Found& found : near_) {
      if (found.distance <= cull_distance_) nearest.push_back(found.ids);
    }
    if (nearest.size() == 1) return answer;
    answer.ids = engine::nearestOfThese(nearest, viewOf(frame_.a), viewOf(frame_.b), frame_.X_AB);
    answer.nearest = frame_.distanceOf(answer.ids);
    return answer;
  }

 private:
  struct Found {
    engine::TrianglePairIds ids;
    double distance;
  };

  /// Both this distance and that of other triangles or of their features, which decide between
  /// equals, may be off by 32 u and 64 u of the extents (error_bounds.h): kernelError() is 32 u.
  double withRounding(double distance) const {
    return distance < kInfinity ? distance + 8 * frame_.kernelError(distance) : kInfinity;
  }

  const MeshPair<S>& frame_;
  std::vector<Found> near_;
  double best_ = kInfinity, cull_distance_;
  engine::TrianglePairIds best_ids_;
  TriangleDistance<S> nearest_ = {};  ///< of these
};

}  // namespace kios
