// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

using VU = hn::Vec<DU>;

HWY_INLINE uint32_t firstOf(uint32_t bits) {
  return static_cast<uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
}

HWY_INLINE uint32_t bitsOf(hn::Mask<D> mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// The lanes, as bits, in which test(l), of the lanes from l on, holds.
template <class Test>
HWY_INLINE uint32_t lanesWhere(const Test& test) {
  uint32_t bits = 0;
  for (size_t l = 0; l < kLanes; l += step()) bits |= bitsOf(test(l)) << l;
  return bits;
}

HWY_INLINE hn::Mask<DU> maskOf(uint32_t bits) {
  const uint8_t bytes[8] = {static_cast<uint8_t>(bits)};
  return hn::LoadMaskBits(du, bytes);
}

/// Moves some lanes, given as bits, to the front; what follows them may be anything.
class ToFront {
 public:
#if HWY_TARGET == HWY_AVX3  // an instruction does it
  explicit ToFront(uint32_t bits) : lanes_(maskOf(bits)) {}

  V operator()(V v) const { return hn::Compress(v, hn::RebindMask(d, lanes_)); }
  VU operator()(VU v) const { return hn::Compress(v, lanes_); }

 private:
  const hn::Mask<DU> lanes_;
#else  // hn::Compress() of Highway 1.0 copies its table to the stack with some compilers
  explicit ToFront(uint32_t bits)
      : order_(hn::IndicesFromVec(
            d, hn::PromoteTo(du, hn::LoadU(hn::Rebind<uint8_t, D>(), kLaneOrder[bits].data())))) {}

  V operator()(V v) const { return hn::TableLookupLanes(v, order_); }
  VU operator()(VU v) const {
    return hn::BitCast(du, hn::TableLookupLanes(hn::BitCast(d, v), order_));
  }

 private:
  const decltype(hn::IndicesFromVec(d, hn::Zero(du))) order_;
#endif
};

/// Brings something into the caches. What only fetches has to be inlined: compilers drop calls of
/// functions without effects.
template <class T>
HWY_INLINE void fetch(const T& data) {
  constexpr size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(&data);
  for (size_t at = 0; at < sizeof(T); at += kLine) hwy::Prefetch(bytes + at);
}

/// Nodes of a and b; which fields hold something else is said where it is so.
struct NodePair {
  uint32_t a, b;
};

/// Pairs of nodes with lower bounds of their distances, in arrays. Lanes are pushed without a
/// branch: which of them matter can't be predicted.
class NodePairList {
 public:
  struct Entry {
    float bound;
    NodePair pair;
  };

  NodePairList() = default;
  NodePairList(const NodePairList&) = delete;
  NodePairList& operator=(const NodePairList&) = delete;

  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }
  size_t size() const { return size_; }

  /// Room for so many more.
  void reserve(size_t more) {
    if (HWY_UNLIKELY(size_ + more + kRoom > capacity_)) grow(2 * (size_ + more + kRoom));
  }

  /// There must be room: see reserve().
  void push(float bound, NodePair pair) {
    bounds_[size_] = bound;
    a_[size_] = pair.a;
    b_[size_] = pair.b;
    ++size_;
  }
  void push(uint32_t lanes, V bounds, VU a, VU b) {
    const ToFront to_front(lanes);
    const size_t at = size_;  // stores may alias members
    float* const to_bounds = bounds_ + at;
    uint32_t *const to_a = a_ + at, *const to_b = b_ + at;
    size_ = at + hwy::PopCount(lanes);
    hn::StoreU(to_front(bounds), d, to_bounds);
    hn::StoreU(to_front(a), du, to_a);
    hn::StoreU(to_front(b), du, to_b);
  }

  /// Swaps an entry with the last.
  void raise(size_t i) {
    const size_t last = std::max(i + 1, size_) - 1;  // i itself, where there is none
    std::swap(bounds_[i], bounds_[last]);
    std::swap(a_[i], a_[last]);
    std::swap(b_[i], b_[last]);
  }

  Entry pop() {
    --size_;
    return {bounds_[size_], {a_[size_], b_[size_]}};
  }

  /// Pops up to `most`; returns how many.
  template <size_t kMax>
  size_t pop(Entry (&out)[kMax], size_t max_count = kMax) {
    static_assert(kMax <= kRoom);
    const size_t count = std::min(max_count, size_);
    size_ -= count;
    for (size_t i = 0; i < kMax; ++i) {  // there is room for all of them beyond the end
      out[i] = {bounds_[size_ + i], {a_[size_ + i], b_[size_ + i]}};
    }
    return count;
  }

  /// The least bound of all; infinity if empty.
  float least() const {
    V least = set(kInfinityFloat);
    for (size_t i = 0; i < size_; i += step()) {
      least = hn::Min(least, boundsAt(i, (1U << std::min(size_ - i, step())) - 1));
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
  }

  /// Takes everything out, lanes by lanes: take(lanes, bounds, a, b) may push up to as many again.
  /// Bounds of lanes beyond the end are infinity.
  template <class Take>
  void takeAll(const Take& take) {
    const size_t size = size_;
    size_ = 0;
    for (size_t i = 0; i < size; i += step()) {
      const uint32_t used = (1U << std::min(size - i, step())) - 1;
      const V bounds = boundsAt(i, used);
      const VU a = hn::LoadU(du, a_ + i), b = hn::LoadU(du, b_ + i);
      take(used, bounds, a, b);
    }
  }

 private:
  /// Loads the bounds of these lanes; infinity elsewhere, where memory may hold anything, also what
  /// traps.
  V boundsAt(size_t i, uint32_t used) const {
    return hn::IfThenElse(hn::RebindMask(d, maskOf(used)), hn::LoadU(d, bounds_ + i),
                          set(kInfinityFloat));
  }

  HWY_NOINLINE void grow(size_t capacity) {
    std::unique_ptr<float[]> bounds(new float[capacity]);  // not zeroed, as a vector would be
    std::unique_ptr<uint32_t[]> pairs(new uint32_t[2 * capacity]);
    std::copy_n(bounds_, size_, bounds.get());
    std::copy_n(a_, size_, pairs.get());
    std::copy_n(b_, size_, pairs.get() + capacity);
    more_bounds_ = std::move(bounds);
    more_pairs_ = std::move(pairs);
    bounds_ = more_bounds_.get();
    a_ = more_pairs_.get();
    b_ = a_ + capacity;
    capacity_ = capacity;
  }

  static constexpr size_t kUsual = 512;        ///< of most searches
  static constexpr size_t kRoom = 2 * kLanes;  ///< beyond the end, for whole vectors and batches
  size_t size_ = 0, capacity_ = kUsual;
  float* bounds_ = usual_bounds_;
  uint32_t *a_ = usual_a_, *b_ = usual_b_;
  float usual_bounds_[kUsual];
  uint32_t usual_a_[kUsual], usual_b_[kUsual];
  std::unique_ptr<float[]> more_bounds_;
  std::unique_ptr<uint32_t[]> more_pairs_;
};

/// Pairs that wait. Those that overlap must all be looked at: they are at hand, the last in first.
/// Those apart wait for their turn in waves, the nearest first.
class Frontier {
 public:
  Frontier() { hn::Store(set(kInfinityFloat), d, least_); }

  // At hand:
  NodePairList inner;    ///< pairs of nodes not both of which are leaves
  NodePairList leaves;   ///< pairs of leaves
  NodePairList bounded;  ///< in `a`, what keep() was told

  /// There is room for a vector of lanes in each list after this.
  void reserve() {
    for (NodePairList* const list : {&inner, &leaves, &apart_inner_, &apart_leaves_}) {
      list->reserve(kLanes);
    }
  }

  /// Pushes some lanes, of which some are pairs of leaves. There must be room: see reserve().
  void push(uint32_t lanes, uint32_t are_leaves, V bounds, VU a, VU b) {
    const uint32_t overlapping = lanes & bitsOf(hn::Le(bounds, hn::Zero(d)));
    if (overlapping != 0) {  // never where models are apart, but near the roots
      leaves.push(overlapping & are_leaves, bounds, a, b);
      inner.push(overlapping & ~are_leaves, bounds, a, b);
    }
    const uint32_t apart = lanes & ~overlapping;
    if (apart == 0) return;  // always in contact
    apart_leaves_.push(apart & are_leaves, bounds, a, b);
    apart_inner_.push(apart & ~are_leaves, bounds, a, b);
    note(apart, bounds);
  }

  /// A pair whose bound is known, and which waits again.
  void keep(float bound, uint32_t index) {
    apart_bounded_.reserve(1);
    apart_bounded_.push(bound, {index, 0});
    hn::Store(hn::Min(hn::Load(d, least_), set(bound)), d, least_);
  }

  bool empty() const {
    return inner.empty() && leaves.empty() && bounded.empty() && apart_inner_.empty() &&
           apart_leaves_.empty() && apart_bounded_.empty();
  }

  /// The least bound of all; infinity if empty.
  HWY_NOINLINE float least() const {
    return std::min({inner.least(), leaves.least(), bounded.least(), apart_inner_.least(),
                     apart_leaves_.least(), apart_bounded_.least()});
  }

  /// Takes at hand what is nearest of what is apart: a `share` of the way to `cull_distance`, all
  /// of which must be looked at anyway if the answer is beyond. What is as far as `cull_distance`
  /// is dropped. False if that is all.
  bool nextWave(float cull_distance, float share) {
    const float least = hn::GetLane(hn::MinOfLanes(d, hn::Load(d, least_)));
    hn::Store(set(kInfinityFloat), d, least_);
    if (!(least < cull_distance)) {  // also where nothing is left: infinities aren't subtracted
      for (NodePairList* const list : {&apart_inner_, &apart_leaves_, &apart_bounded_})
        list->clear();
      return false;
    }
    const float at_most = cull_distance < kInfinityFloat ? least + share * (cull_distance - least)
                                                         : (1 + share / 4) * least;
    const V most = set(std::max(at_most, least)), limit = set(cull_distance);
    const auto take = [&](NodePairList& apart, NodePairList& at_hand) {
      at_hand.reserve(apart.size());
      apart.takeAll([&](uint32_t lanes, V bounds, VU a, VU b) {
        const uint32_t kept = lanes & bitsOf(hn::Lt(bounds, limit));
        const uint32_t near = kept & bitsOf(hn::Le(bounds, most));
        at_hand.push(near, bounds, a, b);
        apart.push(kept & ~near, bounds, a, b);
        note(kept & ~near, bounds);
      });
    };
    take(apart_inner_, inner);
    take(apart_leaves_, leaves);
    take(apart_bounded_, bounded);
    return true;
  }

 private:
  /// That some lanes of what is apart have these bounds.
  void note(uint32_t lanes, V bounds) {
    const auto apart = hn::RebindMask(d, maskOf(lanes));
    const V least = hn::Load(d, least_);
    hn::Store(hn::Min(least, hn::IfThenElse(apart, bounds, least)), d, least_);
  }

  NodePairList apart_inner_, apart_leaves_, apart_bounded_;
  alignas(32) float least_[kLanes];  ///< the least bounds of what is apart are among these
};

/// What waits in a search that goes depth first: few of them need more room.
template <class Item>
using DepthFirst = boost::container::small_vector<Item, 256>;

/// Nodes of a tree, of each node's children the nearest first.
class WaitingNodes {
 public:
  struct Item {
    float bound;
    uint32_t node;
  };

  explicit WaitingNodes(const Tree& tree) : tree_(tree) {
    waiting_.push_back({-kInfinityFloat, 0});
  }

  /// Visits all nodes but those whose bound isFar(): until leaf() returns true, and open() adds the
  /// children of an inner node by push().
  template <class IsFar, class LeafOf, class Open>
  HWY_INLINE void walk(const IsFar& isFar, const LeafOf& leaf, const Open& open) {
    while (!waiting_.empty()) {
      const Item at = waiting_.back();
      waiting_.pop_back();
      if (isFar(at.bound)) continue;
      const Node& node = tree_.nodes[at.node];
      if (!node.isLeaf()) {
        open(node);
      } else if (leaf(tree_.leaves[node.leaf()])) {
        return;
      }
    }
  }
  /// Adds some lanes of the children of a node.
  HWY_INLINE void push(uint32_t lanes, const float* bounds, uint32_t first_child) {
    const size_t first = waiting_.size();
    for (; lanes != 0; lanes &= lanes - 1) {
      const uint32_t lane = firstOf(lanes);
      size_t place = waiting_.size();
      waiting_.emplace_back();
      for (; place > first && waiting_[place - 1].bound < bounds[lane]; --place) {
        waiting_[place] = waiting_[place - 1];
      }
      waiting_[place] = {bounds[lane], first_child + lane};
      hwy::Prefetch(&tree_.nodes[first_child + lane]);
    }
  }

 private:
  const Tree& tree_;
  DepthFirst<Item> waiting_;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
