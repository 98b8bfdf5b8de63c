// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "fcl_kios/scene.h"
#include "scene/body.h"
#include "scene/body_pair.h"
#include "scene/box_tree.h"
#include "scene/near_list.h"
#include "scene/pair_memory.h"

namespace kios::scene {

/// Holds the bodies of a SceneDistance, and its queries.
class Scene {
 public:
  using Filter = std::function<bool(int a, int b)>;

  int add(Body body, Role role);
  void remove(int id);
  /// Throws std::invalid_argument if there is no such body.
  Body& body(int id);
  bool contains(int id) const {
    return id >= 0 && id < static_cast<int>(bodies_.size()) && bodies_[id].used();
  }
  std::size_t size() const { return bodies_.size() - free_.size(); }
  void ignorePair(int a, int b, bool ignored);

  std::optional<ScenePaird> closestPair(const SceneRequest& request);
  /// Without a limit boxes aren't looked at.
  std::vector<ScenePaird> pairsWithin(double margin, const SceneRequest& request);

  Filter filter;
  SceneCounts counts;
  PairMemory memory{SceneDistanced::kMaxRemembered};

 private:
  using Answer = BodyPair::Answer;

  void beginQuery();
  void updateTree();
  bool admissible(int a, int b) const;
  BodyPair pairOf(int a, int b) { return {a, bodies_[a], b, bodies_[b], memory}; }
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
  ScenePaird report(int a, int b, const Answer& answer, const SceneRequest& request) const;

  std::vector<Body> bodies_;  // by id
  std::set<int> free_;        // ids below that are free
  std::unordered_set<std::uint64_t> excluded_;
  BoxTree tree_;
  bool tree_stale_ = true;  // bodies were added or removed
  NearList near_;
  double box_share_ = 1;
  long long num_obstacles_ = 0;
  std::pair<int, int> last_closest_{-1, -1};
};

}  // namespace kios::scene
