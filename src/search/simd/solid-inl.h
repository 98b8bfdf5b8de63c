// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// The triangles of a tree near a solid. Nearly best first, as DistanceSearch: nodes and triangles
/// that overlap the solid at once, what is apart in waves.
class SolidTraversal {
 public:
  explicit SolidTraversal(const SolidSearch& search)
      : search_(search),
        tree_(search.tree),
        bounds_(search.solid),
        contact_(!(search.evaluator.cull_distance > 0)) {}

  void run() {
    const bool leaf = tree_.nodes[0].isLeaf();
    (leaf ? frontier_.leaves : frontier_.inner).push(-kInfinityFloat, {0, 0});
    if (!contact_ && descend()) return;
    for (;;) {
      while (!frontier_.leaves.empty()) {
        if (leafOf(frontier_.leaves.pop())) return;
      }
      if (!frontier_.inner.empty()) {
        expand(frontier_.inner.pop());
        continue;
      }
      if (!frontier_.nextWave(search_.evaluator.cull_distance, tuning::kWave)) return;
      while (!frontier_.bounded.empty()) {
        const NodePairList::Entry entry = frontier_.bounded.pop();
        if (entry.bound < search_.evaluator.cull_distance && evaluate(entry.pair.a, false)) return;
      }
    }
  }

 private:
  V pad() const { return set(search_.solid.pad); }

  bool evaluate(uint32_t triangle, bool meets) {
    ++search_.counts.exact;
    return search_.evaluator.evaluate(triangle, meets);
  }

  /// A point of the mesh is so far away, but for the pad: that bounds what matters.
  void addUpperBound(float distance) {
    const float upper = std::max(distance, 0.0F) + search_.solid.pad;
    search_.evaluator.cull_distance = std::min(search_.evaluator.cull_distance, upper);
  }

  /// From the root to the nearest child, each time, for an upper bound: that of a vertex, or where
  /// no bound of points tells it, of the nearest triangle. True to end the search.
  bool descend() {
    uint32_t at = 0;
    while (!tree_.nodes[at].isLeaf()) {
      const Node& node = tree_.nodes[at];
      const auto block = static_cast<size_t>(node.child);
      ++search_.counts.expansions;
      alignas(32) float bounds[kLanes];
      for (size_t l = 0; l < kLanes; l += step()) {
        hn::Store(bounds_.spheres(tree_.blocks[block], l), d, bounds + l);
      }
      uint32_t nearest = 0;
      for (uint32_t i = 1; i < tree_.children[block].count; ++i) {
        if (bounds[i] < bounds[nearest]) nearest = i;
      }
      at = node.first_child + nearest;
    }
    const LeafView view(tree_, tree_.leaves[tree_.nodes[at].leaf()]);
    Lanes values[kRows * kMaxChunks];
    lookAt(view, values);
    if (bounds_.tellsDistance()) return false;
    Triangles triangles;
    boundByVertices(view, values, -kInfinityFloat, triangles);
    boundByBoxes(view, triangles);
    if (triangles.near == 0) return false;
    uint32_t nearest = firstOf(triangles.near);
    for (uint32_t left = triangles.near; left != 0; left &= left - 1) {
      if (triangles.bounds[firstOf(left)] < triangles.bounds[nearest]) nearest = firstOf(left);
    }
    return evaluate(view.face(nearest).triangle(), false);
  }

  /// Heights of points over the best slab of the solid.
  V overSlab(const V3& p) const {
    const FloatSlab& slab = search_.evaluator.slab;
    return hn::Sub(dot(inAllLanes(vec3(slab.n)), p), set(slab.offset));
  }

  HWY_INLINE void expand(const NodePairList::Entry& entry) {
    if (entry.bound >= search_.evaluator.cull_distance) return;
    const Node& node = tree_.nodes[entry.pair.a];
    const auto at = static_cast<size_t>(node.child);
    const Children& children = tree_.children[at];
    const Block& block = tree_.blocks[at];
    ++search_.counts.expansions;
    search_.counts.volume_tests += children.count;
    const V limit = set(search_.evaluator.cull_distance), least = set(entry.bound);
    frontier_.reserve();
    for (size_t l = 0; l < kLanes; l += step()) {
      const uint32_t used = children.all() >> l & ((1U << step()) - 1);
      V bounds = hn::Max(bounds_.spheres(block, l), least);
      const Spheres s0 = spheresAt(block, kCentral, l);
      bounds = hn::Max(bounds, hn::Sub(overSlab(s0.center), hn::Add(s0.r, pad())));
      uint32_t near = used & bitsOf(hn::Lt(bounds, limit));
      if (near != 0 && !tree_.box_blocks.empty()) {
        bounds = bounds_.boxes(tree_.box_blocks[at], l, contact_, bounds);
        near &= bitsOf(hn::Lt(bounds, limit));
      }
      if (near != 0 && !search_.evaluator.slabs().empty()) {
        bounds = bounds_.spheresOverSlabs(block, l, search_.evaluator.slabs(), bounds);
        near &= bitsOf(hn::Lt(bounds, limit));
      }
      const VU child =
          hn::Add(hn::Set(du, node.first_child), hn::Iota(du, static_cast<uint32_t>(l)));
      if (search_.audit) tellNodes(used, node.first_child + static_cast<uint32_t>(l), bounds);
      frontier_.push(near, children.leaves >> l, bounds, child, hn::Zero(du));
    }
  }

  HWY_NOINLINE void tellNodes(uint32_t lanes, uint32_t first, V bounds) const {
    alignas(32) float values[kLanes];
    hn::Store(bounds, d, values);
    for (; lanes != 0; lanes &= lanes - 1) {
      search_.audit->boundNode(first + firstOf(lanes), values[firstOf(lanes)]);
    }
  }

  // These hold for each vertex of a leaf, in chunks as Points: its bound (heights of either sign
  // for a plane), and its height over the best slab.
  enum { kBound = 0, kOverSlab = 1, kRows = 3 };

  /// Writes these rows, and offers the nearest vertex.
  void lookAt(const LeafView& view, Lanes* values) {
    V least = set(kInfinityFloat);
    for (int c = 0; c < view.vertices.chunks; ++c) {
      const Lanes* const rows = view.vertices.rows + 3 * c;
      Lanes* const to = values + kRows * c;
      for (size_t l = 0; l < kLanes; l += step()) {
        const V3 p = rowsAt(rows, l);
        const V bound = bounds_.isBounded() ? bounds_.points(p) : bounds_.height(p);
        least = hn::Min(least, bounds_.isPlane() ? hn::Abs(bound) : bound);
        hn::Store(bound, d, to[kBound].v + l);
        hn::Store(overSlab(p), d, to[kOverSlab].v + l);
      }
    }
    if (!contact_ && bounds_.tellsDistance()) addUpperBound(hn::GetLane(hn::MinOfLanes(d, least)));
  }

  /// What is known of the triangles of a leaf, a bit or a lane each.
  struct Triangles {
    alignas(32) float bounds[kLanes];
    uint32_t near = 0, meeting = 0;
  };

  /// By the vertices' bounds and heights.
  HWY_INLINE void boundByVertices(const LeafView& view, const Lanes* values, float bound,
                                  Triangles& out) const {
    const CornerLanes corners(view.leaf);
    const Points vertices = {values, view.vertices.chunks};
    const V limit = set(search_.evaluator.cull_distance), inside = hn::Neg(pad());
    for (size_t l = 0; l < kLanes; l += step()) {
      const auto of = [&](int row, int k) { return corners.valueOf(vertices, row, k, l); };
      const auto leastOf = [](V a, V b, V c) { return hn::Min(hn::Min(a, b), c); };
      const V low = leastOf(of(kBound, 0), of(kBound, 1), of(kBound, 2));
      auto meeting = hn::Lt(low, inside);
      V lower = leastOf(of(kOverSlab, 0), of(kOverSlab, 1), of(kOverSlab, 2));
      if (!bounds_.isBounded()) {
        lower = hn::Max(lower, low);
        if (bounds_.isPlane()) {
          const V high = hn::Max(hn::Max(of(kBound, 0), of(kBound, 1)), of(kBound, 2));
          lower = hn::Max(lower, hn::Neg(high));
          meeting = hn::And(meeting, hn::Gt(high, pad()));
        }
      }
      lower = hn::Max(hn::Sub(lower, pad()), set(bound));
      hn::Store(lower, d, out.bounds + l);
      out.near |= bitsOf(hn::Lt(lower, limit)) << l;
      if (bounds_.tellsInside()) out.meeting |= bitsOf(meeting) << l;
    }
    const uint32_t used = (1U << view.leaf.num_faces) - 1;
    out.near &= used;
    out.meeting &= out.near;
  }

  /// Raises the bounds to raised(l, bounds), lanes from l.
  template <class Raised>
  HWY_INLINE void raise(Triangles& out, const Raised& raised) const {
    const V limit = set(search_.evaluator.cull_distance);
    out.near &= out.meeting | lanesWhere([&](size_t l) {
                  const V lower = raised(l, hn::Load(d, out.bounds + l));
                  hn::Store(lower, d, out.bounds + l);
                  return hn::Lt(lower, limit);
                });
  }

  HWY_INLINE void boundByBoxes(const LeafView& view, Triangles& out) const {
    BoxBlock boxes;
    boxTriangles(view, boxes);
    raise(out, [&](size_t l, V bounds) { return bounds_.boxes(boxes, l, contact_, bounds); });
  }

  HWY_NOINLINE void boundBySlabs(const LeafView& view, Triangles& out) const {
    const CornerLanes corners(view.leaf);
    raise(out, [&](size_t l, V bounds) {
      V3 p[3];
      for (int k = 0; k < 3; ++k) p[k] = corners.pointOf(view.vertices, k, l);
      return bounds_.trianglesOverSlabs(p, search_.evaluator.slabs(), bounds);
    });
  }

  /// True to end the search.
  bool leafOf(const NodePairList::Entry& entry) {
    if (entry.bound >= search_.evaluator.cull_distance) return false;
    const LeafView view(tree_, tree_.leaves[tree_.nodes[entry.pair.a].leaf()]);
    ++search_.counts.leaf_pairs;
    Lanes values[kRows * kMaxChunks];
    lookAt(view, values);
    Triangles triangles;
    boundByVertices(view, values, entry.bound, triangles);
    if (bounds_.isBounded() && (triangles.near & ~triangles.meeting) != 0) {
      boundByBoxes(view, triangles);
    }
    const auto hasSlabs = [&] { return triangles.near != 0 && !search_.evaluator.slabs().empty(); };
    if (hasSlabs()) boundBySlabs(view, triangles);
    if (search_.audit) tellTriangles(view, triangles);
    if (triangles.near == 0) return false;
    ++search_.counts.leaf_kernels;
    while (triangles.near != 0) {
      const uint32_t lane = firstOf(triangles.near), triangle = view.face(lane).triangle();
      const float bound = triangles.bounds[lane];
      const bool meets = (triangles.meeting >> lane & 1U) != 0;
      triangles.near &= triangles.near - 1;
      if (bound > 0 && !meets) {
        frontier_.keep(bound, triangle);
        continue;
      }
      const uint32_t added = search_.evaluator.numAdded();
      if (evaluate(triangle, meets)) return true;
      if (search_.evaluator.numAdded() != added && hasSlabs()) boundBySlabs(view, triangles);
    }
    return false;
  }

  HWY_NOINLINE void tellTriangles(const LeafView& view, const Triangles& triangles) const {
    for (uint32_t i = 0; i < view.leaf.num_faces; ++i) {
      search_.audit->boundTriangle(view.face(i).triangle(), triangles.bounds[i],
                                   (triangles.meeting >> i & 1U) != 0);
    }
  }

  const SolidSearch& search_;
  const Tree& tree_;
  const SolidBounds bounds_;
  const bool contact_;
  Frontier frontier_;
};

void solid(const SolidSearch& search) { SolidTraversal(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
