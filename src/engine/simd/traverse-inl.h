// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

HWY_INLINE uint32_t firstOf(uint32_t bits) {
  return static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
}

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

  /// The least bound of all; infinity if empty.
  HWY_NOINLINE float least() const {
    float least = std::numeric_limits<float>::infinity();
    if (empty()) return least;
    uint32_t entry = head_[hwy::Num0BitsBelowLS1Bit_Nonzero64(filled_)];
    for (; entry != kEnd; entry = entries_[entry].next) {
      least = std::min(least, entries_[entry].bound);
    }
    return least;
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

/// An inner pair of nodes under test: the children of the larger node (a leaf is not expanded)
/// against the other.
struct Expansion {
  Frontier::Pair at;
  uint32_t side;  ///< whose node is expanded: 0 of a, 1 of b
  const Node* parent;
  const Node* other;
  uint32_t near;  ///< children that matter, as bits
  float bound;    ///< of the pair; not used by all searches
  alignas(32) float bounds[kLanes];
};

/// Expansions come in batches: what one waits for overlaps with the work of another.
class Expander {
 public:
  explicit Expander(const Search& search)
      : search_(search),
        trees_{&search.a, &search.b},
        to_{&search.frames.a_from_b, &search.frames.b_from_a},
        boxes_(!search.a.boxes.empty() && !search.b.boxes.empty()) {}

  void start(Frontier::Pair at, Expansion& e) const {
    const Node* const nodes[2] = {&search_.a.nodes[at.a], &search_.b.nodes[at.b]};
    const auto rank = [](const Node& n) { return n.child < 0 ? -1.0F : n.size; };
    e.at = at;
    e.side = rank(*nodes[0]) > rank(*nodes[1]) ? 0 : 1;
    e.parent = nodes[e.side];
    e.other = nodes[1 - e.side];
    const char* const block = reinterpret_cast<const char*>(&blockOf(e));
    for (size_t line = 0; line < sizeof(Block); line += 64) hwy::Prefetch(block + line);
  }

  void test(Expansion& e) const {
    MovedNode moved;
    move(*e.other, *to_[e.side], search_.frames.pad, moved);
    const Block& block = blockOf(e);
    const V limit = hn::Set(d, search_.judge.prune_at);
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V lower = lowerBounds(block, l, moved);
      hn::Store(lower, d, e.bounds + l);
      e.near |= bitsOf(hn::Lt(lower, limit)) << l;
    }
    e.near &= childrenOf(e).all();
    ++search_.counts.expansions;
    search_.counts.volume_tests += childrenOf(e).count;
  }

  Frontier::Pair childPair(const Expansion& e, uint32_t lane) const {
    const uint32_t child = e.parent->first_child + lane;
    return e.side == 0 ? Frontier::Pair{child, e.at.b} : Frontier::Pair{e.at.a, child};
  }

  /// The children that matter join the frontier, the nearest last. If kInherit, bounds are at least
  /// the pair's, and those `taken` (bits) don't join.
  template <bool kInherit = false>
  void spread(Expansion& e, Frontier& frontier, uint32_t taken = 0) const {
    if constexpr (kInherit) {
      const V limit = hn::Set(d, search_.judge.prune_at), least = hn::Set(d, e.bound);
      uint32_t near = 0;
      for (size_t l = 0; l < kLanes; l += step()) {
        const V bounds = hn::Max(hn::Load(d, e.bounds + l), least);
        hn::Store(bounds, d, e.bounds + l);
        near |= bitsOf(hn::Lt(bounds, limit)) << l;
      }
      e.near &= near & ~taken;
    }
    const uint32_t flat = e.near & (e.other->flat != 0 ? e.near : childrenOf(e).flat);
    if (flat != 0 && boxes_) testBoxes(e, flat);
    if (HWY_UNLIKELY(search_.audit != nullptr)) reportPruned(e, taken);
    if (e.near == 0) return;
    frontier.reserve(kLanes);
    uint32_t nearest = firstOf(e.near);
    for (uint32_t left = e.near & (e.near - 1); left != 0; left &= left - 1) {
      const uint32_t lane = firstOf(left);
      const bool nearer = e.bounds[lane] < e.bounds[nearest];
      const uint32_t other = nearer ? nearest : lane;
      nearest = nearer ? lane : nearest;
      frontier.push(e.bounds[other], childPair(e, other));
      prefetchNode(e, other);
    }
    frontier.push(e.bounds[nearest], childPair(e, nearest));
    prefetchNode(e, nearest);
  }

 private:
  void prefetchNode(const Expansion& e, uint32_t lane) const {
    const Node* const child = &trees_[e.side]->nodes[e.parent->first_child + lane];
    hwy::Prefetch(child);
    hwy::Prefetch(reinterpret_cast<const char*>(child) + sizeof(Node) - 1);
  }

  const Block& blockOf(const Expansion& e) const {
    return trees_[e.side]->blocks[static_cast<size_t>(e.parent->child)];
  }
  const Children& childrenOf(const Expansion& e) const {
    return trees_[e.side]->children[static_cast<size_t>(e.parent->child)];
  }

  HWY_NOINLINE void testBoxes(Expansion& e, uint32_t flat) const {
    const Tree &tree = *trees_[e.side], &other = *trees_[1 - e.side];
    Box moved_box;
    move(other.boxes[e.side == 0 ? e.at.b : e.at.a], *to_[e.side], moved_box);
    for (; flat != 0; flat &= flat - 1) {
      const uint32_t lane = firstOf(flat);
      const float lower =
          boxDistance(tree.boxes[e.parent->first_child + lane], moved_box, search_.frames.pad);
      if (!(lower > 0)) continue;  // 0 says nothing
      e.bounds[lane] = std::max(e.bounds[lane], lower);
      if (lower >= search_.judge.prune_at) e.near ^= 1U << lane;
    }
  }

  HWY_NOINLINE void reportPruned(const Expansion& e, uint32_t taken) const {
    for (uint32_t left = childrenOf(e).all() & ~e.near & ~taken; left != 0; left &= left - 1) {
      const uint32_t lane = firstOf(left), child = e.parent->first_child + lane;
      search_.audit->pruned(e.side == 0 ? child : e.at.a, e.side == 0 ? e.at.b : child,
                            e.bounds[lane]);
    }
  }

  const Search& search_;
  const Tree* trees_[2];
  const FloatPose* to_[2];  ///< the frame of a side from the other's
  const bool boxes_;        ///< both trees have them
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
