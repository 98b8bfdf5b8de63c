// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Raises the bounds of children that spheres bound badly: by boxes, and in contact, if those leave
/// a child open, in double.
class Tightener {
 public:
  explicit Tightener(const Sides& sides) : sides_(sides) {}

  /// Whether both trees have boxes: those of CAD meshes.
  bool hasBoxes() const { return sides_.has_boxes[0] && sides_.has_boxes[1]; }

  /// The children that matter and that spheres bound badly: flat ones, and in contact of boxes
  /// those that overlap by little.
  uint32_t flatOf(const Expansion& e) const {
    if (e.other->flat != 0) return e.near;
    uint32_t flat = e.children.flat;
    if (sides_.isContact() && hasBoxes()) {
      const V least = hn::Set(d, -tuning::kLittleOverlap * std::min(e.parent->size, e.other->size));
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

  [[gnu::hot]] HWY_NOINLINE void testBoxes(Expansion& e) const {
    Box moved;
    const bool nodes = HWY_LIKELY(e.kind == Expanded::kNode);
    const BoxBlock& block = nodes ? sides_.boxBlockOf(e) : boxesOfTriangles(e, moved);
    if (nodes) move(otherBox(e), *sides_.to[e.side], moved);
    const float pad = nodes ? sides_.search.frames.box_pad : trianglePad(sides_.search.frames);
    const BoxLanes other(moved);
    const bool contact = sides_.isContact();
    raise(e, 2 * pad, [&](size_t l) {
      const BoxLanes boxes(block, l);
      return contact ? contactBounds(boxes, other, pad) : distanceBounds(boxes, other, pad);
    });
  }

  /// Raises bounds to those of each chunk of lanes, which say nothing where they aren't positive.
  /// What they leave open by so much at most, twice their pads, is tried in double, in contact.
  template <typename LowerBounds>
  HWY_INLINE void raise(Expansion& e, float by, const LowerBounds& lowerBounds) const {
    const uint32_t near = e.near;
    uint32_t open = 0;
    e.near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V lower = lowerBounds(l), bounds = hn::Load(d, e.bounds + l);
      sides_.keep(e, l, hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, lower), bounds));
      open |= bitsOf(hn::Gt(lower, hn::Set(d, -by))) << l;
    }
    e.near &= near;
    if (HWY_UNLIKELY(sides_.isContact() && (open & e.near) != 0)) testInDouble(e, open & e.near);
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
