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
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernels.cpp"
#define HWY_DISABLED_TARGETS HWY_SSSE3
#define HWY_COMPILE_ALL_ATTAINABLE  // the scalar one too
#include <hwy/foreach_target.h>     // NOLINT(llvm-include-order)
#include <hwy/highway.h>            // NOLINT(llvm-include-order)

// In this order.
#include "engine/simd/node_test-inl.h"
//
#include "engine/simd/box_test-inl.h"
//
#include "engine/simd/traverse-inl.h"
//
#include "engine/simd/leaf_cull-inl.h"
//
#include "engine/simd/leaf_pair-inl.h"
//
#include "engine/simd/leaf_distance-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Best first: the pair of the least bound is expanded; a pair of leaves is bounded by a slab and
/// waits again; the features of one that waited are judged. Pairs that overlap must all be expanded
/// and come depth first, and so does everything until a first upper bound is known.
void distance(const Search& search) {
  constexpr uint32_t kSlabbed = 1U << 31;
  constexpr uint32_t kMaxSlabbed = 256;
  const Tree &a = search.a, &b = search.b;
  const Judge& judge = search.judge;
  const Sides sides(search);
  Frontier frontier;
  Slabbed slabbed[kMaxSlabbed];
  uint32_t num_slabbed = 0;
  Frontier::Pair at = {0, 0};
  float bound = -std::numeric_limits<float>::infinity();
  float prune_at = judge.prune_at;
  if (prune_at < std::numeric_limits<float>::infinity()) frontier.setUpperBound(prune_at);
  for (bool have = true;;) {
    if (judge.prune_at < prune_at) {
      prune_at = judge.prune_at;
      frontier.setUpperBound(prune_at);
    }
    if (have && !frontier.comesNext(bound)) {
      frontier.reserve(1);
      frontier.push(bound, at);
      have = false;
    }
    if (!have) {
      if (frontier.empty()) return;
      const Frontier::Entry entry = frontier.pop();
      at = entry.pair;
      bound = entry.bound;
    }
    have = false;
    if (bound >= prune_at) continue;
    if ((at.a & kSlabbed) != 0) {
      const Slabbed& leaves = slabbed[at.a & ~kSlabbed];
      if (nearestOfLeaves(search, a.leaves[a.nodes[leaves.nodes.a].leaf()],
                          b.leaves[b.nodes[leaves.nodes.b].leaf()], leaves.slab, bound)) {
        return;
      }
      continue;
    }
    const Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    if (!node_a.isLeaf() || !node_b.isLeaf()) {
      have = expand(search, sides, frontier, at, bound);
      continue;
    }
    ++search.counts.leaf_pairs;
    const Leaf &leaf_a = a.leaves[node_a.leaf()], &leaf_b = b.leaves[node_b.leaf()];
    Slabbed& leaves = slabbed[num_slabbed];
    leaves.nodes = at;
    bound = std::max(bound, boundOfLeaves(search, leaf_a, leaf_b, leaves.slab));
    if (bound >= prune_at) {
      if (search.audit) search.audit->pruned(at.a, at.b, prune_at);
      continue;
    }
    if (num_slabbed + 1 == kMaxSlabbed) {  // no room to wait
      if (nearestOfLeaves(search, leaf_a, leaf_b, leaves.slab, bound)) return;
      continue;
    }
    at = {kSlabbed | num_slabbed++, 0};
    have = true;
  }
}

/// Depth first, of the last children the deepest first: what overlaps deepest is the likeliest hit.
template <class LeafPair>
HWY_INLINE void touching(const Search& search, const LeafPair& leaf_pair) {
  const Tree &a = search.a, &b = search.b;
  const Sides sides(search);
  Frontier frontier;  // of one bucket: a stack
  Frontier::Pair at = {0, 0};
  float bound;
  for (bool have = true;;) {
    if (!have) {
      if (frontier.empty()) return;
      at = frontier.pop().pair;
    }
    const Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    have = !node_a.isLeaf() || !node_b.isLeaf();
    if (have) {
      have = expand(search, sides, frontier, at, bound);
      continue;
    }
    ++search.counts.leaf_pairs;
    if (leaf_pair(search, a.leaves[node_a.leaf()], b.leaves[node_b.leaf()])) return;
  }
}

void contact(const Search& search) { touching(search, contactOfLeaves); }

void contacts(const Search& search) { touching(search, contactsOfLeaves); }

extern const Kernels kKernels;
const Kernels kKernels = {HWY_STR(HWY_NAMESPACE) + 2, &distance, &contact, &contacts};  // after N_

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
