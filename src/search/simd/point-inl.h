// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// A point against a tree, nearest first: eight children, or eight triangles, at once. Bounds of
/// triangles, from below and from above, are nearly their distances. So those that may be nearest
/// are kept, and evaluated at the end, when nearly all of them are known to be farther.
class PointTraversal {
 public:
  explicit PointTraversal(const PointSearch& search)
      : tree_(search.tree),
        evaluator_(search.evaluator),
        p_(inAllLanes(vec3(search.point.at))),
        pad_(set(search.point.pad)) {}

  void run() {
    WaitingNodes waiting(tree_);
    waiting.walk([&](float bound) { return bound >= evaluator_.cull_distance; },
                 [&](const Leaf& of) { return leaf(LeafView(tree_, of)), false; },
                 [&](const Node& node) { open(node, waiting); });
    evaluateKept();
  }

 private:
  struct Kept {
    float bound;  ///< from below, the pad taken off
    uint32_t triangle;
  };
  static constexpr size_t kMostKept = 32;

  V offSphere(const Spheres& s) const {
    const V3 way = s.center - p_;
    return hn::Sub(hn::Sqrt(dot(way, way)), s.r);
  }

  /// By S0, and for two axes the caps on the far side.
  HWY_INLINE V offSpheres(const Block& block, size_t l) const {
    const Spheres s0 = spheresAt(block, kCentral, l);
    const V3 way = s0.center - p_;
    V best = hn::Sub(hn::Sqrt(dot(way, way)), s0.r);
    for (const int middle : {int{kMiddle2}, int{kMiddle1}}) {
      const Spheres half = spheresAt(block, middle + 1, l);
      best =
          hn::Max(best, offSphere(capOf(spheresAt(block, middle, l), half, dot(half.center, way))));
    }
    return hn::Sub(best, pad_);
  }

  HWY_INLINE V offBoxes(const BoxBlock& block, size_t l) const {
    const BoxLanes box(block, l);
    const V3 out = abs(box.along(p_ - box.center)) - box.half;
    return hn::Sub(hn::Sqrt(square(positive(out.x), positive(out.y), positive(out.z))), pad_);
  }

  HWY_INLINE void open(const Node& node, WaitingNodes& waiting) const {
    const auto at = static_cast<size_t>(node.child);
    const Children& children = tree_.children[at];
    const V limit = set(evaluator_.cull_distance);
    alignas(32) float bounds[kLanes];
    uint32_t near = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      V bound = offSpheres(tree_.blocks[at], l);
      if (children.flat != 0) bound = hn::Max(bound, offBoxes(tree_.box_blocks[at], l));
      hn::Store(bound, d, bounds + l);
      near |= bitsOf(hn::Lt(bound, limit)) << l;
    }
    waiting.push(near & children.all(), bounds, node.first_child);
  }

  /// Lower bounds of a leaf's triangles by planes, and for those that are left by their edges; an
  /// upper bound of the nearest.
  HWY_INLINE void leaf(const LeafView& view) {
    uint32_t near = firstLanes(view.leaf.num_faces) & lanesWhere([&](size_t l) {
                      const V off = Faces{view.faces, l}.distances(p_);
                      return hn::Lt(hn::Sub(off, pad_), set(evaluator_.cull_distance));
                    });
    if (near == 0) return;
    const CornerLanes corners(view.leaf);
    alignas(32) float bounds[kLanes];
    V least = set(kInfinityFloat);
    for (size_t l = 0; l < kLanes; l += step()) {
      const Faces faces = {view.faces, l};
      const V height = hn::Abs(faces.height(p_)), within = faces.within(p_);
      const V edges = offEdges(corners, view.vertices, l);
      const V3 normal = rowsAt(faces.rows + kFacePlane, l);
      const auto has_plane = hn::Gt(dot(normal, normal), set(0.5F));
      const auto inside = hn::And(has_plane, hn::Ge(within, hn::Zero(d)));
      const auto surely = hn::And(has_plane, hn::Ge(within, pad_));
      hn::Store(hn::Sub(hn::IfThenElse(inside, height, edges), pad_), d, bounds + l);
      least = hn::Min(least, hn::Add(hn::IfThenElse(surely, height, edges), pad_));
    }
    evaluator_.cull_distance =
        std::min(evaluator_.cull_distance, hn::GetLane(hn::MinOfLanes(d, least)));
    for (; near != 0; near &= near - 1) {
      const uint32_t lane = firstOf(near);
      if (bounds[lane] < evaluator_.cull_distance) keep({bounds[lane], view.face(lane).triangle()});
    }
  }

  /// Distances of triangles' edges.
  HWY_INLINE V offEdges(const CornerLanes& corners, const Points& vertices, size_t l) const {
    V3 corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = corners.pointOf(vertices, k, l);
    V least = set(kInfinityFloat);
    for (int k = 0; k < 3; ++k) {
      const V3 e = corner[k == 2 ? 0 : k + 1] - corner[k], w = p_ - corner[k];
      const V s = hn::Div(dot(w, e), hn::Max(dot(e, e), set(0x1p-126F)));
      const V3 off = w - hn::Min(positive(s), set(1)) * e;
      least = hn::Min(least, dot(off, off));
    }
    return hn::Sqrt(least);
  }

  void keep(const Kept& triangle) {
    if (HWY_UNLIKELY(num_kept_ == kMostKept)) {
      Kept* const end = std::remove_if(kept_, kept_ + num_kept_, [this](const Kept& k) {
        return k.bound >= evaluator_.cull_distance;
      });
      num_kept_ = static_cast<size_t>(end - kept_);
      if (num_kept_ == kMostKept) evaluateKept();
    }
    kept_[num_kept_++] = triangle;
  }

  void evaluateKept() {
    std::sort(kept_, kept_ + num_kept_,
              [](const Kept& a, const Kept& b) { return a.bound < b.bound; });
    for (size_t i = 0; i < num_kept_ && kept_[i].bound < evaluator_.cull_distance; ++i) {
      evaluator_.evaluate(kept_[i].triangle);
    }
    num_kept_ = 0;
  }

  const Tree& tree_;
  PointEvaluator& evaluator_;
  const V3 p_;
  const V pad_;
  size_t num_kept_ = 0;
  Kept kept_[kMostKept];
};

void point(const PointSearch& search) { PointTraversal(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
