// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "fcl_kios/scene/scene_distance.h"
#include "scene/body.h"
#include "scene/body_pair.h"
#include "scene/box_tree.h"
#include "scene/near_list.h"
#include "scene/pair_memory.h"

namespace kios::scene {

/// Holds the bodies of a SceneDistance, and its queries.
template <typename S>
class Scene {
 public:
  int add(Body<S> body);
  void remove(int id);
  /// Throws std::invalid_argument if there is no such body.
  Body<S>& body(int id);
  bool contains(int id) const {
    return id >= 0 && id < static_cast<int>(bodies_.size()) && bodies_[id].used();
  }
  std::size_t size() const { return bodies_.size() - free_.size(); }
  void exclude(int a, int b, bool excluded);

  std::optional<ScenePair<S>> closestPair(const SceneRequest& request);
  std::vector<ScenePair<S>> pairsWithin(S margin, const SceneRequest& request);
  std::vector<ScenePair<S>> clearances(const SceneRequest& request);

  typename SceneDistance<S>::Filter filter;
  SceneCounts counts;
  PairMemory<S> memory{SceneDistance<S>::kMaxRemembered};

 private:
  using Answer = typename BodyPair<S>::Answer;

  void beginQuery();
  void updateTree();
  bool admissible(int a, int b) const;
  bool obstacles(int a, int b) const {
    return bodies_[a].role == Role::kObstacle && bodies_[b].role == Role::kObstacle;
  }
  BodyPair<S> pairOf(int a, int b) { return {a, bodies_[a], b, bodies_[b], memory}; }
  /// Calls visit(node, node) for the children of a pair of parts of the tree, or of one part with
  /// itself, which are not both full of obstacles.
  template <typename Visit>
  void forChildren(int n, int m, const Visit& visit);
  /// Calls visit(a, b, squared gap of their boxes) for every pair a < b, not both obstacles, that
  /// may be within the limit.
  template <typename Visit>
  void forNearPairs(double limit, const Visit& visit);
  /// Returns a gap of two objects' boxes that is exceeded only if the narrow phase computes more
  /// than the limit.
  double gapOf(double limit) const { return limit / box_share_; }
  /// Returns a lower bound of that, roundings covered.
  double boxBound(double square) const {
    return square < 0x1p1000 ? std::sqrt(square) * box_share_ * (1 - 0x1p-40) : 0x1p499;
  }
  ScenePair<S> report(int a, int b, const Answer& answer, const SceneRequest& request) const;

  std::vector<Body<S>> bodies_;  // by id
  std::set<int> free_;           // ids below that are free
  std::unordered_set<std::uint64_t> excluded_;
  BoxTree tree_;
  bool tree_stale_ = true;  // bodies were added or removed
  NearList near_;
  double box_share_ = 1;
  long long num_obstacles_ = 0;
  std::pair<int, int> last_closest_{-1, -1};
};

}  // namespace kios::scene
