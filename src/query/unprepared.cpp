// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/unprepared.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "fcl_kios/triangle/intersection.h"
#include "model/prepared.h"
#include "query/nearest_candidates.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using engine::PairAnswer;
using engine::TrianglePairIds;

/// Holds what the trees of two models let a walk take.
template <typename S>
class Allowance {
 public:
  explicit Allowance(const MeshPair<S>& frame)
      : trees_a_(treesOf(frame.a)), trees_b_(treesOf(frame.b)) {
    if (!trees_a_ || !trees_b_) return;
    tests_ = std::max(trees_a_->budget.remaining(static_cast<std::size_t>(frame.a.num_tris)),
                      trees_b_->budget.remaining(static_cast<std::size_t>(frame.b.num_tris)));
  }

  long long tests() const { return tests_; }
  /// Charges a walk of so many tests with those that trees would have spared it: a search of trees
  /// takes as long before it looks at any node. Short walks are charged, too, with an eighth, so
  /// that trees are made in the long run.
  void charge(long long tests) const {
    constexpr long long kTestsToBegin = 12;
    const long long spared = std::max(tests - kTestsToBegin, tests / 8);
    trees_a_->budget.charge(spared);
    if (trees_b_ != trees_a_) trees_b_->budget.charge(spared);
  }

 private:
  engine::TreeCache *const trees_a_, *const trees_b_;
  long long tests_ = 0;
};

/// A walk of two of FCL's trees, depth first, the nearer of two children first.
template <typename S, class Walk>
class TreeWalk {
 public:
  TreeWalk(const MeshPair<S>& frame, long long limit) : frame_(frame), limit_(limit) {}

  /// A test of triangles takes as long as four of volumes.
  long long tests() const { return volume_tests_ + 4 * leaf_tests_; }
  bool gaveUp() const { return tests() >= limit_; }
  void countIn(SearchCounts& counts) const {
    counts.volume_tests += volume_tests_;
    counts.leaf_pairs += leaf_tests_;
    counts.exact += leaf_tests_;
  }

 protected:
  /// True to end the walk. The contents of the two nodes are at least `bound` apart.
  bool visit(int at_a, int at_b, double bound) {
    Walk& walk = static_cast<Walk&>(*this);
    const auto &node_a = frame_.a.getBV(at_a), &node_b = frame_.b.getBV(at_b);
    if (node_a.isLeaf() && node_b.isLeaf()) {
      ++leaf_tests_;
      return walk.test({node_a.primitiveId(), node_b.primitiveId()}) || gaveUp();
    }
    const bool split_a =
        node_b.isLeaf() || (!node_a.isLeaf() && node_a.bv.radius0 > node_b.bv.radius0);
    int a[2] = {at_a, at_a}, b[2] = {at_b, at_b};
    (split_a ? a : b)[0] = split_a ? node_a.leftChild() : node_b.leftChild();
    (split_a ? a : b)[1] = split_a ? node_a.rightChild() : node_b.rightChild();
    double bounds[2];
    for (int i = 0; i < 2; ++i) {
      bounds[i] = std::max(bound, separation(frame_.a.getBV(a[i]).bv, frame_.b.getBV(b[i]).bv,
                                             frame_.X_AB, walk.cullDistance()));
    }
    volume_tests_ += 2;
    const int first = bounds[1] < bounds[0] ? 1 : 0;
    for (const int i : {first, 1 - first}) {
      if (walk.isFar(bounds[i])) continue;
      if (visit(a[i], b[i], bounds[i])) return true;
    }
    return gaveUp();
  }

  const MeshPair<S>& frame_;

 private:
  const long long limit_;
  long long volume_tests_ = 0, leaf_tests_ = 0;
};

template <typename S>
class TouchWalk : public TreeWalk<S, TouchWalk<S>> {
  using Base = TreeWalk<S, TouchWalk<S>>;

 public:
  TouchWalk(const MeshPair<S>& frame, std::size_t max_pairs, long long limit)
      : Base(frame, limit), max_pairs_(max_pairs) {}

  void run() { this->visit(0, 0, -kInfinity); }
  std::vector<TrianglePairIds> found;

  double cullDistance() const { return 0; }
  bool isFar(double bound) const { return bound > 0; }
  bool test(const TrianglePairIds& ids) {
    if (!trianglesIntersect(this->frame_.triangleA(ids.a), this->frame_.triangleB(ids.b))) {
      return false;
    }
    found.push_back(ids);
    return found.size() >= max_pairs_;
  }

 private:
  const std::size_t max_pairs_;
};

template <typename S>
class NearWalk : public TreeWalk<S, NearWalk<S>> {
  using Base = TreeWalk<S, NearWalk<S>>;

 public:
  NearWalk(const MeshPair<S>& frame, double far_enough, long long limit)
      : Base(frame, limit), pairs_(frame, far_enough) {}

  /// Where triangles touch, the walk ends with TouchWalk's first: bounds that exceed 0 differ, but
  /// nodes as far apart as that hold no such triangles.
  void run() { this->visit(0, 0, -kInfinity); }
  const NearestCandidates<S>& pairs() const { return pairs_; }

  double cullDistance() const { return pairs_.cullDistance(); }
  bool isFar(double bound) const { return bound > pairs_.cullDistance(); }
  bool test(const TrianglePairIds& ids) { return pairs_.test(ids); }

 private:
  NearestCandidates<S> pairs_;
};

}  // namespace

template <typename S>
std::optional<std::vector<TrianglePairIds>> touchUnprepared(const MeshPair<S>& frame,
                                                            std::size_t limit,
                                                            SearchCounts& counts) {
  const Allowance<S> allowance(frame);
  if (allowance.tests() == 0) return std::nullopt;
  TouchWalk<S> walk(frame, limit, allowance.tests());
  walk.run();
  allowance.charge(walk.tests());
  walk.countIn(counts);
  if (walk.found.size() < limit && walk.gaveUp()) return std::nullopt;
  ++counts.tree_searches;
  std::sort(walk.found.begin(), walk.found.end());
  return std::move(walk.found);
}

template <typename S>
std::optional<PairAnswer<S>> nearestUnprepared(const MeshPair<S>& frame, double far_enough,
                                               bool any_touching, SearchCounts& counts) {
  const Allowance<S> allowance(frame);
  if (allowance.tests() == 0) return std::nullopt;
  NearWalk<S> walk(frame, far_enough, allowance.tests());
  walk.run();
  allowance.charge(walk.tests());
  walk.countIn(counts);
  const bool done =
      walk.pairs().touching() ? any_touching || namesFirstTouching(frame) : !walk.gaveUp();
  if (!done) return std::nullopt;
  return walk.pairs().answer();
}

template <typename S>
TrianglePairIds firstTouching(const MeshPair<S>& frame, SearchCounts& counts) {
  TouchWalk<S> walk(frame, 1, std::numeric_limits<long long>::max());
  walk.run();
  walk.countIn(counts);
  return walk.found.at(0);
}

KIOS_INSTANTIATE_FUNCTION(touchUnprepared);
KIOS_INSTANTIATE_FUNCTION(nearestUnprepared);
KIOS_INSTANTIATE_FUNCTION(firstTouching);

}  // namespace kios
