// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Whether leaves that float leaves open are apart in double, along the slab that comes closest.
inline HWY_NOINLINE bool areApartInDouble(const Search& search, const LeafView& a,
                                          const LeafView& b, const Direction& along) {
  if (!search.evaluator.triesDouble()) return false;
  const float direction[3] = {along.w.x, along.w.y, along.w.z};
  const StoredPoints points_a = {a.vertices.rows, a.leaf.num_vertices},
                     points_b = {b.vertices.rows, b.leaf.num_vertices};
  return search.evaluator.triedDouble(boundAlong(direction, points_a, points_b, search.pose) > 0);
}

/// Faces of `on` that a triangle, by its corners in their frame, is not wholly on one side of.
HWY_INLINE uint32_t mayMeet(const LeafView& on, const Vec3 (&corners)[3], float pad) {
  const V pads = set(pad), minus_pads = set(-pad);
  return firstLanes(on.leaf.num_faces) & lanesWhere([&](size_t l) {
           const Faces faces = {on.faces, l};
           V low, high, inside[3];
           for (int c = 0; c < 3; ++c) {
             const V3 p = inAllLanes(corners[c]);
             const V h = faces.height(p);
             low = c == 0 ? h : hn::Min(low, h);
             high = c == 0 ? h : hn::Max(high, h);
             for (int k = 0; k < 3; ++k) {
               const V e = faces.inside(k, p);
               inside[k] = c == 0 ? e : hn::Max(inside[k], e);
             }
           }
           auto may = hn::And(hn::Le(low, pads), hn::Ge(high, minus_pads));
           for (int k = 0; k < 3; ++k) may = hn::And(may, hn::Ge(inside[k], minus_pads));
           return may;
         });
}

/// Evaluates all pairs of triangles that may touch. True to end the search.
[[gnu::hot]] inline HWY_NOINLINE bool contactsOfLeaves(const Search& search, const LeafView& a,
                                                       const LeafView& b, const Points& vertices_b,
                                                       const Slab& /*slab*/) {
  const FloatFrame& frames = search.frames;
  VertexRows moved_a;
  const Points vertices_a = moveVertices(a, frames.b_from_a, moved_a);
  const auto cornersOf = [](const LeafView& leaf, const Points& vertices, uint32_t i,
                            Vec3(&out)[3]) {
    for (int k = 0; k < 3; ++k) out[k] = vertices.at(leaf.leaf.corners[3 * i + k]);
  };
  uint32_t of_b[kLeafTriangles];
  for (uint32_t j = 0; j < b.leaf.num_faces; ++j) {
    Vec3 corners[3];
    cornersOf(b, vertices_b, j, corners);
    of_b[j] = mayMeet(a, corners, frames.pad);
  }
  for (uint32_t i = 0; i < a.leaf.num_faces; ++i) {
    Vec3 corners[3];
    cornersOf(a, vertices_a, i, corners);
    for (uint32_t may = mayMeet(b, corners, frames.pad); may != 0; may &= may - 1) {
      const uint32_t j = firstOf(may);
      if ((of_b[j] >> i & 1U) == 0) continue;
      ++search.counts.exact;
      if (search.evaluator.evaluate({PairKind::kFaces, a.face(i), b.face(j)})) return true;
    }
  }
  return false;
}

/// Depth first: all that overlaps is looked at, until an evaluator ends it. Boxes tell so well
/// which way leads deepest that a large batch mostly looks where it need not.
template <class LeafPair>
HWY_INLINE void touching(const Search& search, const LeafPair& leaf_pair) {
  Leaves leaves_a(search.a), leaves_b(search.b);
  LastLeaves last(search);
  Bracketed pair;
  const Expander expander(search);
  const size_t batch_size =
      expander.tightener().hasBoxes() ? tuning::kBoxedContactBatch : tuning::kBatch;
  Frontier frontier;
  expander.pushRoots(frontier);
  const auto meets = [&](NodePair nodes) {
    ++search.counts.leaf_pairs;
    pair.nodes = nodes;
    const LeafView a = leaves_a(nodes.a), b = leaves_b(nodes.b);
    bracketLeaves(search, a, b, last, pair);
    const Slab& slab = pair.slab;
    if (slab.apart) return false;
    const bool open = slab.bottom_b - slab.top_a > -2 * search.frames.pad * slab.along.length;
    if (HWY_UNLIKELY(open) && areApartInDouble(search, a, b, slab.along)) return false;
    ++search.counts.leaf_kernels;
    return leaf_pair(search, a, b, last.b.vertices, slab);
  };
  for (;;) {
    while (!frontier.leaves.empty()) {
      if (meets(frontier.leaves.pop().pair)) return;
    }
    NodePairList::Entry batch[tuning::kBatch];
    const size_t n = frontier.inner.pop(batch, batch_size);
    if (n == 0) return;
    expander.expand<false>(batch, n, frontier);
  }
}

[[gnu::hot]] void contact(const Search& search) { touching(search, edgesCross); }

[[gnu::hot]] void contacts(const Search& search) { touching(search, contactsOfLeaves); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
