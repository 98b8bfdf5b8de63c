// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/unprepared.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fcl_kios/triangle/intersection.h"
#include "model/prepared.h"
#include "query/few_triangles.h"
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
    tests_ = std::max(trees_a_->budget.remaining(frame.a.num_tris),
                      trees_b_->budget.remaining(frame.b.num_tris));
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

/// A walk of two of FCL's trees, depth first, the nearer of two children first. Nodes farther apart
/// than found.cullDistance() don't matter; found.test(ids) tests two triangles, and returns true to
/// end the walk.
template <typename S, typename Found>
class TreeWalk {
 public:
  TreeWalk(const MeshPair<S>& frame, Found& found, long long limit)
      : frame_(frame), found_(found), limit_(limit) {}

  void run(SearchCounts& counts) {
    visit(0, 0, -kInfinity);
    counts.volume_tests += volume_tests_;
    counts.leaf_pairs += leaf_tests_;
    counts.exact += leaf_tests_;
  }
  /// A test of triangles takes as long as four of volumes.
  long long tests() const { return volume_tests_ + 4 * leaf_tests_; }
  bool gaveUp() const { return tests() >= limit_; }

 private:
  /// True to end the walk. The contents of the two nodes are at least `bound` apart.
  bool visit(int at_a, int at_b, double bound) {
    const auto &node_a = frame_.a.getBV(at_a), &node_b = frame_.b.getBV(at_b);
    if (node_a.isLeaf() && node_b.isLeaf()) {
      ++leaf_tests_;
      return found_.test({node_a.primitiveId(), node_b.primitiveId()}) || gaveUp();
    }
    const bool split_a =
        node_b.isLeaf() || (!node_a.isLeaf() && node_a.bv.radius0 > node_b.bv.radius0);
    int a[2] = {at_a, at_a}, b[2] = {at_b, at_b};
    (split_a ? a : b)[0] = split_a ? node_a.leftChild() : node_b.leftChild();
    (split_a ? a : b)[1] = split_a ? node_a.rightChild() : node_b.rightChild();
    double bounds[2];
    for (int i = 0; i < 2; ++i) {
      bounds[i] = std::max(bound, separation(frame_.a.getBV(a[i]).bv, frame_.b.getBV(b[i]).bv,
                                             frame_.X_AB, found_.cullDistance()));
    }
    volume_tests_ += 2;
    const int first = bounds[1] < bounds[0] ? 1 : 0;
    for (const int i : {first, 1 - first}) {
      if (bounds[i] > found_.cullDistance()) continue;
      if (visit(a[i], b[i], bounds[i])) return true;
    }
    return gaveUp();
  }

  const MeshPair<S>& frame_;
  Found& found_;
  const long long limit_;
  long long volume_tests_ = 0, leaf_tests_ = 0;
};

/// The triangles that intersect, up to so many.
template <typename S>
struct TouchingPairs {
  const MeshPair<S>& frame;
  const std::size_t limit;
  std::vector<TrianglePairIds> ids;

  static constexpr double cullDistance() { return 0; }
  bool test(const TrianglePairIds& at) {
    if (!trianglesIntersect(frame.triangleA(at.a), frame.triangleB(at.b))) return false;
    ids.push_back(at);
    return ids.size() >= limit;
  }
};

}  // namespace

template <typename S>
std::optional<std::vector<TrianglePairIds>> touchUnprepared(const MeshPair<S>& frame,
                                                            std::size_t limit,
                                                            SearchCounts& counts) {
  const Allowance<S> allowance(frame);
  if (allowance.tests() == 0) return std::nullopt;
  TouchingPairs<S> touching{frame, limit, {}};
  TreeWalk walk(frame, touching, allowance.tests());
  walk.run(counts);
  allowance.charge(walk.tests());
  if (touching.ids.size() < limit && walk.gaveUp()) return std::nullopt;
  ++counts.tree_searches;
  std::sort(touching.ids.begin(), touching.ids.end());
  return std::move(touching.ids);
}

template <typename S>
std::optional<PairAnswer<S>> nearestUnprepared(const MeshPair<S>& frame,
                                               const engine::PairQuery& query,
                                               SearchCounts& counts) {
  const Allowance<S> allowance(frame);
  if (allowance.tests() == 0) return std::nullopt;
  const auto touching = touchingOfFew(frame, query, counts);
  if (touching && touching->found()) return touching;
  NearestCandidates<S> near(frame, query.far_enough);
  TreeWalk walk(frame, near, allowance.tests());
  walk.run(counts);
  allowance.charge(walk.tests());
  if (near.touching() ? !query.any_touching : walk.gaveUp()) return std::nullopt;
  return near.answer();
}

KIOS_INSTANTIATE_FUNCTION(touchUnprepared);
KIOS_INSTANTIATE_FUNCTION(nearestUnprepared);

}  // namespace kios
