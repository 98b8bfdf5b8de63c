// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Expands pairs of nodes. The larger node is expanded, and a leaf is not, unless it is the larger
/// by far: its triangles, which may lie anywhere in it, are then its children. They stand for nodes
/// until they meet a leaf. Without that a terrain of large triangles asks 0.14 (distance) and 0.06
/// (contact) of the speed. To make leaves of single triangles where a tree is prepared, of all
/// small meshes and of what is large in others, serves tables as well, but rooms and floors at 0.33
/// and that terrain at 0.02 to 0.06 of the speed: its triangles are large beside the other mesh
/// alone.
///
/// Expansions come in batches: what one waits for overlaps with the work of another.
class Expander {
 public:
  explicit Expander(const Search& search)
      : sides_(search),
        tightener_(sides_),
        splits_(search.a.widest_leaf > tuning::kWideLeaf * search.b.mean_leaf ||
                search.b.widest_leaf > tuning::kWideLeaf * search.a.mean_leaf) {}

  const Tightener& tightener() const { return tightener_; }

  /// e.bound is that of the pair.
  void start(NodePair at, Expansion& e) const {
    e.at = at;
    if (HWY_UNLIKELY(isTriangle(at.a | at.b))) return startAgainstTriangle(e);
    const Node* const nodes[2] = {&sides_.search.a.nodes[at.a], &sides_.search.b.nodes[at.b]};
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
        ++sides_.search.counts.expansions;
        return;
      }
    }
    MovedNode moved;
    move(*e.other, *sides_.to[e.side], sides_.search.frames.pad, moved);
    const Block& block = sides_.blockOf(e);
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) sides_.keep(e, l, lowerBounds(block, l, moved));
    endTest(e);
    ++sides_.search.counts.expansions;
  }

  /// Tests pairs, several at once as their steps overlap; the children that matter join the
  /// frontier.
  template <bool kInherit, size_t kMax>
  [[gnu::hot]] void expand(const NodePairList::Entry (&pairs)[kMax], size_t count,
                           Frontier& frontier) const {
    Expansion batch[kMax];
    size_t n = 0;
    for (size_t i = 0; i < count; ++i) {
      if (pairs[i].bound >= sides_.search.evaluator.cull_distance) continue;
      batch[n].bound = pairs[i].bound;
      start(pairs[i].pair, batch[n++]);
    }
    for (size_t i = 0; i < n; ++i) test(batch[i]);
    for (size_t i = 0; i < n; ++i) spread<kInherit>(batch[i], frontier);
  }

  void pushRoots(Frontier& frontier) const {
    const bool leaves = sides_.trees[0]->nodes[0].isLeaf() && sides_.trees[1]->nodes[0].isLeaf();
    (leaves ? frontier.leaves : frontier.inner).push(-kInfinityFloat, {0, 0});
  }

  bool areLeaves(NodePair at) const {
    const auto isLeaf = [](const Tree& tree, uint32_t node) {
      return isTriangle(node) || tree.nodes[node].isLeaf();
    };
    return isLeaf(sides_.search.a, at.a) && isLeaf(sides_.search.b, at.b);
  }

  /// The children that matter join the frontier. If kInherit, bounds are at least the pair's, and
  /// those `taken` (bits) don't join.
  template <bool kInherit>
  void spread(Expansion& e, Frontier& frontier, uint32_t taken = 0) const {
    if constexpr (kInherit) {
      const V limit = set(sides_.search.evaluator.cull_distance), least = set(e.bound);
      e.near &= ~taken & lanesWhere([&](size_t l) {
        const V bounds = hn::Max(hn::Load(d, e.bounds + l), least);
        hn::Store(bounds, d, e.bounds + l);
        return hn::Lt(bounds, limit);
      });
    }
    tightener_.tighten(e);
    if (HWY_UNLIKELY(sides_.search.audit != nullptr)) reportPruned(e, taken);
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
    frontier.inner.raise(deepest);  // without it robots' hits take 1.6 times as long
  }

 private:
  void startNode(Expansion& e, Expanded kind) const {
    e.kind = kind;
    e.children = sides_.trees[e.side]->children[static_cast<size_t>(e.parent->child)];
    e.first_child = e.parent->first_child;
    fetch(sides_.blockOf(e));
  }
  [[gnu::hot]] HWY_NOINLINE void startAgainstTriangle(Expansion& e) const {
    e.side = isTriangle(e.at.a) ? 1 : 0;
    e.parent = &sides_.trees[e.side]->nodes[e.side == 0 ? e.at.a : e.at.b];
    e.other = &kTriangleStandIn;
    startNode(e, Expanded::kNodeTriangle);
  }

  /// Whether to split the leaf that e.other may be: where the pair is nearer than the leaf is wide,
  /// and the node several times smaller; from farther, all its triangles look alike.
  bool splits(const Expansion& e) const {
    return splits_ & e.other->isLeaf() &
           (e.bound + tuning::kSplitLeaf * e.parent->size < e.other->width);
  }
  [[gnu::hot]] HWY_NOINLINE void startLeaf(Expansion& e) const {
    std::swap(e.parent, e.other);
    e.side = 1 - e.side;
    e.kind = Expanded::kLeaf;
    const size_t leaf = e.parent->leaf();
    e.children.count = sides_.trees[e.side]->leaves[leaf].num_faces;
    e.children.flat = e.children.leaves = 0xFF;
    e.first_child = kTriangleNode | static_cast<uint32_t>(leaf) << 3;
  }

  HWY_INLINE void endTest(Expansion& e) const {
    e.near &= e.children.all();
    e.tight = false;
    sides_.search.counts.volume_tests += e.children.count;
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
    if (e.kind == Expanded::kNodeTriangle) return;
    if (!(sides_.search.evaluator.cull_distance < kInfinityFloat)) return;
    tightener_.tighten(e);
    if (2 * hwy::PopCount(e.near) <= e.children.count) return;
    std::swap(e.parent, e.other);
    e.side = 1 - e.side;
    startNode(e, Expanded::kNode);
  }
  [[gnu::hot]] void testLeaf(Expansion& e) const {
    const Node& other = *e.other;
    const Vec3 c =
        moved(*sides_.to[e.side], {other.x[kCentral], other.y[kCentral], other.z[kCentral]});
    const V3 center = inAllLanes(c);
    const V reach = set(other.r[kCentral] + prismPad(sides_.search.frames));
    const LeafView leaf(*sides_.trees[e.side], sides_.trees[e.side]->leaves[e.parent->leaf()]);
    for (size_t l = 0; l < kLanes; l += step()) {
      sides_.keep(e, l, hn::Sub(Faces{leaf.faces, l}.distances(center), reach));
    }
  }
  [[gnu::hot]] void testAgainstTriangle(Expansion& e) const {
    const Tree& tree = *sides_.trees[1 - e.side];
    const uint32_t triangle = Sides::otherId(e);
    const LeafView leaf(tree, tree.leaves[leafOfTriangle(triangle)]);
    const MovedFace moved(leaf, laneOfTriangle(triangle), *sides_.to[e.side]);
    const Faces face = moved.faces();
    const Block& block = sides_.blockOf(e);
    const V pad = set(prismPad(sides_.search.frames));
    for (size_t l = 0; l < kLanes; l += step()) {
      const Spheres s0 = spheresAt(block, kCentral, l);
      sides_.keep(e, l, hn::Sub(hn::Sub(face.distances(s0.center), s0.r), pad));
    }
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
    const auto boundsAt = [&](size_t l) { return hn::Load(d, e.bounds + l); };
    const uint32_t overlapping =
        children & lanesWhere([&](size_t l) { return hn::Le(boundsAt(l), hn::Zero(d)); });
    const uint32_t deepest = lanesWhere([&](size_t l) { return hn::Eq(boundsAt(l), least); });
    return static_cast<uint32_t>(
        hwy::PopCount(overlapping & (firstBit(deepest & overlapping) - 1)));
  }
  static uint32_t firstBit(uint32_t bits) { return bits & (0U - bits); }  // 0 for none

  HWY_NOINLINE void reportPruned(const Expansion& e, uint32_t taken) const {
    for (uint32_t left = e.children.all() & ~e.near & ~taken; left != 0; left &= left - 1) {
      const uint32_t lane = firstOf(left);
      const NodePair child = Sides::childPair(e, lane);
      sides_.search.audit->pruned(child.a, child.b, e.bounds[lane]);
    }
  }

  const Sides sides_;
  const Tightener tightener_;
  const bool splits_;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
