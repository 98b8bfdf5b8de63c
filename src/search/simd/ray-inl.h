// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// A ray against a tree, front to back: eight children, or eight faces, at once.
class RayTraversal {
 public:
  explicit RayTraversal(const RaySearch& search)
      : search_(search), tree_(search.tree), ray_(search.ray) {}

  void run() {
    WaitingNodes waiting(tree_);  // by where the ray may enter, the pad taken off
    waiting.walk([&](float bound) { return bound > search_.evaluator.end; },
                 [&](const Leaf& of) { return leaf(of); },
                 [&](const Node& node) { open(node, waiting); });
  }

 private:
  V3 origin() const { return inAllLanes(vec3(ray_.origin)); }
  V3 direction() const { return inAllLanes(vec3(ray_.direction)); }

  /// Cuts [low, high] to what of the line a sphere contains; `square` gets negative if there is
  /// nothing.
  HWY_INLINE void clip(const V3& center, V radius, V& low, V& high, V& square) const {
    const V3 to_center = center - origin();
    const V b = dot(to_center, direction());
    const V3 off = to_center - b * direction();
    const V r = hn::Add(radius, set(ray_.pad));
    const V h2 = hn::Sub(hn::Mul(r, r), dot(off, off));
    square = hn::Min(square, h2);
    const V h = hn::Sqrt(positive(h2));
    low = hn::Max(low, hn::Sub(b, h));
    high = hn::Min(high, hn::Add(b, h));
  }

  /// Whether boxes of a block are those that the ray may meet before its end, lanes from `l`;
  /// raises `enters` to the lower bounds of where it does.
  HWY_INLINE hn::Mask<D> meets(const BoxBlock& block, size_t l, float* enters) const {
    const V3 from_center = origin() - BoxLanes::column(block, kCenter, l);
    const V pad = set(ray_.pad), least = set(0x1p-60F);
    V low = set(-kInfinityFloat), high = hn::Neg(low);
    for (int axis = kAxes; axis < kAxes + 3; ++axis) {
      const V3 e = BoxLanes::column(block, axis, l);
      const V at = dot(e, from_center), slope = dot(e, direction());
      // Within the model a slope that small moves nothing by more than the pad.
      const V way = hn::IfThenElse(hn::Lt(hn::Abs(slope), least), least, slope);
      const V half = hn::Add(load(block.half[axis], l), pad);
      const V one = hn::Div(hn::Neg(hn::Add(half, at)), way);
      const V other = hn::Div(hn::Sub(half, at), way);
      low = hn::Max(low, hn::Min(one, other));
      high = hn::Min(high, hn::Max(one, other));
    }
    low = hn::Sub(low, pad);
    high = hn::Add(high, pad);
    const V enter = hn::Max(hn::Load(d, enters + l), low);
    hn::Store(enter, d, enters + l);
    return hn::And(hn::Le(low, high), hn::And(hn::Le(enter, set(search_.evaluator.end)),
                                              hn::Ge(high, set(ray_.begin))));
  }

  /// The children that the ray may enter before the end join those that wait.
  HWY_INLINE void open(const Node& node, WaitingNodes& waiting) const {
    const Block& block = tree_.blocks[static_cast<size_t>(node.child)];
    const Children& children = tree_.children[static_cast<size_t>(node.child)];
    ++search_.counts.expansions;
    search_.counts.volume_tests += children.count;
    alignas(32) float enters[kLanes];
    uint32_t near = 0;
    const V pad = set(ray_.pad), begin = set(ray_.begin), end = set(search_.evaluator.end);
    for (size_t l = 0; l < kLanes; l += step()) {
      V low = set(-kInfinityFloat), high = hn::Neg(low), h2 = high;
      const Spheres s0 = spheresAt(block, kCentral, l);
      clip(s0.center, s0.r, low, high, h2);
      for (const int middle : {int{kMiddle2}, int{kMiddle1}}) {
        const Spheres m = spheresAt(block, middle, l), half = spheresAt(block, middle + 1, l);
        clip(m.center + half.center, hn::Add(m.r, half.r), low, high, h2);
        clip(m.center - half.center, hn::Sub(m.r, half.r), low, high, h2);
      }
      low = hn::Sub(low, pad);
      high = hn::Add(high, pad);
      const auto inside = hn::And(hn::And(hn::Ge(h2, hn::Zero(d)), hn::Le(low, high)),
                                  hn::And(hn::Le(low, end), hn::Ge(high, begin)));
      hn::Store(low, d, enters + l);
      near |= bitsOf(inside) << l;
    }
    near &= children.all();
    if ((near & children.flat) != 0) {
      const BoxBlock& boxes = tree_.box_blocks[static_cast<size_t>(node.child)];
      near &= lanesWhere([&](size_t l) { return meets(boxes, l, enters); });
    }
    waiting.push(near, enters, node.first_child);
  }

  /// Evaluates the faces that the ray may meet: true to end the search.
  HWY_INLINE bool leaf(const Leaf& leaf) const {
    ++search_.counts.leaf_pairs;
    const Lanes* const rows = &tree_.lanes[leaf.offset + 3 * leaf.vertexChunks()];
    const V pad = set(2 * ray_.pad), begin = set(ray_.begin), end = set(search_.evaluator.end);
    const V sign = hn::SignBit(d);
    uint32_t near = firstLanes(leaf.num_faces) & lanesWhere([&](size_t l) {
                      const Faces faces = {rows, l};
                      const V H = faces.height(origin()), D = faces.slope(kFacePlane, direction());
                      const V flip = hn::And(D, sign), steep = hn::Abs(D);
                      const V way = hn::Neg(hn::Xor(H, flip));  // to the plane, times |D|
                      auto inside = hn::And(hn::Le(way, hn::Add(hn::Mul(end, steep), pad)),
                                            hn::Ge(way, hn::Sub(hn::Mul(begin, steep), pad)));
                      for (int k = 0; k < 3; ++k) {
                        const int row = kEdgePlanes + 4 * k;
                        const V above = hn::Sub(hn::Mul(faces.plane(row, origin()), D),
                                                hn::Mul(H, faces.slope(row, direction())));
                        inside = hn::And(inside, hn::Ge(hn::Xor(above, flip), hn::Neg(pad)));
                      }
                      return inside;
                    });
    if (near != 0) ++search_.counts.leaf_kernels;
    for (; near != 0; near &= near - 1) {
      const FeatureId id = tree_.features[leaf.feature_offset + firstOf(near)];
      if (search_.evaluator.evaluate(id.triangle())) return true;
    }
    return false;
  }

  const RaySearch& search_;
  const Tree& tree_;
  const FloatRay& ray_;
};

void ray(const RaySearch& search) { RayTraversal(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
