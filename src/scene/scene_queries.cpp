// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <queue>

#include "scene/scene.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

/// Holds two parts of the tree, or two bodies, whose distances are at least `bound`.
struct Waiting {
  double bound;
  int a, b;
  enum class Kind { kNodes, kBodies } kind;
  PairBound::Source source;

  bool operator<(const Waiting& o) const { return bound > o.bound; }  // the least is on top
};

class Queue : public std::priority_queue<Waiting> {
 public:
  double leastBound() const { return empty() ? kInfinity : top().bound; }
  /// Lists those that wait, in any order.
  const std::vector<Waiting>& items() const { return c; }
};

}  // namespace

template <typename Visit>
void Scene::forChildren(int n, int m, const Visit& visit) {
  const auto visitPair = [&](int i, int j) {
    const BoxTree::Node &a = tree_[i], &b = tree_[j];
    if (i == j && a.isLeaf()) return;
    if (a.bodies + b.bodies == 0) {
      counts.filtered += i == j ? a.pairs() : a.pairsWith(b);
    } else {
      visit(i, j);
    }
  };
  const BoxTree::Node &a = tree_[n], &b = tree_[m];
  if (n == m) {
    visitPair(a.left, a.left);
    visitPair(a.right, a.right);
    visitPair(a.left, a.right);
  } else if (b.isLeaf() || (!a.isLeaf() && a.count >= b.count)) {
    visitPair(a.left, m);
    visitPair(a.right, m);
  } else {
    visitPair(n, b.left);
    visitPair(n, b.right);
  }
}

template <typename Visit>
void Scene::forNearPairs(double limit, const Visit& visit) {
  const double gap = gapOf(limit), gap_limit = squaredLimit(gap);
  const auto visitIfNear = [&](int a, int b) {
    const double square = squaredGap(bodies_[a].box, bodies_[b].box);
    if (square > gap_limit) {
      ++counts.far_boxes;
    } else {
      visit(a, b, square);
    }
  };
  if (!(limit < kInfinity)) {
    const int end = static_cast<int>(bodies_.size());
    for (int a = 0; a < end; ++a) {
      for (int b = a + 1; bodies_[a].used() && b < end; ++b) {
        if (bodies_[b].used()) visit(a, b, 0.0);
      }
    }
    return;
  }
  if (near_.covers(gap)) {
    const auto listed = static_cast<long long>(near_.pairs().size());
    const long long of_obstacles = num_obstacles_ * (num_obstacles_ - 1) / 2;
    counts.filtered += of_obstacles;
    counts.far_boxes += counts.total - of_obstacles - listed;
    for (const auto& [a, b] : near_.pairs()) visitIfNear(a, b);
    return;
  }

  const double reach = near_.startFor(gap, bodies_);
  bool listing = reach > gap;
  updateTree();
  if (tree_.nodes().size() < 2) {
    near_.finish();
    return;
  }
  const double reach_limit = squaredLimit(reach);
  std::vector<std::pair<int, int>> stack = {{0, 0}};
  const auto push = [&](int n, int m) {
    const BoxTree::Node &a = tree_[n], &b = tree_[m];
    if (n != m && squaredGap(a.box, b.box) > (listing ? reach_limit : gap_limit)) {
      counts.far_boxes += a.pairsWith(b);
    } else if (n != m && a.isLeaf() && b.isLeaf()) {
      const auto [low, high] = std::minmax({a.object, b.object});
      if (listing) listing = near_.add(low, high);
      visitIfNear(low, high);
    } else {
      stack.emplace_back(n, m);
    }
  };
  while (!stack.empty()) {
    const auto [n, m] = stack.back();
    stack.pop_back();
    forChildren(n, m, push);
  }
  near_.finish();
}

ScenePaird Scene::report(int a, int b, const Answer& answer, const SceneRequest& request) const {
  ScenePaird pair;
  pair.a = a;
  pair.b = b;
  pair.distance = answer.distance;
  pair.triangle_a = answer.triangle_a;
  pair.triangle_b = answer.triangle_b;
  if (request.nearest_points) nearestPoints(bodies_[a], bodies_[b], pair);
  return pair;
}

// Best first: the pair with the least bound is next, and the search ends when that exceeds the
// best distance so far.
std::optional<ScenePaird> Scene::closestPair(const SceneRequest& request) {
  beginQuery();
  bool found = false;
  std::pair<int, int> best;
  Answer nearest;
  double limit = kInfinity;  // pairs farther than that don't matter
  const auto [last_a, last_b] = last_closest_;
  if (contains(last_a) && contains(last_b) && admissible(last_a, last_b)) {
    limit = std::min(limit, pairOf(last_a, last_b).ceiling());
  }

  Queue queue;
  const auto enqueuePair = [&](int a, int b, double square) {
    queue.push({boxBound(square), a, b, Waiting::Kind::kBodies, PairBound::Source::kNothing});
  };
  const auto enqueue = [&](int n, int m) {
    const BoxTree::Node &a = tree_[n], &b = tree_[m];
    const double square = n == m ? 0 : squaredGap(a.box, b.box);
    if (square > squaredLimit(gapOf(limit))) {
      counts.far_boxes += a.pairsWith(b);
    } else if (n != m && a.isLeaf() && b.isLeaf()) {
      const auto [low, high] = std::minmax({a.object, b.object});
      enqueuePair(low, high, square);
    } else {
      queue.push({boxBound(square), n, m, Waiting::Kind::kNodes, PairBound::Source::kNothing});
    }
  };
  if (limit < kInfinity) {
    forNearPairs(limit, enqueuePair);
  } else {
    updateTree();
    if (tree_.nodes().size() > 1) enqueue(0, 0);
  }

  while (!queue.empty() && !(queue.leastBound() > limit)) {
    const Waiting next = queue.top();
    queue.pop();
    if (next.kind == Waiting::Kind::kNodes) {
      forChildren(next.a, next.b, enqueue);
      continue;
    }
    const std::pair<int, int> ids(next.a, next.b);
    if (next.source == PairBound::Source::kNothing && !admissible(next.a, next.b)) {
      ++counts.filtered;
      continue;
    }
    BodyPair pair = pairOf(next.a, next.b);
    const double matters =
        found && best < ids ? std::nextafter(nearest.distance, -kInfinity) : limit;
    std::optional<Answer> answer;
    if (next.source == PairBound::Source::kNothing) {
      PairBound known;
      answer = pair.decide(matters, known, counts);
      if (!answer && known.bound > queue.leastBound()) {
        queue.push({known.bound, next.a, next.b, Waiting::Kind::kBodies, known.source});
        continue;
      }
    } else if (pair.lowerBound() > matters) {
      ++counts.ties;
      continue;
    }
    if (!answer) answer = pair.search(matters, true, counts);
    if (!answer->within) continue;
    found = true;
    best = ids;
    nearest = *answer;
    limit = std::min(limit, nearest.distance);
  }
  for (const Waiting& item : queue.items()) {
    if (item.kind == Waiting::Kind::kBodies) {
      countSkipped(item.source, counts);
    } else {
      counts.far_boxes +=
          item.a == item.b ? tree_[item.a].pairs() : tree_[item.a].pairsWith(tree_[item.b]);
    }
  }
  memory.endQuery();
  last_closest_ = found ? best : std::pair<int, int>(-1, -1);
  if (!found) return std::nullopt;
  return report(best.first, best.second, nearest, request);
}

std::vector<ScenePaird> Scene::pairsWithin(double margin, const SceneRequest& request) {
  beginQuery();
  const bool exact = request.exact || !(margin < kInfinity);
  std::vector<ScenePaird> pairs;
  const auto ask = [&](int a, int b, double /*square*/) {
    if (!admissible(a, b)) {
      ++counts.filtered;
      return;
    }
    BodyPair pair = pairOf(a, b);
    const Answer answer = pair.answer(margin, exact, counts);
    if (answer.within) pairs.push_back(report(a, b, answer, request));
  };

  forNearPairs(margin, ask);
  memory.endQuery();
  std::sort(pairs.begin(), pairs.end(), [](const ScenePaird& x, const ScenePaird& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  return pairs;
}

}  // namespace kios::scene
