// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

struct Entry {
  float bound;
  uint32_t a, b;
};

template <class M>
HWY_INLINE uint32_t bitsOf(M mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Visits all pairs of leaves whose bound is below judge.prune_at, depth first, the nearest child
/// first. leaf_pair(leaf_a, leaf_b, bound) returns true to end.
template <class LeafPair>
HWY_INLINE void traverse(const Search& search, const LeafPair& leaf_pair) {
  const Tree &a = search.a, &b = search.b;
  const FramePair& frames = search.frames;
  const Judge& judge = search.judge;
  // Every expansion replaces an entry by at most kLanes one level deeper.
  const size_t capacity = 7 * static_cast<size_t>(a.depth + b.depth) + kLanes + 1;
  constexpr size_t kUsual = 320;
  Entry usual[kUsual];
  std::vector<Entry> deep(capacity > kUsual ? capacity : 0);
  Entry* const stack = deep.empty() ? usual : deep.data();

  size_t top = 0;
  stack[top++] = {-std::numeric_limits<float>::infinity(), 0, 0};
  long long expansions = 0, lanes = 0, leaf_pairs = 0;
  while (top > 0) {
    const Entry at = stack[--top];
    if (at.bound >= judge.prune_at) continue;
    const Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    if (node_a.isLeaf() && node_b.isLeaf()) {
      ++leaf_pairs;
      if (leaf_pair(a.leaves[node_a.leaf()], b.leaves[node_b.leaf()], at.bound)) break;
      continue;
    }
    const bool expand_a = node_b.isLeaf() || (!node_a.isLeaf() && node_a.size > node_b.size);
    const Node& parent = expand_a ? node_a : node_b;
    const Tree& tree = expand_a ? a : b;
    const Block& block = tree.blocks[parent.child];
    const uint32_t count = tree.counts[parent.child];
    MovedNode moved;
    move(expand_a ? node_b : node_a, expand_a ? frames.a_from_b : frames.b_from_a, frames.pad,
         moved);
    alignas(32) float bounds[kLanes];
    uint32_t near = 0;
    const V limit = hn::Set(d, judge.prune_at);
    for (size_t l = 0; l < kLanes; l += step()) {
      const V lower = lowerBounds(block, l, moved);
      hn::Store(lower, d, bounds + l);
      near |= bitsOf(hn::Lt(lower, limit)) << l;
    }
    near &= (1U << count) - 1;
    ++expansions;
    lanes += count;
    const size_t base = top;
    for (; near != 0; near &= near - 1) {
      const uint32_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(near);
      const float bound = bounds[lane];
      size_t i = top++;
      for (; i > base && stack[i - 1].bound < bound; --i) stack[i] = stack[i - 1];
      const uint32_t child = parent.first_child + lane;
      stack[i] = expand_a ? Entry{bound, child, at.b} : Entry{bound, at.a, child};
    }
  }
  search.counts.expansions += expansions;
  search.counts.volume_tests += lanes;
  search.counts.leaf_pairs += leaf_pairs;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
