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
    e.near |= bitsOf(hn::Lt(bounds, hn::Set(d, search.evaluator.cull_distance))) << l;
  }

  const Search& search;
  const Tree* trees[2];
  const FloatPose* to[2];   ///< the frame of a side from the other's
  const bool has_boxes[2];  ///< which trees have them
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
