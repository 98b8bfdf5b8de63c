// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Which tests a pair takes.
enum class Expanded : uint32_t {
  kNode,          ///< children of a node against a node
  kNodeTriangle,  ///< children of a node against a triangle of a leaf
  kLeaf           ///< triangles of a leaf against a node
};

/// A pair of nodes under test: the children of one against the other.
struct Expansion {
  NodePair at;
  uint32_t side;  ///< whose node is expanded: 0 of a, 1 of b
  Expanded kind;
  const Node* parent;    ///< of the children
  const Node* other;     ///< of a triangle: a stand-in
  uint32_t first_child;  ///< the node that lane 0 is
  Children children;
  uint32_t near;  ///< children that matter, as bits
  bool tight;     ///< whether boxes were tested
  float bound;    ///< of the pair
  alignas(32) float bounds[kLanes];
};

/// A triangle that stands for a node: a leaf that spheres bound badly.
inline constexpr Node kTriangleStandIn = [] {
  Node node;
  node.child = -1;
  node.flat = 1;
  return node;
}();

/// The two sides of a search, as expansions see them.
struct Sides {
  explicit Sides(const Search& s)
      : search(s),
        trees{&s.a, &s.b},
        to{&s.frames.a_from_b, &s.frames.b_from_a},
        has_boxes{!s.a.boxes.empty(), !s.b.boxes.empty()} {}

  /// Whether nothing matters but what overlaps.
  bool isContact() const { return search.evaluator.cull_distance == 0; }

  const Block& blockOf(const Expansion& e) const {
    return trees[e.side]->blocks[static_cast<size_t>(e.parent->child)];
  }
  const BoxBlock& boxBlockOf(const Expansion& e) const {
    return trees[e.side]->box_blocks[static_cast<size_t>(e.parent->child)];
  }
  static uint32_t otherId(const Expansion& e) { return e.side == 0 ? e.at.b : e.at.a; }
  static NodePair childPair(const Expansion& e, uint32_t lane) {
    const uint32_t child = e.first_child + lane;
    return e.side == 0 ? NodePair{child, e.at.b} : NodePair{e.at.a, child};
  }

  /// Notes the bounds of some lanes.
  HWY_INLINE void keep(Expansion& e, size_t l, V bounds) const {
    hn::Store(bounds, d, e.bounds + l);
    e.near |= bitsOf(hn::Lt(bounds, set(search.evaluator.cull_distance))) << l;
  }

  const Search& search;
  const Tree* trees[2];
  const FloatPose* to[2];   ///< the frame of a side from the other's
  const bool has_boxes[2];  ///< which trees have them
};

/// Raises the bounds of children that spheres bound badly: by boxes, and in contact, if those leave
/// a child open, in double.
class Tightener {
 public:
  explicit Tightener(const Sides& sides) : sides_(sides) {}

  /// Whether both trees have boxes: those of CAD meshes.
  bool hasBoxes() const { return sides_.has_boxes[0] && sides_.has_boxes[1]; }

  /// The children that matter and that spheres bound badly: flat ones.
  uint32_t flatOf(const Expansion& e) const {
    return e.near & (e.other->flat != 0 ? ~0U : e.children.flat);
  }

  /// Tests boxes too, once, if that helps any child.
  void tighten(Expansion& e) const {
    if (flatOf(e) == 0 || e.tight) return;
    e.tight = true;
    if (hasBoxes(e)) testBoxes(e);
  }

  /// Raises bounds that other tests left open, a child at a time.
  HWY_NOINLINE void testInDouble(Expansion& e, uint32_t open) const {
    const Search& search = sides_.search;
    for (; open != 0 && search.evaluator.triesDouble(); open &= open - 1) {
      const uint32_t lane = firstOf(open);
      const NodePair child = Sides::childPair(e, lane);
      const double bound = boundInDouble(search, child.a, child.b);
      if (!search.evaluator.triedDouble(bound > 0)) continue;
      e.bounds[lane] = std::max(e.bounds[lane], roundDown<float>(bound));
      e.near &= ~(1U << lane);
    }
  }

 private:
  /// A root has a box in any tree, which pays in contact.
  bool hasOtherBox(const Expansion& e) const {
    return sides_.has_boxes[1 - e.side] || (Sides::otherId(e) == 0 && sides_.isContact());
  }
  const Box& otherBox(const Expansion& e) const {
    const Tree& tree = *sides_.trees[1 - e.side];
    return sides_.has_boxes[1 - e.side] ? tree.boxes[Sides::otherId(e)] : tree.root_box;
  }
  /// Triangles have boxes wherever the other has one.
  bool hasBoxes(const Expansion& e) const {
    if (e.kind == Expanded::kNodeTriangle) return sides_.has_boxes[e.side];
    return hasOtherBox(e) && (e.kind == Expanded::kLeaf || sides_.has_boxes[e.side]);
  }

  /// Bounds of boxes say nothing where they aren't positive. What they leave open by twice their
  /// pads at most is tried in double, in contact.
  [[gnu::hot]] HWY_NOINLINE void testBoxes(Expansion& e) const {
    Box moved;
    const bool nodes = HWY_LIKELY(e.kind == Expanded::kNode);
    const BoxBlock& block = nodes ? sides_.boxBlockOf(e) : boxesOfTriangles(e, moved);
    if (nodes) move(otherBox(e), *sides_.to[e.side], moved);
    const float pad = nodes ? sides_.search.frames.box_pad : trianglePad(sides_.search.frames);
    const BoxLanes other(moved);
    const bool contact = sides_.isContact();
    const uint32_t near = e.near;
    e.near = 0;
    const uint32_t open = lanesWhere([&](size_t l) {
      const BoxLanes boxes(block, l);
      const V lower =
          contact ? contactBounds(boxes, other, pad) : distanceBounds(boxes, other, pad);
      const V bounds = hn::Load(d, e.bounds + l);
      sides_.keep(e, l, hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, lower), bounds));
      return hn::Gt(lower, set(-2 * pad));
    });
    e.near &= near;
    if (HWY_UNLIKELY(contact && (open & e.near) != 0)) testInDouble(e, open & e.near);
  }

  /// The boxes of the children, and the other's in their frame.
  [[gnu::hot]] HWY_NOINLINE const BoxBlock& boxesOfTriangles(const Expansion& e, Box& moved) const {
    const FloatPose& to = *sides_.to[e.side];
    if (e.kind == Expanded::kLeaf) {
      move(otherBox(e), to, moved);
      return boxed_[e.side].of(*sides_.trees[e.side], static_cast<uint32_t>(e.parent->leaf()));
    }
    Box box;
    const uint32_t triangle = Sides::otherId(e), other = 1 - e.side;
    boxed_[other].of(*sides_.trees[other], leafOfTriangle(triangle), laneOfTriangle(triangle), box);
    move(box, to, moved);
    return sides_.boxBlockOf(e);
  }

  const Sides sides_;
  mutable BoxedTriangles boxed_[2];
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
