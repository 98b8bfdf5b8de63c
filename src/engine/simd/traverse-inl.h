// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

template <class M>
HWY_INLINE uint32_t bitsOf(M mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Pairs of nodes that wait to be tested, with their lower bounds. In no order: the least is found by
/// vectors of bounds, and most often the nearest child of the last expansion is nearer still.
class Frontier {
 public:
  struct Pair {
    uint32_t a, b;
  };

  bool empty() const { return top_ == 0; }
  /// The least bound, infinity if empty.
  float least() const { return least_; }

  void reserve(size_t more) {
    if (HWY_UNLIKELY(top_ + more + kLanes > capacity_)) grow(top_ + more + kLanes);
  }

  /// There must be room: see reserve().
  void push(float bound, Pair pair) {
    bounds_[top_] = bound;
    pairs_[top_++] = pair;
    least_ = std::min(least_, bound);
  }

  /// Drops pairs that are at least `limit` apart, if that is less than the last time.
  void prune(float limit) {
    if (!(limit < limit_)) return;
    limit_ = limit;
    size_t kept = 0;
    for (size_t i = 0; i < top_; ++i) {
      bounds_[kept] = bounds_[i];
      pairs_[kept] = pairs_[i];
      kept += bounds_[i] < limit ? 1 : 0;
    }
    top_ = kept;
    if (!(least_ < limit)) least_ = std::numeric_limits<float>::infinity();
  }

  /// Takes the pair of the least bound, the first of equals.
  Pair popLeast(float& bound) {
    const V infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    for (size_t l = 0; l < kLanes; l += step()) hn::StoreU(infinity, d, bounds_ + top_ + l);
    V first = infinity, second = infinity;  // the least two of each lane
    for (size_t i = 0; i < top_; i += step()) {
      const V v = hn::LoadU(d, bounds_ + i);
      second = hn::Min(second, hn::Max(first, v));
      first = hn::Min(first, v);
    }
    const V least = hn::MinOfLanes(d, first);
    size_t at = 0;
    for (;; at += step()) {
      const uint32_t match = bitsOf(hn::Eq(hn::LoadU(d, bounds_ + at), least));
      if (match == 0) continue;
      at += hwy::Num0BitsBelowLS1Bit_Nonzero32(match);
      break;
    }
    // What is least without it: the second of its lane or the first of another.
    const uint32_t lane = at % step();
    alignas(64) float firsts[kLanes], seconds[kLanes];
    hn::Store(first, d, firsts);
    hn::Store(second, d, seconds);
    firsts[lane] = seconds[lane];
    least_ = hn::GetLane(hn::MinOfLanes(d, hn::Load(d, firsts)));
    return take(at, bound);
  }

  /// Takes the pair pushed last.
  Pair popLast(float& bound) { return take(top_ - 1, bound); }

 private:
  Pair take(size_t at, float& bound) {
    bound = bounds_[at];
    const Pair pair = pairs_[at];
    --top_;
    bounds_[at] = bounds_[top_];
    pairs_[at] = pairs_[top_];
    return pair;
  }

  HWY_NOINLINE void grow(size_t needed) {
    std::vector<float> bounds(2 * needed);
    std::vector<Pair> pairs(2 * needed);
    std::copy_n(bounds_, top_, bounds.data());
    std::copy_n(pairs_, top_, pairs.data());
    more_bounds_ = std::move(bounds);
    more_pairs_ = std::move(pairs);
    bounds_ = more_bounds_.data();
    pairs_ = more_pairs_.data();
    capacity_ = 2 * needed;
  }

  static constexpr size_t kUsual = 512;
  float usual_bounds_[kUsual];
  Pair usual_pairs_[kUsual];
  std::vector<float> more_bounds_;
  std::vector<Pair> more_pairs_;
  float* bounds_ = usual_bounds_;
  Pair* pairs_ = usual_pairs_;
  size_t top_ = 0, capacity_ = kUsual;
  float least_ = std::numeric_limits<float>::infinity();
  float limit_ = std::numeric_limits<float>::infinity();
};

/// Tests the children of the larger node of a pair (a leaf is not expanded) against the other node.
/// Of those nearer than judge.prune_at the nearest replaces the pair, the others join the frontier;
/// false if there is none.
HWY_INLINE bool expand(const Search& search, Frontier& frontier, Frontier::Pair& at, float& bound) {
  const Node &node_a = search.a.nodes[at.a], &node_b = search.b.nodes[at.b];
  const FramePair& frames = search.frames;
  const bool expand_a = node_b.isLeaf() || (!node_a.isLeaf() && node_a.size > node_b.size);
  const Node& parent = expand_a ? node_a : node_b;
  const Tree& tree = expand_a ? search.a : search.b;
  const Block& block = tree.blocks[parent.child];
  const uint32_t count = tree.counts[parent.child];
  MovedNode moved;
  move(expand_a ? node_b : node_a, expand_a ? frames.a_from_b : frames.b_from_a, frames.pad, moved);
  alignas(32) float bounds[kLanes];
  uint32_t near = 0;
  const V limit = hn::Set(d, search.judge.prune_at);
  for (size_t l = 0; l < kLanes; l += step()) {
    const V lower = lowerBounds(block, l, moved);
    hn::Store(lower, d, bounds + l);
    near |= bitsOf(hn::Lt(lower, limit)) << l;
  }
  ++search.counts.expansions;
  search.counts.volume_tests += count;
  near &= (1U << count) - 1;
  if (near == 0) return false;
  uint32_t nearest = hwy::Num0BitsBelowLS1Bit_Nonzero32(near);
  const auto pairOf = [&](uint32_t lane) {
    const uint32_t child = parent.first_child + lane;
    return expand_a ? Frontier::Pair{child, at.b} : Frontier::Pair{at.a, child};
  };
  frontier.reserve(kLanes);
  for (near &= near - 1; near != 0; near &= near - 1) {
    uint32_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(near);
    if (bounds[lane] < bounds[nearest]) std::swap(lane, nearest);
    frontier.push(bounds[lane], pairOf(lane));
  }
  bound = bounds[nearest];
  at = pairOf(nearest);
  return true;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
