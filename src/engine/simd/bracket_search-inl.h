// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// As DistanceSearch, with a proven lower bound, and less work where an error is allowed: the
/// vertices of two leaves that a slab was tried on are an upper bound that prunes, as their pair is
/// judged in the end if nothing nearer was found.
///
/// What was not judged is still in the frontier, or was left out as not nearer than prune_at, which
/// only falls. So min(prune_at, bounds of the frontier) bounds it at any time, and the largest such
/// value of a search is what it proved. Bounds of the frontier never fall, as pairs inherit
/// their parents': it suffices to look whenever prune_at is about to fall.
class BracketSearch {
 public:
  explicit BracketSearch(const Search& search)
      : search_(search), bracket_(*search.bracket), expander_(search) {}

  void run() {
    frontier_.push(-kInfinity, {0, 0});
    lowerTo(search_.judge.prune_at);
    Expansion batch[kBatch];
    long long left = bracket_.max_expansions;
    bool done = false;
    while (!done && !frontier_.empty()) {
      const size_t wanted = prune_at_ < kInfinity ? kBatch : 1;
      if (left < static_cast<long long>(wanted)) {  // of whole batches, so that more never differs
        bracket_.out_of_budget = true;
        break;
      }
      size_t n = 0;
      while (n < wanted && !frontier_.empty() && !done) {
        const Frontier::Entry entry = frontier_.pop();
        if (entry.bound >= prune_at_) continue;
        if (isInner(entry.pair)) {
          in_flight_ = std::min(in_flight_, entry.bound);
          expander_.start(entry.pair, batch[n]);
          batch[n++].bound = entry.bound;
        } else {
          current_ = entry.bound;
          done = leaves(entry);
          if (!done) current_ = kInfinity;
        }
      }
      if (done) break;
      left -= static_cast<long long>(n);
      for (size_t i = 0; i < n; ++i) expander_.test(batch[i]);
      for (size_t i = 0; i < n; ++i) expander_.spread<true>(batch[i], frontier_);
      in_flight_ = kInfinity;
    }
    prove();
    if (!done && best_ != kNone) nearest(waiting_[best_], best_bound_);
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  static constexpr size_t kBatch = 4;
  static constexpr uint32_t kWaiting = 1U << 31;  ///< instead of node a: an index of waiting_
  static constexpr uint32_t kMaxWaiting = 256;
  static constexpr uint32_t kNone = ~uint32_t{0};

  const Node& nodeA(Frontier::Pair at) const { return search_.a.nodes[at.a]; }
  const Node& nodeB(Frontier::Pair at) const { return search_.b.nodes[at.b]; }
  bool isInner(Frontier::Pair at) const {
    return (at.a & kWaiting) == 0 && !(nodeA(at).isLeaf() && nodeB(at).isLeaf());
  }

  void prove() {
    const float least = std::min({in_flight_, current_, frontier_.least()});
    bracket_.proven = std::max(bracket_.proven, std::min(prune_at_, least));
  }

  void lowerTo(float prune_at) {
    if (!(prune_at < prune_at_)) return;
    if (prune_at_ < kInfinity) prove();
    prune_at_ = prune_at;
    frontier_.setUpperBound(prune_at);
  }

  /// True to end the search.
  bool leaves(const Frontier::Entry& entry) {
    if ((entry.pair.a & kWaiting) != 0) {
      const uint32_t index = entry.pair.a & ~kWaiting;
      if (index == best_) best_ = kNone;
      return nearest(waiting_[index], entry.bound);
    }
    ++search_.counts.leaf_pairs;
    const bool full = num_waiting_ + 1 == kMaxWaiting;
    const uint32_t index = num_waiting_;
    Slabbed& slabbed = waiting_[index];
    slabbed.nodes = entry.pair;
    const float known = search_.judge.keep_to;
    const float by_slab =
        boundOfLeaves(search_, leafA(entry.pair), leafB(entry.pair), slabbed.slab);
    const bool nearer = search_.judge.keep_to < known;
    const float bound = std::max(entry.bound, by_slab);
    if (!nearer && bound >= prune_at_) {
      if (search_.audit) search_.audit->pruned(entry.pair.a, entry.pair.b, prune_at_);
      return false;
    }
    // Judged at once: it ends the search, has no room to wait, or must count whatever comes.
    const bool ends = search_.judge.keep_to <= bracket_.near_enough;
    if (full || (nearer && (ends || eager()))) return nearest(slabbed, bound);
    ++num_waiting_;
    if (nearer) {
      best_ = index;
      best_bound_ = bound;
    }
    frontier_.reserve(1);
    frontier_.push(bound, {kWaiting | index, 0});
    current_ = kInfinity;
    lowerTo(search_.judge.prune_at);
    return false;
  }

  /// With a budget, answers must not get worse as it grows.
  bool eager() const { return bracket_.max_expansions != std::numeric_limits<long long>::max(); }

  const Leaf& leafA(Frontier::Pair at) const { return search_.a.leaves[nodeA(at).leaf()]; }
  const Leaf& leafB(Frontier::Pair at) const { return search_.b.leaves[nodeB(at).leaf()]; }

  bool nearest(const Slabbed& slabbed, float bound) {
    const bool done =
        nearestOfLeaves(search_, leafA(slabbed.nodes), leafB(slabbed.nodes), slabbed.slab, bound);
    if (!done) current_ = kInfinity;  // all of it was judged
    lowerTo(search_.judge.prune_at);
    return done;
  }

  const Search& search_;
  Bracket& bracket_;
  const Expander expander_;
  Frontier frontier_;
  float prune_at_ = kInfinity;
  float in_flight_ = kInfinity;  ///< least bound of what is being expanded
  float current_ = kInfinity;    ///< bound of the leaves at hand
  uint32_t best_ = kNone;        ///< of waiting_: whose upper bound is the least, if not yet judged
  float best_bound_ = 0;         ///< its lower bound
  uint32_t num_waiting_ = 0;
  Slabbed waiting_[kMaxWaiting];
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
