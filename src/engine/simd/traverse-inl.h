// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// An inner pair of nodes under test: the children of the larger node (a leaf is not expanded)
/// against the other.
struct Expansion {
  Pair at;
  uint32_t side;  ///< whose node is expanded: 0 of a, 1 of b
  const Node* parent;
  const Node* other;
  uint32_t near;  ///< children that matter, as bits
  bool tight;     ///< whether boxes were tested
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
        boxes_(!search.a.boxes.empty() && !search.b.boxes.empty()),
        large_(search.a.blocks.size() + search.b.blocks.size() > 300) {}

  void start(Pair at, Expansion& e) const {
    const Node* const nodes[2] = {&search_.a.nodes[at.a], &search_.b.nodes[at.b]};
    const auto rank = [](const Node& n) {  // sizes order like their bits; a leaf comes below all
      int32_t bits;
      std::memcpy(&bits, &n.size, sizeof(bits));
      return bits | (n.child >> 31);
    };
    e.at = at;
    e.side = rank(*nodes[0]) > rank(*nodes[1]) ? 0 : 1;
    e.parent = nodes[e.side];
    e.other = nodes[1 - e.side];
    fetch(blockOf(e));
  }

  void test(Expansion& e) const {
    MovedNode moved;
    move(*e.other, *to_[e.side], search_.frames.pad, moved);
    const Block& block = blockOf(e);
    const V limit = hn::Set(d, search_.evaluator.prune_at);
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V lower = lowerBounds(block, l, moved);
      hn::Store(lower, d, e.bounds + l);
      e.near |= bitsOf(hn::Lt(lower, limit)) << l;
    }
    e.near &= childrenOf(e).all();
    e.tight = false;
    ++search_.counts.expansions;
    search_.counts.volume_tests += childrenOf(e).count;
  }

  /// The children that matter and that spheres bound badly: flat ones, and in contact those that
  /// overlap by little.
  uint32_t flatOf(const Expansion& e) const {
    if (e.other->flat != 0) return e.near;
    uint32_t flat = childrenOf(e).flat;
    if (search_.evaluator.prune_at == 0) {
      constexpr float kLittle = 0.25F;  // of the smaller node; found by trying
      const V least = hn::Set(d, -kLittle * std::min(e.parent->size, e.other->size));
      for (size_t l = 0; l < kLanes; l += step()) {
        flat |= bitsOf(hn::Gt(hn::Load(d, e.bounds + l), least)) << l;
      }
    }
    return e.near & flat;
  }
  /// Tests boxes too, once, if that helps any child.
  void tighten(Expansion& e) const {
    if (flatOf(e) == 0 || !boxes_ || e.tight) return;
    e.tight = true;
    testBoxes(e);
  }

  /// Whether both trees have boxes: those of CAD meshes.
  bool hasBoxes() const { return boxes_; }
  /// Whether the trees are more than a core's caches hold, so that it pays to fetch what is needed
  /// next, as much of it at once as there is; a limit found by trying.
  bool isLarge() const { return large_; }

  HWY_INLINE void fetchNodes(Pair at) const {
    fetch(search_.a.nodes[at.a]);
    fetch(search_.b.nodes[at.b]);
  }
  /// The boxes that may be tested.
  HWY_INLINE void fetchBoxes(const Expansion& e) const {
    if (!boxes_ || (childrenOf(e).flat | e.other->flat) == 0) return;
    fetch(boxBlockOf(e));
    fetch(otherBox(e));
  }

  /// Tests pairs, several at once as their steps overlap; the children that matter join the
  /// frontier.
  template <bool kInherit, size_t kMax>
  void expand(const PairList::Entry (&pairs)[kMax], size_t count, Frontier& frontier) const {
    Expansion batch[kMax];
    size_t n = 0;
    for (size_t i = 0; large_ && i < count; ++i) fetchNodes(pairs[i].pair);
    for (size_t i = 0; i < count; ++i) {
      if (pairs[i].bound >= search_.evaluator.prune_at) continue;
      batch[n].bound = pairs[i].bound;
      start(pairs[i].pair, batch[n++]);
    }
    for (size_t i = 0; large_ && i < n; ++i) fetchBoxes(batch[i]);
    for (size_t i = 0; i < n; ++i) test(batch[i]);
    for (size_t i = 0; i < n; ++i) spread<kInherit>(batch[i], frontier);
  }

  void pushRoots(Frontier& frontier) const {
    const bool leaves = trees_[0]->nodes[0].isLeaf() && trees_[1]->nodes[0].isLeaf();
    (leaves ? frontier.leaves : frontier.inner)
        .push(-std::numeric_limits<float>::infinity(), {0, 0});
  }

  Pair childPair(const Expansion& e, uint32_t lane) const {
    const uint32_t child = e.parent->first_child + lane;
    return e.side == 0 ? Pair{child, e.at.b} : Pair{e.at.a, child};
  }

  /// The children that matter join the frontier. If kInherit, bounds are at least the pair's, and
  /// those `taken` (bits) don't join.
  template <bool kInherit>
  void spread(Expansion& e, Frontier& frontier, uint32_t taken = 0) const {
    if constexpr (kInherit) {
      const V limit = hn::Set(d, search_.evaluator.prune_at), least = hn::Set(d, e.bound);
      uint32_t near = 0;
      for (size_t l = 0; l < kLanes; l += step()) {
        const V bounds = hn::Max(hn::Load(d, e.bounds + l), least);
        hn::Store(bounds, d, e.bounds + l);
        near |= bitsOf(hn::Lt(bounds, limit)) << l;
      }
      e.near &= near & ~taken;
    }
    tighten(e);
    if (HWY_UNLIKELY(search_.audit != nullptr)) reportPruned(e, taken);
    const uint32_t leaves = childrenOf(e).leaves & (e.other->isLeaf() ? ~0U : 0U);
    const VU expanded = hn::Set(du, e.side == 0 ? ~0U : 0U),
             first = hn::Set(du, e.parent->first_child);
    const VU a = hn::Set(du, e.at.a), b = hn::Set(du, e.at.b);
    frontier.reserve();
    const size_t deepest = frontier.inner.size() + deepestOf(e, leaves);
    const uint32_t all_lanes = (1U << step()) - 1;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V bounds = hn::Load(d, e.bounds + l);
      const VU child = hn::Add(first, hn::Iota(du, static_cast<uint32_t>(l)));
      frontier.push(e.near >> l & all_lanes, leaves >> l, bounds,
                    hn::IfVecThenElse(expanded, child, a), hn::IfVecThenElse(expanded, b, child));
    }
    frontier.inner.raise(deepest);
  }

 private:
  /// Of the children that overlap and are not pairs of leaves, returns how many precede the
  /// deepest.
  static uint32_t deepestOf(const Expansion& e, uint32_t leaves) {
    const uint32_t children = e.near & ~leaves;
    V least = hn::Zero(d);
    for (size_t l = 0; l < kLanes; l += step()) {
      const V bounds = hn::Load(d, e.bounds + l);
      least = hn::Min(least, hn::IfThenElseZero(hn::RebindMask(d, maskOf(children >> l)), bounds));
    }
    least = hn::MinOfLanes(d, least);
    uint32_t overlapping = 0, deepest = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V bounds = hn::Load(d, e.bounds + l);
      overlapping |= bitsOf(hn::Le(bounds, hn::Zero(d))) << l;
      deepest |= bitsOf(hn::Eq(bounds, least)) << l;
    }
    overlapping &= children;
    return static_cast<uint32_t>(
        hwy::PopCount(overlapping & (firstBit(deepest & overlapping) - 1)));
  }
  static uint32_t firstBit(uint32_t bits) { return bits & (0U - bits); }  // 0 for none

  const Block& blockOf(const Expansion& e) const {
    return trees_[e.side]->blocks[static_cast<size_t>(e.parent->child)];
  }
  const Children& childrenOf(const Expansion& e) const {
    return trees_[e.side]->children[static_cast<size_t>(e.parent->child)];
  }

  const BoxBlock& boxBlockOf(const Expansion& e) const {
    return trees_[e.side]->box_blocks[static_cast<size_t>(e.parent->child)];
  }
  const Box& otherBox(const Expansion& e) const {
    return trees_[1 - e.side]->boxes[e.side == 0 ? e.at.b : e.at.a];
  }

  HWY_NOINLINE void testBoxes(Expansion& e) const {
    Box moved;
    move(otherBox(e), *to_[e.side], moved);
    const BoxLanes other(moved);
    const BoxBlock& block = boxBlockOf(e);
    const bool contact = search_.evaluator.prune_at == 0;
    const V limit = hn::Set(d, search_.evaluator.prune_at);
    uint32_t near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const BoxLanes boxes(block, l);
      const V lower = contact ? contactBounds(boxes, other, search_.frames.box_pad)
                              : distanceBounds(boxes, other, search_.frames.box_pad);
      const V bounds = hn::Load(d, e.bounds + l);
      const V least = hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, lower), bounds);
      hn::Store(least, d, e.bounds + l);
      near |= bitsOf(hn::Lt(least, limit)) << l;
    }
    e.near &= near;
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
  const bool large_;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
