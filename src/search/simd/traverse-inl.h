// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Leaves are split into their triangles in searches where a leaf of one tree is so many times as
/// wide as the mean leaf of the other is large; elsewhere it would cost more than it saves. Found
/// by trying.
HWY_INLINE bool splitsLeaves(const Search& search) {
  constexpr float kTimes = 8;
  return search.a.widest_leaf > kTimes * search.b.mean_leaf ||
         search.b.widest_leaf > kTimes * search.a.mean_leaf;
}

/// Expands pairs of nodes. The larger node is expanded, and a leaf is not, unless it is the larger
/// by far and splitsLeaves(): its triangles, which may lie anywhere in it, are then its children.
/// They stand for nodes until they meet a leaf.
///
/// Expansions come in batches: what one waits for overlaps with the work of another.
class Expander {
 public:
  explicit Expander(const Search& search)
      : search_(search),
        trees_{&search.a, &search.b},
        to_{&search.frames.a_from_b, &search.frames.b_from_a},
        has_boxes_{!search.a.boxes.empty(), !search.b.boxes.empty()},
        splits_(splitsLeaves(search)),
        balls_(hasSmallBalls()),
        budgeted_(search.bracket && search.bracket->hasBudget()),
        large_(search.a.blocks.size() + search.b.blocks.size() > 300) {}

  /// e.bound is that of the pair.
  void start(NodePair at, Expansion& e) const {
    e.at = at;
    if (HWY_UNLIKELY(isTriangle(at.a | at.b))) return startAgainstTriangle(e);
    const Node* const nodes[2] = {&search_.a.nodes[at.a], &search_.b.nodes[at.b]};
    const auto rank = [](const Node& n) {  // sizes order like their bits; a leaf comes below all
      int32_t bits;
      std::memcpy(&bits, &n.size, sizeof(bits));
      return bits | (n.child >> 31);
    };
    e.side = rank(*nodes[0]) > rank(*nodes[1]) ? 0 : 1;
    e.parent = nodes[e.side];
    e.other = nodes[1 - e.side];
    if (HWY_UNLIKELY(splits(e))) return startLeaf(e);
    startNode(e, Expanded::kNode);
  }

  [[gnu::hot]] void test(Expansion& e) const {
    if (HWY_UNLIKELY(e.kind != Expanded::kNode)) {
      testTriangles(e);
      if (e.kind != Expanded::kNode) {
        ++search_.counts.expansions;
        return;
      }
    }
    MovedNode moved;
    move(*e.other, *to_[e.side], search_.frames.pad, moved);
    const Block& block = blockOf(e);
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) keep(e, l, lowerBounds(block, l, moved));
    endTest(e);
    ++search_.counts.expansions;
  }

  /// The children that matter and that spheres bound badly: flat ones, and those that overlap, or
  /// are within what matters, by little, where that pays: in contact of boxes, and in distances of
  /// boxes and balls, but where a budget ends the search: it may not depend on what was found when.
  uint32_t flatOf(const Expansion& e) const {
    if (e.other->flat != 0) return e.near;
    uint32_t flat = e.children.flat;
    const float cull = search_.evaluator.cull_distance;
    if (isContact() ? hasBoxes() : balls_ && cull < kInfinityFloat && !budgeted_) {
      constexpr float kLittle = 0.25F;  // of the smaller node; found by trying
      const V least = hn::Set(d, cull - kLittle * std::min(e.parent->size, e.other->size));
      for (size_t l = 0; l < kLanes; l += step()) {
        flat |= bitsOf(hn::Gt(hn::Load(d, e.bounds + l), least)) << l;
      }
    }
    return e.near & flat;
  }
  /// Tests boxes too, once, if that helps any child.
  void tighten(Expansion& e) const {
    if (flatOf(e) == 0 || e.tight) return;
    e.tight = true;
    if (e.kind == Expanded::kNode && balls_) testBalls(e);
    if (hasBoxes(e) && e.near != 0) testBoxes(e);
  }

  /// Whether both trees have boxes: those of CAD meshes.
  bool hasBoxes() const { return has_boxes_[0] && has_boxes_[1]; }
  /// Whether the trees are more than a core's caches hold, so that it pays to fetch what is needed
  /// next, as much of it at once as there is; a limit found by trying.
  bool isLarge() const { return large_; }

  HWY_INLINE void fetchNodes(NodePair at) const {
    if (!isTriangle(at.a)) fetch(search_.a.nodes[at.a]);
    if (!isTriangle(at.b)) fetch(search_.b.nodes[at.b]);
  }
  /// The boxes that may be tested.
  HWY_INLINE void fetchBoxes(const Expansion& e) const {
    if (e.kind != Expanded::kNode || !hasBoxes() || (e.children.flat | e.other->flat) == 0) return;
    fetch(boxBlockOf(e));
    fetch(otherBox(e));
  }

  /// Tests pairs, several at once as their steps overlap; the children that matter join the
  /// frontier.
  template <bool kInherit, size_t kMax>
  [[gnu::hot]] void expand(const NodePairList::Entry (&pairs)[kMax], size_t count,
                           Frontier& frontier) const {
    Expansion batch[kMax];
    size_t n = 0;
    for (size_t i = 0; large_ && i < count; ++i) fetchNodes(pairs[i].pair);
    for (size_t i = 0; i < count; ++i) {
      if (pairs[i].bound >= search_.evaluator.cull_distance) continue;
      batch[n].bound = pairs[i].bound;
      start(pairs[i].pair, batch[n++]);
    }
    for (size_t i = 0; large_ && i < n; ++i) fetchBoxes(batch[i]);
    for (size_t i = 0; i < n; ++i) test(batch[i]);
    for (size_t i = 0; i < n; ++i) spread<kInherit>(batch[i], frontier);
  }

  void pushRoots(Frontier& frontier) const {
    const bool leaves = trees_[0]->nodes[0].isLeaf() && trees_[1]->nodes[0].isLeaf();
    (leaves ? frontier.leaves : frontier.inner).push(-kInfinityFloat, {0, 0});
  }

  bool areLeaves(NodePair at) const {
    const auto isLeaf = [](const Tree& tree, uint32_t node) {
      return isTriangle(node) || tree.nodes[node].isLeaf();
    };
    return isLeaf(search_.a, at.a) && isLeaf(search_.b, at.b);
  }

  NodePair childPair(const Expansion& e, uint32_t lane) const {
    const uint32_t child = e.first_child + lane;
    return e.side == 0 ? NodePair{child, e.at.b} : NodePair{e.at.a, child};
  }

  /// The children that matter join the frontier. If kInherit, bounds are at least the pair's, and
  /// those `taken` (bits) don't join.
  template <bool kInherit>
  void spread(Expansion& e, Frontier& frontier, uint32_t taken = 0) const {
    if constexpr (kInherit) {
      const V limit = hn::Set(d, search_.evaluator.cull_distance), least = hn::Set(d, e.bound);
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
    const uint32_t leaves = e.children.leaves & (e.other->isLeaf() ? ~0U : 0U);
    const VU expanded = hn::Set(du, e.side == 0 ? ~0U : 0U), first = hn::Set(du, e.first_child);
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
  /// Whether the smaller tree alone has no boxes: a round body, whose spheres fit better than those
  /// of ground.
  bool hasSmallBalls() const {
    if (has_boxes_[0] == has_boxes_[1]) return false;
    const Tree &boxed = *trees_[has_boxes_[0] ? 0 : 1], &other = *trees_[has_boxes_[0] ? 1 : 0];
    return other.nodes[0].size < boxed.nodes[0].size;
  }

  void startNode(Expansion& e, Expanded kind) const {
    e.kind = kind;
    e.children = trees_[e.side]->children[static_cast<size_t>(e.parent->child)];
    e.first_child = e.parent->first_child;
    fetch(blockOf(e));
  }
  [[gnu::hot]] HWY_NOINLINE void startAgainstTriangle(Expansion& e) const {
    e.side = isTriangle(e.at.a) ? 1 : 0;
    e.parent = &trees_[e.side]->nodes[e.side == 0 ? e.at.a : e.at.b];
    e.other = &kTriangleStandIn;
    startNode(e, Expanded::kNodeTriangle);
  }

  /// Whether to split the leaf that e.other may be: where the pair is nearer than the leaf is wide,
  /// and the node several times smaller; from farther, all its triangles look alike.
  bool splits(const Expansion& e) const {
    constexpr float kTimes = 4;  // found by trying
    return splits_ & e.other->isLeaf() & (e.bound + kTimes * e.parent->size < e.other->width);
  }
  [[gnu::hot]] HWY_NOINLINE void startLeaf(Expansion& e) const {
    std::swap(e.parent, e.other);
    e.side = 1 - e.side;
    e.kind = Expanded::kLeaf;
    const size_t leaf = e.parent->leaf();
    e.children.count = trees_[e.side]->leaves[leaf].num_faces;
    e.children.flat = e.children.leaves = 0xFF;
    e.first_child = kTriangleNode | static_cast<uint32_t>(leaf) << 3;
  }

  /// Whether nothing matters but what overlaps.
  bool isContact() const { return search_.evaluator.cull_distance == 0; }

  /// Notes the bounds of some lanes.
  HWY_INLINE void keep(Expansion& e, size_t l, V bounds) const {
    hn::Store(bounds, d, e.bounds + l);
    e.near |= bitsOf(hn::Lt(bounds, hn::Set(d, search_.evaluator.cull_distance))) << l;
  }
  HWY_INLINE void endTest(Expansion& e) const {
    e.near &= e.children.all();
    e.tight = false;
    search_.counts.volume_tests += e.children.count;
  }

  /// The children that matter whose bounds are at most so far below 0.
  uint32_t openOf(const Expansion& e, float pads) const {
    uint32_t open = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      open |= bitsOf(hn::Gt(hn::Load(d, e.bounds + l), hn::Set(d, -pads))) << l;
    }
    return e.near & open;
  }

  /// Spheres against prisms. Where most triangles of a leaf matter, it isn't split after all: the
  /// node is to be expanded, and tested, in its place.
  [[gnu::hot]] HWY_NOINLINE void testTriangles(Expansion& e) const {
    e.near = 0;
    if (e.kind == Expanded::kNodeTriangle) {
      testAgainstTriangle(e);
    } else {
      testLeaf(e);
    }
    endTest(e);
    if (isContact() && !has_boxes_[e.kind == Expanded::kNodeTriangle ? e.side : 1 - e.side]) {
      const uint32_t open = openOf(e, 2 * prismPad(search_.frames));
      if (HWY_UNLIKELY(open != 0)) testInDouble(e, open);
    }
    if (e.kind == Expanded::kNodeTriangle) return;
    if (!(search_.evaluator.cull_distance < kInfinityFloat)) return;
    tighten(e);
    if (2 * hwy::PopCount(e.near) <= e.children.count) return;
    std::swap(e.parent, e.other);
    e.side = 1 - e.side;
    startNode(e, Expanded::kNode);
  }
  [[gnu::hot]] void testLeaf(Expansion& e) const {
    const Node& other = *e.other;
    const Vec3 c = moved(*to_[e.side], {other.x[kCentral], other.y[kCentral], other.z[kCentral]});
    const V3 center = {hn::Set(d, c.x), hn::Set(d, c.y), hn::Set(d, c.z)};
    const V reach = hn::Set(d, other.r[kCentral] + prismPad(search_.frames));
    const LeafView leaf(*trees_[e.side], trees_[e.side]->leaves[e.parent->leaf()]);
    for (size_t l = 0; l < kLanes; l += step()) {
      keep(e, l, hn::Sub(prismsOf(leaf, l).distances(center), reach));
    }
  }
  [[gnu::hot]] void testAgainstTriangle(Expansion& e) const {
    const Tree& tree = *trees_[1 - e.side];
    const uint32_t triangle = otherId(e);
    const LeafView leaf(tree, tree.leaves[leafOfTriangle(triangle)]);
    const Prisms prism = movedPrism(leaf, laneOfTriangle(triangle), *to_[e.side]);
    const Block& block = blockOf(e);
    const V pad = hn::Set(d, prismPad(search_.frames));
    for (size_t l = 0; l < kLanes; l += step()) {
      const V3 c = {load(block.x[kCentral], l), load(block.y[kCentral], l),
                    load(block.z[kCentral], l)};
      V lower = hn::Sub(prism.distances(c), load(block.r[kCentral], l));
      if (!has_boxes_[e.side]) lower = hn::Max(lower, byCaps(block, l, prism, c));
      keep(e, l, hn::Sub(lower, pad));
    }
  }
  /// Bounds by the caps whose centres lie on the far sides of the triangle's plane from c.
  static V byCaps(const Block& block, size_t l, const Prisms& prism, const V3& c) {
    const V height = hn::Add(dot(prism.normal[0], c), prism.offset[0]);
    const auto byCap = [&](int middle, int half) {
      const V3 h = {load(block.x[half], l), load(block.y[half], l), load(block.z[half], l)};
      const V s = hn::And(hn::Xor(dot(prism.normal[0], h), height), hn::SignBit(d));
      const V3 cap = {hn::Add(load(block.x[middle], l), hn::Xor(h.x, s)),
                      hn::Add(load(block.y[middle], l), hn::Xor(h.y, s)),
                      hn::Add(load(block.z[middle], l), hn::Xor(h.z, s))};
      const V r = hn::Add(load(block.r[middle], l), hn::Xor(load(block.r[half], l), s));
      return hn::Sub(prism.distances(cap), r);
    };
    return hn::Max(byCap(kMiddle2, kHalf2), byCap(kMiddle1, kHalf1));
  }

  /// Returns how many of the children that overlap and are not pairs of leaves precede the deepest.
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
  const BoxBlock& boxBlockOf(const Expansion& e) const {
    return trees_[e.side]->box_blocks[static_cast<size_t>(e.parent->child)];
  }
  uint32_t otherId(const Expansion& e) const { return e.side == 0 ? e.at.b : e.at.a; }
  /// A root has a box in any tree, which pays in contact.
  bool hasOtherBox(const Expansion& e) const {
    return has_boxes_[1 - e.side] || (otherId(e) == 0 && isContact());
  }
  const Box& otherBox(const Expansion& e) const {
    const Tree& tree = *trees_[1 - e.side];
    return has_boxes_[1 - e.side] ? tree.boxes[otherId(e)] : tree.root_box;
  }

  /// Triangles have boxes wherever the other has one.
  bool hasBoxes(const Expansion& e) const {
    if (e.kind == Expanded::kNodeTriangle) return has_boxes_[e.side];
    return hasOtherBox(e) && (e.kind == Expanded::kLeaf || has_boxes_[e.side]);
  }

  /// Raises bounds by boxes.
  [[gnu::hot]] HWY_NOINLINE void testBoxes(Expansion& e) const {
    Box moved;
    const bool nodes = HWY_LIKELY(e.kind == Expanded::kNode);
    const BoxBlock& block = nodes ? boxBlockOf(e) : boxesOfTriangles(e, moved);
    if (nodes) move(otherBox(e), *to_[e.side], moved);
    const float pad = nodes ? search_.frames.box_pad : trianglePad(search_.frames);
    const BoxLanes other(moved);
    const bool contact = isContact();
    const uint32_t near = e.near;
    uint32_t open = 0;
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const BoxLanes boxes(block, l);
      const V lower =
          contact ? contactBounds(boxes, other, pad) : distanceBounds(boxes, other, pad);
      const V bounds = hn::Load(d, e.bounds + l);
      keep(e, l, hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, lower), bounds));
      open |= bitsOf(hn::Gt(lower, hn::Set(d, -2 * pad))) << l;
    }
    e.near &= near;
    if (HWY_UNLIKELY(contact && (open & e.near) != 0)) testInDouble(e, open & e.near);
  }

  /// Raises bounds by the boxes of one tree and the central spheres of the other: see
  /// hasSmallBalls().
  [[gnu::hot]] HWY_NOINLINE void testBalls(Expansion& e) const {
    const float pad = search_.frames.box_pad;
    const FloatPose& to = *to_[e.side];
    const bool boxed = has_boxes_[e.side];
    const Node& other = *e.other;
    Vec3 center = {};
    Box box;
    if (boxed) {
      center = moved(to, {other.x[kCentral], other.y[kCentral], other.z[kCentral]});
    } else {
      move(otherBox(e), to, box);
    }
    const Block& block = blockOf(e);
    const uint32_t near = e.near;
    uint32_t open = 0;
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      V lower;
      if (boxed) {
        const V3 ball = {hn::Set(d, center.x), hn::Set(d, center.y), hn::Set(d, center.z)};
        lower = ballBounds(BoxLanes(boxBlockOf(e), l), ball, hn::Set(d, other.r[kCentral]), pad);
      } else {
        const V3 balls = {load(block.x[kCentral], l), load(block.y[kCentral], l),
                          load(block.z[kCentral], l)};
        lower = ballBounds(BoxLanes(box), balls, load(block.r[kCentral], l), pad);
      }
      const V bounds = hn::Load(d, e.bounds + l);
      keep(e, l, hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, lower), bounds));
      open |= bitsOf(hn::Gt(lower, hn::Set(d, -4 * pad))) << l;
    }
    e.near &= near;
    if (HWY_UNLIKELY(isContact() && (open & e.near) != 0)) testInDouble(e, open & e.near);
  }

  /// Raises bounds that twice their pads leave open, a child at a time.
  HWY_NOINLINE void testInDouble(Expansion& e, uint32_t open) const {
    for (; open != 0 && search_.evaluator.triesDouble(); open &= open - 1) {
      const uint32_t lane = firstOf(open);
      const NodePair child = childPair(e, lane);
      const double bound = boundInDouble(search_, child.a, child.b);
      if (!search_.evaluator.triedDouble(bound > 0)) continue;
      e.bounds[lane] = std::max(e.bounds[lane], roundDown<float>(bound));
      e.near &= ~(1U << lane);
    }
  }
  /// The boxes of the children, and the other's in their frame.
  [[gnu::hot]] HWY_NOINLINE const BoxBlock& boxesOfTriangles(const Expansion& e, Box& moved) const {
    if (e.kind == Expanded::kLeaf) {
      move(otherBox(e), *to_[e.side], moved);
      return boxed_[e.side].of(*trees_[e.side], static_cast<uint32_t>(e.parent->leaf()));
    }
    Box box;
    const uint32_t triangle = otherId(e), other = 1 - e.side;
    boxed_[other].of(*trees_[other], leafOfTriangle(triangle), laneOfTriangle(triangle), box);
    move(box, *to_[e.side], moved);
    return boxBlockOf(e);
  }

  HWY_NOINLINE void reportPruned(const Expansion& e, uint32_t taken) const {
    for (uint32_t left = e.children.all() & ~e.near & ~taken; left != 0; left &= left - 1) {
      const uint32_t lane = firstOf(left);
      const NodePair child = childPair(e, lane);
      search_.audit->pruned(child.a, child.b, e.bounds[lane]);
    }
  }

  const Search& search_;
  const Tree* trees_[2];
  const FloatPose* to_[2];   ///< the frame of a side from the other's
  const bool has_boxes_[2];  ///< which trees have them
  const bool splits_, balls_, budgeted_, large_;
  mutable BoxedTriangles boxed_[2];
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
