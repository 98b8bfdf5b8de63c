// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/tree_search.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "query/mesh_pair.h"

namespace kios {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename S>
class TreeSearch {
 public:
  TreeSearch(const Model<S>& model1, const Model<S>& model2, const RelativePose<S>& X_12,
             const engine::BracketQuery<S>& query, double rounding, SearchCounts& counts)
      : model1_(model1),
        model2_(model2),
        X_12_(X_12),
        query_(query),
        rounding_(rounding),
        counts_(counts),
        prune_at_(query.far_enough) {}

  engine::BracketResult<S> run() {
    if (begin()) return result_;
    bool done = false;
    long long left = query_.max_expansions;
    push(0, 0, -kInfinity);
    while (!done && !waiting_.empty() && waiting_.front().bound < prune_at_) {
      const Pair at = waiting_.front();
      const auto &node1 = model1_.getBV(at.node1), &node2 = model2_.getBV(at.node2);
      const bool leaves = node1.isLeaf() && node2.isLeaf();
      if (!leaves && left-- == 0) {
        result_.end = engine::SearchEnd::kBudget;
        break;
      }
      std::pop_heap(waiting_.begin(), waiting_.end());
      waiting_.pop_back();
      if (leaves) {
        ++counts_.leaf_pairs;
        done = evaluate(node1.primitiveId(), node2.primitiveId());
        continue;
      }
      ++counts_.expansions;
      counts_.volume_tests += 2;
      if (node2.isLeaf() || (!node1.isLeaf() && node1.bv.size() > node2.bv.size())) {
        push(node1.leftChild(), at.node2, at.bound);
        push(node1.rightChild(), at.node2, at.bound);
      } else {
        push(at.node1, node2.leftChild(), at.bound);
        push(at.node1, node2.rightChild(), at.bound);
      }
    }
    // Of pairs that intersect any is an answer: which must not depend on the start.
    if (offered_ && result_.ids.a >= 0 && result_.nearest.distance == 0) return cold();
    if (!waiting_.empty()) left_out_ = std::min(left_out_, waiting_.front().bound);
    result_.least_other = std::max(0.0, left_out_);
    return result_;
  }

 private:
  struct Pair {
    double bound;
    int node1, node2;
    bool operator<(const Pair& o) const { return bound > o.bound; }  // the least on top of the heap
  };

  bool exists(const engine::TrianglePairIds& ids) const {
    return ids.a >= 0 && ids.a < model1_.num_tris && ids.b >= 0 && ids.b < model2_.num_tris;
  }
  TriangleDistance<S> distanceOf(int id1, int id2) const {
    return triangleDistance(cornersOf(model1_, id1), transformed(cornersOf(model2_, id2), X_12_));
  }

  /// From the triangles of query_.start; true to end the search. An exact answer only learns of
  /// their distance.
  bool begin() {
    const auto [id1, id2] = query_.start;
    if (!exists(query_.start)) return false;
    const double distance = double{distanceOf(id1, id2).distance};
    const bool near = query_.near_enough > 0 && distance <= query_.near_enough;
    if (!query_.isExact() || query_.hasBudget() || near) return evaluate(id1, id2);
    offered_ = distance > 0;
    if (offered_) prune_at_ = std::min(prune_at_, distance + rounding_);
    return false;
  }

  engine::BracketResult<S> cold() const {
    engine::BracketQuery<S> query = query_;
    query.start = {};
    return TreeSearch(model1_, model2_, X_12_, query, rounding_, counts_).run();
  }

  void push(int node1, int node2, double parent) {
    const double own =
        separation(model1_.getBV(node1).bv, model2_.getBV(node2).bv, X_12_, prune_at_);
    const double bound = std::max(own, parent);
    if (bound >= prune_at_) {
      left_out_ = std::min(left_out_, bound);
      return;
    }
    waiting_.push_back({bound, node1, node2});
    std::push_heap(waiting_.begin(), waiting_.end());
  }

  /// True to end the search.
  bool evaluate(int id1, int id2) {
    ++counts_.exact;
    const engine::TrianglePairIds ids = {id1, id2};
    const TriangleDistance<S> found = distanceOf(id1, id2);
    const double distance = double{found.distance}, best = result_.least_evaluated;
    if (distance > best || (distance == best && result_.ids < ids)) return false;
    result_.ids = ids;
    result_.nearest = found;
    result_.least_evaluated = distance;
    double enough = std::min(distance - query_.abs_err, distance / (1 + query_.rel_err));
    // All that may be as near by its own rounding is evaluated, whatever the order.
    if (query_.isExact()) enough = distance + rounding_;
    prune_at_ = std::min(prune_at_, std::max(0.0, enough));
    if (!(distance <= query_.near_enough)) return false;
    result_.end = engine::SearchEnd::kNear;
    return true;
  }

  const Model<S>&model1_, &model2_;
  const RelativePose<S>& X_12_;
  const engine::BracketQuery<S>& query_;
  const double rounding_;
  SearchCounts& counts_;
  std::vector<Pair> waiting_;  ///< a heap
  double prune_at_;
  double left_out_ = kInfinity;  ///< least bound of what was left out
  bool offered_ = false;         ///< whether the start lowered prune_at_
  engine::BracketResult<S> result_;
};

}  // namespace

template <typename S>
engine::BracketResult<S> bracketInTree(const Model<S>& model1, const Model<S>& model2,
                                       const RelativePose<S>& X_12,
                                       const engine::BracketQuery<S>& query, double rounding,
                                       SearchCounts& counts) {
  ++counts.tree_searches;
  return TreeSearch<S>(model1, model2, X_12, query, rounding, counts).run();
}

#define KIOS_INSTANTIATE(S)                                                                     \
  template engine::BracketResult<S> bracketInTree(                                              \
      const Model<S>&, const Model<S>&, const RelativePose<S>&, const engine::BracketQuery<S>&, \
      double, SearchCounts&);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
