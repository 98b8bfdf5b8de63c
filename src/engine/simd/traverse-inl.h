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

/// Pairs of nodes that wait to be tested, with their lower bounds, in buckets of sixteen an octave
/// below an upper bound. A pair of the first bucket that is not empty comes next, the last in
/// first: nearly the best first, for the price of a stack.
class Frontier {
 public:
  struct Pair {
    uint32_t a, b;
  };
  struct Entry {
    float bound;
    Pair pair;
    uint32_t next;
  };

  /// Called as an upper bound gets known and falls: what is farther is dropped.
  void setUpperBound(float upper_bound) {
    if (base_ == kNoBase || bitsOf(upper_bound) < base_ + kRebase) {
      sortFor(upper_bound);
    } else {
      filled_ &= (uint64_t{2} << bucketOf(upper_bound)) - 1;
    }
  }

  void reserve(size_t more) {
    if (HWY_UNLIKELY(used_ + more > capacity_)) grow(used_ + more);
  }

  /// There must be room: see reserve().
  void push(float bound, Pair pair) {
    uint32_t entry = free_;
    if (entry == kEnd) {
      entry = used_++;
    } else {
      free_ = entries_[entry].next;
    }
    entries_[entry].bound = bound;
    entries_[entry].pair = pair;
    link(entry);
  }

  bool empty() const { return filled_ == 0; }
  /// Whether a pair of this bound would come next if it were pushed.
  bool comesNext(float bound) const {
    return (filled_ & ((uint64_t{1} << bucketOf(bound)) - 1)) == 0;
  }

  Entry pop() {
    const size_t bucket = hwy::Num0BitsBelowLS1Bit_Nonzero64(filled_);
    const uint32_t entry = head_[bucket];
    const Entry taken = entries_[entry];
    head_[bucket] = taken.next;
    if (taken.next == kEnd) filled_ &= filled_ - 1;
    release(entry);
    return taken;
  }

 private:
  static constexpr int32_t kBuckets = 64;
  static constexpr int kBitsOfBucket = 19;  // of a float: 4 bits of the mantissa select the bucket
  static constexpr int32_t kRange = kBuckets << kBitsOfBucket, kRebase = kRange / 4;
  static constexpr int32_t kNoBase = std::numeric_limits<int32_t>::max();
  static constexpr uint32_t kEnd = ~uint32_t{0};

  /// Positive floats order like their bits; negative ones have negative bits.
  static int32_t bitsOf(float bound) {
    int32_t bits;
    std::memcpy(&bits, &bound, sizeof(bits));
    return bits;
  }

  /// Overlapping pairs lie in the first bucket; while there is no upper bound, all do.
  int32_t bucketOf(float bound) const {
    const int32_t above = std::max(bitsOf(bound), base_) - base_;
    return std::min(above >> kBitsOfBucket, kBuckets - 1);
  }

  /// Buckets anew: the last one holds the upper bound.
  HWY_NOINLINE void sortFor(float upper_bound) {
    uint32_t chain = kEnd;
    for (; filled_ != 0; filled_ &= filled_ - 1) {  // one chain of all, the nearest buckets last
      const uint32_t head = head_[hwy::Num0BitsBelowLS1Bit_Nonzero64(filled_)];
      for (uint32_t entry = head, next; entry != kEnd; entry = next) {
        next = entries_[entry].next;
        entries_[entry].next = chain;
        chain = entry;
      }
    }
    base_ = std::max(bitsOf(upper_bound) + (1 << kBitsOfBucket) - kRange, 0);
    for (uint32_t entry = chain, next; entry != kEnd; entry = next) {
      next = entries_[entry].next;
      if (entries_[entry].bound < upper_bound) {
        link(entry);
      } else {
        release(entry);
      }
    }
  }

  void link(uint32_t entry) {
    const int32_t bucket = bucketOf(entries_[entry].bound);
    const uint64_t bit = uint64_t{1} << bucket;
    entries_[entry].next = (filled_ & bit) != 0 ? head_[bucket] : kEnd;
    head_[bucket] = entry;
    filled_ |= bit;
  }

  void release(uint32_t entry) {
    entries_[entry].next = free_;
    free_ = entry;
  }

  HWY_NOINLINE void grow(size_t needed) {
    std::vector<Entry> entries(2 * needed);
    std::copy_n(entries_, used_, entries.data());
    more_ = std::move(entries);
    entries_ = more_.data();
    capacity_ = 2 * needed;
  }

  static constexpr size_t kUsual = 512;
  Entry usual_[kUsual];
  std::vector<Entry> more_;
  Entry* entries_ = usual_;
  size_t capacity_ = kUsual;
  uint32_t used_ = 0, free_ = kEnd;
  uint64_t filled_ = 0;  ///< buckets that aren't empty, as bits
  int32_t base_ = kNoBase;
  uint32_t head_[kBuckets];  ///< of those
};

/// The two sides of a search, by index.
struct Sides {
  explicit Sides(const Search& search)
      : trees{&search.a, &search.b}, to{&search.frames.a_from_b, &search.frames.b_from_a} {}

  const Tree* trees[2];
  const FloatPose* to[2];  ///< the frame of a side from the other's
};

HWY_NOINLINE void reportPruned(const Search& search, const Node& parent, uint32_t count,
                               uint32_t side, Frontier::Pair at, uint32_t near,
                               const float* bounds) {
  for (uint32_t lane = 0; lane < count; ++lane) {
    if ((near >> lane & 1U) != 0) continue;
    const uint32_t child = parent.first_child + lane;
    search.audit->pruned(side == 0 ? child : at.a, side == 0 ? at.b : child, bounds[lane]);
  }
}

/// Tests the children of the larger node of a pair (a leaf is not expanded) against the other node.
/// Of those nearer than judge.prune_at the nearest replaces the pair, the others join the frontier;
/// false if there is none.
HWY_INLINE bool expand(const Search& search, const Sides& sides, Frontier& frontier,
                       Frontier::Pair& at, float& bound) {
  const Node* const nodes[2] = {&search.a.nodes[at.a], &search.b.nodes[at.b]};
  // A leaf's size counts as negative.
  const auto rank = [](const Node& n) { return n.child < 0 ? -1.0F : n.size; };
  const uint32_t side = rank(*nodes[0]) > rank(*nodes[1]) ? 0 : 1;
  const Node& parent = *nodes[side];
  const Tree& tree = *sides.trees[side];
  const Block& block = tree.blocks[static_cast<size_t>(parent.child)];
  const uint32_t count = tree.counts[static_cast<size_t>(parent.child)];
  MovedNode moved;
  move(*nodes[1 - side], *sides.to[side], search.frames.pad, moved);
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
  Box moved_box;
  bool box_moved = false;
  for (uint32_t left = near; left != 0; left &= left - 1) {
    const uint32_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
    const uint32_t child = parent.first_child + lane;
    if ((tree.nodes[child].flat | nodes[1 - side]->flat) == 0) continue;
    if (!box_moved) {
      const Tree& other = *sides.trees[1 - side];
      move(other.boxes[side == 0 ? at.b : at.a], *sides.to[side], moved_box);
      box_moved = true;
    }
    const float lower = boxDistance(tree.boxes[child], moved_box, search.frames.pad);
    if (lower > 0 && lower >= search.judge.prune_at) near ^= 1U << lane;
    bounds[lane] = std::max(bounds[lane], lower > 0 ? lower : bounds[lane]);
  }
  if (HWY_UNLIKELY(search.audit != nullptr))
    reportPruned(search, parent, count, side, at, near, bounds);
  if (near == 0) return false;
  uint32_t pair[2] = {at.a, at.b};
  const auto pairOf = [&](uint32_t lane) {
    pair[side] = parent.first_child + lane;
    return Frontier::Pair{pair[0], pair[1]};
  };
  uint32_t nearest = hwy::Num0BitsBelowLS1Bit_Nonzero32(near);
  frontier.reserve(kLanes);
  for (near &= near - 1; near != 0; near &= near - 1) {
    const uint32_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(near);
    const bool nearer = bounds[lane] < bounds[nearest];
    const uint32_t other = nearer ? nearest : lane;
    nearest = nearer ? lane : nearest;
    frontier.push(bounds[other], pairOf(other));
  }
  bound = bounds[nearest];
  at = pairOf(nearest);
  return true;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
