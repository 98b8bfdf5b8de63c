// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// All that is included outside of simd/ is included before the first target's pass, so that no
// inline function is compiled for an instruction set that a machine may lack.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "search/double_bound.h"
#include "search/search.h"
#include "tree/compress_table.h"
#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/distance_kernel.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/cache_control.h>      // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

#include "search/simd/pair_search-inl.h"
//
#include "search/simd/bracket_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Nearly best first, after a descent for an upper bound: pairs that overlap are expanded at once,
/// as they all must be, the others in waves by their bounds. A pair of leaves is bounded by a slab
/// and waits again; the features of one that waited are evaluated.
class DistanceSearch {
 public:
  explicit DistanceSearch(const Search& search)
      : search_(search),
        expander_(search),
        leaves_a_(search.a),
        leaves_b_(search.b),
        last_(search) {}

  void run() {
    if (descend()) return;
    if (expander_.isLarge()) {
      search<true>();
    } else {
      search<false>();
    }
  }

 private:
  static constexpr float kWave = 0.5F;
  static constexpr uint32_t kMaxWaiting = 256;

  /// kLarge: the trees are; see Expander::isLarge(). More is then looked at together.
  template <bool kLarge>
  [[gnu::hot]] void search() {
    constexpr size_t kBatch = kLarge ? 16 : 4, kLeafPairs = kLarge ? 8 : 1;
    for (;;) {
      while (!frontier_.leaves.empty()) {
        NodePairList::Entry pairs[kLeafPairs];
        const size_t n = frontier_.leaves.pop(pairs);
        if (kLarge) fetchLeaves(pairs, n);
        for (size_t i = n; i-- > 0;) {
          if (boundLeaves(pairs[i])) return;
        }
      }
      NodePairList::Entry batch[kBatch];
      const size_t n = frontier_.inner.pop(batch);
      expander_.expand<false>(batch, n, frontier_);
      if (n == 0) {
        if (!frontier_.nextWave(search_.evaluator.cull_distance, kWave)) return;
        if (kLarge) fetchWave();
        while (!frontier_.bounded.empty()) {
          const NodePairList::Entry entry = frontier_.bounded.pop();
          if (entry.bound >= search_.evaluator.cull_distance) continue;
          if (evaluateFeatures(waiting_[entry.pair.a], entry.bound)) return;
        }
      }
    }
  }

  /// True to end the search. Not inlined: its path is large, and not needed for long.
  [[gnu::hot]] HWY_NOINLINE bool descend() {
    Descent descent(expander_, std::numeric_limits<long long>::max());
    if (descent.atLeaves() && boundLeaves(descent.end())) return true;
    descent.spread(frontier_);
    return false;
  }

  /// True to end the search.
  HWY_INLINE bool boundLeaves(const NodePairList::Entry& entry) {
    if (entry.bound >= search_.evaluator.cull_distance) return false;
    ++search_.counts.leaf_pairs;
    Bracketed& pair = waiting_[num_waiting_];
    pair.nodes = entry.pair;
    bracketPair(search_, leaves_a_, leaves_b_, last_, pair);
    if (!pair.slab.apart) search_.evaluator.addUpperBound(pair.upper);
    const float bound = std::max(entry.bound, pair.lower);
    if (pair.slab.apart || bound >= search_.evaluator.cull_distance) {
      if (search_.audit)
        search_.audit->pruned(entry.pair.a, entry.pair.b, search_.evaluator.cull_distance);
      return false;
    }
    // Overlapping pairs are searched at once, and so is a pair that finds no room to wait.
    if (bound <= 0 || num_waiting_ + 1 == kMaxWaiting) return evaluateFeatures(pair, bound);
    frontier_.keep(bound, num_waiting_++);
    return false;
  }

  // All pairs are fetched at once, in as few steps as the addresses allow.

  HWY_INLINE void fetchWave() const {
    for (size_t i = 0; i < frontier_.inner.size(); ++i) expander_.fetchNodes(frontier_.inner[i]);
    for (size_t i = 0; i < frontier_.bounded.size(); ++i) {
      const NodePair at = waiting_[frontier_.bounded[i].a].nodes;
      fetchFeatures(search_.a, leaves_a_.leafOf(at.a));
      fetchFeatures(search_.b, leaves_b_.leafOf(at.b));
    }
  }
  static HWY_INLINE void fetchFeatures(const Tree& tree, const Leaf& leaf) {
    const LeafView view(tree, leaf);
    fetch(view.faces, kFaceRows);
    fetch(view.ids, size_t{leaf.num_faces} + leaf.num_edges + leaf.num_owned);
  }

  HWY_INLINE void fetchLeaves(const NodePairList::Entry* pairs, size_t count) const {
    for (size_t i = 0; i < count; ++i) {
      fetch(leaves_a_.leafOf(pairs[i].pair.a));
      fetch(leaves_b_.leafOf(pairs[i].pair.b));
    }
    for (size_t i = 0; i < count; ++i) {
      fetchVertices(search_.a, leaves_a_.leafOf(pairs[i].pair.a));
      fetchVertices(search_.b, leaves_b_.leafOf(pairs[i].pair.b));
    }
  }
  static HWY_INLINE void fetchVertices(const Tree& tree, const Leaf& leaf) {
    const LeafView view(tree, leaf);
    fetch(view.vertices.rows, 3 * static_cast<size_t>(view.vertices.chunks));
  }

  /// True to end the search.
  [[gnu::hot]] HWY_NOINLINE bool evaluateFeatures(const Bracketed& pair, float bound) {
    return nearestOfLeaves(search_, leaves_a_(pair.nodes.a), leaves_b_(pair.nodes.b), pair.slab,
                           bound);
  }

  const Search& search_;
  const Expander expander_;
  Leaves leaves_a_, leaves_b_;
  Frontier frontier_;
  LastLeaves last_;
  uint32_t num_waiting_ = 0;
  Bracketed waiting_[kMaxWaiting];
};

[[gnu::hot]] void distance(const Search& search) { DistanceSearch(search).run(); }

void bracket(const Search& search) { BracketSearch(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
