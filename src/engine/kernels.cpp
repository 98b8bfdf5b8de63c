// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// All that this file includes outside of simd/ is included before the first target's pass, so that
// no inline function is compiled for an instruction set that a machine may lack.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/ray_search.h"
#include "engine/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernels.cpp"
#define HWY_DISABLED_TARGETS HWY_SSSE3
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/cache_control.h>      // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

// In this order.
#include "engine/simd/node_test-inl.h"
//
#include "engine/simd/box_test-inl.h"
//
#include "engine/simd/traverse-inl.h"
//
#include "engine/simd/ray-inl.h"
//
#include "engine/simd/leaf_cull-inl.h"
//
#include "engine/simd/leaf_pair-inl.h"
//
#include "engine/simd/leaf_distance-inl.h"
//
#include "engine/simd/leaf_bracket-inl.h"
//
#include "engine/simd/bracket_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Nearly best first: the pairs of the least bounds are expanded; a pair of leaves is bounded by a
/// slab and waits again; the features of one that waited are judged. Depth first where pairs
/// overlap, as they must all be expanded, and until a first upper bound is known.
class DistanceSearch {
 public:
  explicit DistanceSearch(const Search& search) : search_(search), expander_(search) {}

  void run() {
    frontier_.push(-kInfinity, {0, 0});
    lowerTo(search_.judge.prune_at);
    Expansion batch[kBatch];
    for (;;) {
      const size_t wanted = prune_at_ < kInfinity ? kBatch : 1;
      size_t n = 0;
      while (n < wanted && !frontier_.empty()) {
        const Frontier::Entry entry = frontier_.pop();
        if (entry.bound >= prune_at_) continue;
        if (isInner(entry.pair)) {
          expander_.start(entry.pair, batch[n++]);
        } else {
          if (leaves(entry)) return;
          lowerTo(search_.judge.prune_at);
        }
      }
      if (n == 0) return;
      for (size_t i = 0; i < n; ++i) expander_.test(batch[i]);
      for (size_t i = 0; i < n; ++i) expander_.spread(batch[i], frontier_);
    }
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  static constexpr size_t kBatch = 4;
  static constexpr uint32_t kWaiting = 1U << 31;  ///< instead of node a: an index of waiting_
  static constexpr uint32_t kMaxWaiting = 256;

  const Node& nodeA(Frontier::Pair at) const { return search_.a.nodes[at.a]; }
  const Node& nodeB(Frontier::Pair at) const { return search_.b.nodes[at.b]; }
  bool isInner(Frontier::Pair at) const {
    return (at.a & kWaiting) == 0 && !(nodeA(at).isLeaf() && nodeB(at).isLeaf());
  }

  void lowerTo(float prune_at) {
    if (!(prune_at < prune_at_)) return;
    prune_at_ = prune_at;
    frontier_.setUpperBound(prune_at);
  }

  /// True to end the search.
  bool leaves(const Frontier::Entry& entry) {
    if ((entry.pair.a & kWaiting) != 0) {
      const Slabbed& slabbed = waiting_[entry.pair.a & ~kWaiting];
      return nearest(slabbed, entry.bound);
    }
    ++search_.counts.leaf_pairs;
    Slabbed& slabbed = waiting_[num_waiting_];
    slabbed.nodes = entry.pair;
    const float by_slab =
        boundOfLeaves(search_, leafA(entry.pair), leafB(entry.pair), slabbed.slab);
    const float bound = std::max(entry.bound, by_slab);
    lowerTo(search_.judge.prune_at);
    if (bound >= prune_at_) {
      if (search_.audit) search_.audit->pruned(entry.pair.a, entry.pair.b, prune_at_);
      return false;
    }
    if (num_waiting_ + 1 == kMaxWaiting) return nearest(slabbed, bound);  // no room to wait
    frontier_.reserve(1);
    frontier_.push(bound, {kWaiting | num_waiting_++, 0});
    return false;
  }

  const Leaf& leafA(Frontier::Pair at) const { return search_.a.leaves[nodeA(at).leaf()]; }
  const Leaf& leafB(Frontier::Pair at) const { return search_.b.leaves[nodeB(at).leaf()]; }

  bool nearest(const Slabbed& slabbed, float bound) {
    return nearestOfLeaves(search_, leafA(slabbed.nodes), leafB(slabbed.nodes), slabbed.slab,
                           bound);
  }

  const Search& search_;
  const Expander expander_;
  Frontier frontier_;
  float prune_at_ = kInfinity;
  uint32_t num_waiting_ = 0;
  Slabbed waiting_[kMaxWaiting];
};

void distance(const Search& search) { DistanceSearch(search).run(); }

void bracket(const Search& search) { BracketSearch(search).run(); }

/// Depth first, of the last children the deepest first: what overlaps deepest is the likeliest hit.
template <class LeafPair>
HWY_INLINE void touching(const Search& search, const LeafPair& leaf_pair) {
  constexpr size_t kBatch = 4;
  const Tree &a = search.a, &b = search.b;
  const Expander expander(search);
  Frontier frontier;  // of one bucket: a stack
  frontier.push(0, {0, 0});
  Expansion batch[kBatch];
  for (;;) {
    size_t n = 0;
    while (n < kBatch && !frontier.empty()) {
      const Frontier::Pair at = frontier.pop().pair;
      const Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
      if (!node_a.isLeaf() || !node_b.isLeaf()) {
        expander.start(at, batch[n++]);
        continue;
      }
      ++search.counts.leaf_pairs;
      if (leaf_pair(search, a.leaves[node_a.leaf()], b.leaves[node_b.leaf()])) return;
    }
    if (n == 0) return;
    for (size_t i = 0; i < n; ++i) expander.test(batch[i]);
    for (size_t i = 0; i < n; ++i) expander.spread(batch[i], frontier);
  }
}

void contact(const Search& search) { touching(search, contactOfLeaves); }

void contacts(const Search& search) { touching(search, contactsOfLeaves); }

extern const Kernels kKernels;
const Kernels kKernels = {
    &HWY_STR(HWY_NAMESPACE)[2], &distance, &bracket, &contact, &contacts, &ray};  // after N_

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::engine {
namespace {

struct Target {
  int64_t bit;
  const Kernels& kernels;
};

// Best first.
const Target kTargets[] = {
#if HWY_TARGETS & HWY_AVX3
    {HWY_AVX3, N_AVX3::kKernels},
#endif
#if HWY_TARGETS & HWY_AVX2
    {HWY_AVX2, N_AVX2::kKernels},
#endif
#if HWY_TARGETS & HWY_SSE4
    {HWY_SSE4, N_SSE4::kKernels},
#endif
#if HWY_TARGETS & HWY_NEON
    {HWY_NEON, N_NEON::kKernels},
#endif
#if HWY_TARGETS & HWY_EMU128
    {HWY_EMU128, N_EMU128::kKernels},
#endif
#if HWY_TARGETS & HWY_SCALAR
    {HWY_SCALAR, N_SCALAR::kKernels},
#endif
};

const Kernels& choose() {
  const int64_t supported = hwy::SupportedTargets() | HWY_EMU128 | HWY_SCALAR;
  const char* const wanted = std::getenv("FCL_KIOS_SIMD");
  std::string available;
  for (const Target& target : kTargets) {
    if ((target.bit & supported) == 0) continue;
    if (!wanted || *wanted == '\0' || std::strcmp(wanted, target.kernels.target) == 0) {
      return target.kernels;
    }
    available += std::string(" ") + target.kernels.target;
  }
  throw std::invalid_argument("fcl_kios: FCL_KIOS_SIMD=" + std::string(wanted) +
                              " is not available on this machine; these are:" + available + ".");
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace kios::engine
#endif  // HWY_ONCE
