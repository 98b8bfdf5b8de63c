// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// A leaf with its chunks found.
struct LeafView {
  LeafView(const Tree& tree, const Leaf& l)
      : LeafView(l, tree.lanes.data() + l.offset, tree.features.data() + l.feature_offset) {}

  LeafView(const Leaf& l, const Lanes* rows, const FeatureId* features)
      : leaf(l),
        vertices{rows, l.vertexChunks()},
        faces(rows + 3 * vertices.chunks),
        ids(features) {}

  FeatureId face(uint32_t i) const { return ids[i]; }
  FeatureId edge(uint32_t i) const { return ids[leaf.num_faces + i]; }
  FeatureId vertex(uint32_t i) const { return ids[leaf.num_faces + leaf.num_edges + i]; }

  const Leaf& leaf;
  Points vertices;
  const Lanes* faces;
  const FeatureId* ids;
};

/// Vertices of a leaf in some frame, rows x, y, z by chunk.
struct VertexRows {
  Lanes rows[3 * kMaxChunks];
};
/// Some edges of a leaf in some frame: rows of start x, y, z and direction x, y, z by chunk. Lanes
/// beyond the last repeat it.
struct EdgeRows {
  int chunks() const { return (count + kLanes - 1) / kLanes; }

  Lanes rows[6 * kMaxChunks];
  /// The edge's index in the leaf, << 16, and its ends as in Leaf. Writes go in whole vectors and
  /// may run one vector over the end.
  alignas(32) uint32_t edges[kMaxLeafFeatures + kLanes];
  int count;

  uint32_t index(int i) const { return edges[i] >> 16; }
};

HWY_INLINE Points moveVertices(const LeafView& leaf, const FloatPose& X, VertexRows& out) {
  for (int c = 0; c < leaf.vertices.chunks; ++c) {
    moveRows(leaf.vertices.rows + 3 * c, X, out.rows + 3 * c);
  }
  return {out.rows, leaf.vertices.chunks};
}

/// Coordinate i of the points that the lanes of `at` name.
HWY_INLINE V lookUp(const Points& points, int i, hn::Vec<DU> at) {
  if constexpr (hn::MaxLanes(d) == kLanes) {
    const auto lane = hn::IndicesFromVec(d, hn::And(at, hn::Set(du, kLanes - 1)));
    V found = hn::TableLookupLanes(load(points.rows[i], 0), lane);
    for (int c = 1; c < points.chunks; ++c) {
      const V of_chunk = hn::TableLookupLanes(load(points.rows[3 * c + i], 0), lane);
      const auto there = hn::Gt(at, hn::Set(du, static_cast<uint32_t>(kLanes * c - 1)));
      found = hn::IfThenElse(hn::RebindMask(d, there), of_chunk, found);
    }
    return found;
  } else {
    uint32_t which[kLanes];
    float found[kLanes];
    hn::StoreU(at, du, which);
    for (size_t l = 0; l < step(); ++l) {
      found[l] = points.rows[3 * (which[l] / kLanes) + i].v[which[l] % kLanes];
    }
    return hn::LoadU(d, found);
  }
}

/// The corners of a leaf's triangles, by vertex, one triangle a lane; the last is repeated.
struct CornerLanes {
  HWY_INLINE explicit CornerLanes(const Leaf& leaf) {
    for (uint32_t i = 0; i < kLanes; ++i) {
      const uint32_t face = std::min(i, leaf.num_faces - 1U);
      for (uint32_t k = 0; k < 3; ++k) vertices[k][i] = leaf.corners[3 * face + k];
    }
  }

  /// Row `row` of chunks as Points, at corner k.
  HWY_INLINE V valueOf(const Points& rows, int row, int k, size_t l) const {
    return lookUp(rows, row, hn::Load(du, vertices[k] + l));
  }
  HWY_INLINE V3 pointOf(const Points& points, int k, size_t l) const {
    return {valueOf(points, 0, k, l), valueOf(points, 1, k, l), valueOf(points, 2, k, l)};
  }

  alignas(32) uint32_t vertices[3][kLanes];
};

/// The edges that have an end in `vertices_wanted` (bits), between vertices in some frame.
HWY_INLINE void gatherEdges(const LeafView& leaf, const Points& vertices, uint32_t vertices_wanted,
                            EdgeRows& out) {
  const auto byte = hn::Set(du, 0xFF);
  out.count = 0;
  for (uint32_t i = 0; i < leaf.leaf.num_edges; ++i) {
    const uint32_t ends = leaf.leaf.ends[i];
    out.edges[out.count] = i << 16 | ends;
    out.count +=
        static_cast<int>((vertices_wanted >> (ends & 0xFF) | vertices_wanted >> (ends >> 8)) & 1);
  }
  if (out.count == 0) return;
  for (size_t l = 0; l < kLanes; l += step()) {
    hn::StoreU(hn::Set(du, out.edges[out.count - 1]), du, out.edges + out.count + l);
  }
  for (int c = 0; c < out.chunks(); ++c) {
    Lanes* const chunk = out.rows + 6 * c;
    for (size_t l = 0; l < kLanes; l += step()) {
      const auto edges = hn::Load(du, out.edges + c * kLanes + l);
      const auto starts = hn::And(edges, byte), ends = hn::And(hn::ShiftRight<8>(edges), byte);
      for (int i = 0; i < 3; ++i) {
        const V start = lookUp(vertices, i, starts);
        hn::Store(start, d, chunk[i].v + l);
        hn::Store(hn::Sub(lookUp(vertices, i, ends), start), d, chunk[3 + i].v + l);
      }
    }
  }
}

/// The leaves' mean normals, both in a's frame.
HWY_INLINE Across acrossA(const Leaf& a) {
  return {directionOf(vec3(a.normal)), a.normal_bottom, a.normal_top};
}
HWY_INLINE Across acrossB(const Leaf& b, const FloatPose& X) {
  const Vec3 n = rotated(X, vec3(b.normal));
  const float shift = dot(n, vec3(X.t));
  return {directionOf(n), b.normal_bottom + shift, b.normal_top + shift};
}

/// A leaf of b in a's frame.
struct MovedLeaf {
  void move(const LeafView& b, const FloatPose& X) {
    vertices = moveVertices(b, X, rows);
    centroid = moved(X, vec3(b.leaf.centroid));
  }

  Points vertices;  ///< in `rows`
  Vec3 centroid;
  VertexRows rows;
};

/// Calls look(hull_a, hull_b) with the points of two leaves.
template <class Look>
HWY_INLINE void betweenHulls(const Points& a, const Points& b, const Look& look) {
  if (HWY_LIKELY(a.chunks == 2 && b.chunks == 2)) {
    look(Hull<2>(a.rows), Hull<2>(b.rows));
  } else if (a.chunks == 2) {
    look(Hull<2>(a.rows), Hull<3>(b.rows));
  } else if (b.chunks == 2) {
    look(Hull<3>(a.rows), Hull<2>(b.rows));
  } else {
    look(Hull<3>(a.rows), Hull<3>(b.rows));
  }
}

/// Vertices with w . p >= least, as bits.
HWY_INLINE uint32_t facing(const Points& vertices, Vec3 w, float least) {
  const V3 along = inAllLanes(w);
  const V leasts = set(least);
  uint32_t result = 0;
  for (int c = 0; c < vertices.chunks; ++c) {
    const Lanes* const rows = vertices.rows + 3 * c;
    for (size_t l = 0; l < kLanes; l += step()) {
      result |= bitsOf(hn::Ge(dot(rowsAt(rows, l), along), leasts)) << (kLanes * c + l);
    }
  }
  return result;
}

/// The faces of a leaf in the lanes from l on, by their stored planes: the face's, and those of the
/// prism that stands on its edges. Where a leaf has one, it is in all of them. In section:
///
///     :         :    . p
///     :  prism  :    |      height above the plane of the face
///     :         :    |
///     +=========+----+
///        face    beyond     |p - face|^2 >= height^2 + beyond^2
struct Faces {
  V height(const V3& p) const { return plane(kFacePlane, p); }
  V inside(int k, const V3& p) const { return plane(kEdgePlanes + 4 * k, p); }
  /// How far points lie within all edges' planes.
  V within(const V3& p) const { return hn::Min(hn::Min(inside(0, p), inside(1, p)), inside(2, p)); }
  /// Lower bounds of the distances of points: one lies above the face by one length, and beyond an
  /// edge by another at right angles to it. Triangles without a normal have the bound 0.
  V distances(const V3& p) const {
    const V h = height(p), beyond = positive(hn::Neg(within(p)));
    return hn::Sqrt(hn::Add(hn::Mul(h, h), hn::Mul(beyond, beyond)));
  }
  V slope(int row, const V3& v) const { return dot(rowsAt(rows + row, l), v); }
  V plane(int row, const V3& p) const { return hn::Add(slope(row, p), load(rows[row + 3], l)); }

  const Lanes* rows;
  size_t l;
};

/// Lanes in which an edge (from p along a, in the face's frame) may cross or touch a face. Heights
/// and distances to the edge planes are right to `pad`. Where the edge is steep, its crossing point
/// is right to pad (2 + 8 |a| / |dh|) along it.
HWY_INLINE hn::Mask<D> mayCross(const Faces& faces, const V3& p, const V3& a, float pad) {
  const V pads = set(pad), minus_pads = set(-pad);
  const V h0 = faces.height(p), dh = faces.slope(kFacePlane, a), h1 = hn::Add(h0, dh);
  auto may = hn::And(hn::Le(hn::Min(h0, h1), pads), hn::Ge(hn::Max(h0, h1), minus_pads));
  if (bitsOf(may) == 0) return may;
  const V steepness = hn::Abs(dh), length = hn::Sqrt(dot(a, a));
  const auto flat = hn::Lt(steepness, hn::Mul(set(8), pads));
  const V divisor = hn::IfThenElse(flat, set(1), dh);
  const V s = hn::Min(hn::Max(hn::Div(hn::Neg(h0), divisor), hn::Zero(d)), set(1));
  const V slack =
      hn::Mul(minus_pads, hn::Add(set(2), hn::Div(hn::Mul(set(8), length), hn::Abs(divisor))));
  for (int k = 0; k < 3; ++k) {
    const V e0 = faces.inside(k, p), de = faces.slope(kEdgePlanes + 4 * k, a);
    may = hn::And(may, hn::Ge(hn::Max(e0, hn::Add(e0, de)), minus_pads));
    may = hn::And(may, hn::Or(flat, hn::Ge(hn::Add(e0, hn::Mul(s, de)), slack)));
  }
  return may;
}

/// Evaluates some edges of one leaf, in rows moved to the frame of the other, against its
/// faces.
template <bool kEdgesOfA>
[[gnu::hot]] inline HWY_NOINLINE bool crossings(const LeafView& edges, const EdgeRows& some,
                                                const LeafView& faces, float pad,
                                                RefineCallback& evaluator, long long& exact) {
  const auto cross = [&](int i, uint32_t lane) {
    ++exact;
    const FeatureId face = faces.face(lane), edge = edges.edge(some.index(i));
    return evaluator.evaluate(kEdgesOfA ? Candidate{PairKind::kEdgeFace, edge, face}
                                        : Candidate{PairKind::kFaceEdge, face, edge});
  };
  if (faces.leaf.num_faces == 1) {  // lanes are edges
    for (int c = 0; c < some.chunks(); ++c) {
      const Lanes* const rows = some.rows + 6 * c;
      uint32_t may = lanesWhere([&](size_t l) {
        return mayCross({faces.faces, l}, rowsAt(rows, l), rowsAt(rows + 3, l), pad);
      });
      for (may &= firstLanes(some.count - kLanes * c); may != 0; may &= may - 1) {
        if (cross(kLanes * c + static_cast<int>(firstOf(may)), 0)) return true;
      }
    }
    return false;
  }
  const uint32_t used = firstLanes(faces.leaf.num_faces);
  for (int i = 0; i < some.count; ++i) {
    const Points chunk = {some.rows + 6 * (i / kLanes), 1};
    const Points directions = {chunk.rows + 3, 1};
    const V3 p = inAllLanes(chunk.at(i % kLanes)), a = inAllLanes(directions.at(i % kLanes));
    uint32_t may = used & lanesWhere([&](size_t l) {
                     return mayCross({faces.faces, l}, p, a, pad);
                   });
    for (; may != 0; may &= may - 1) {
      if (cross(i, firstOf(may))) return true;
    }
  }
  return false;
}

/// Evaluates the edges of either leaf against the faces of the other. What meets lies between
/// the planes of the slab, so that edges beyond can't. True to end the search.
[[gnu::hot]] inline HWY_NOINLINE bool edgesCross(const Search& search, const LeafView& a,
                                                 const LeafView& b, const Points& vertices_b,
                                                 const Slab& slab) {
  const FloatFrame& frames = search.frames;
  long long& exact = search.counts.exact;
  const Vec3 w = slab.along.w;
  const float thickness = frames.pad * slab.along.length;
  EdgeRows edges;
  gatherEdges(b, vertices_b, facing(vertices_b, -1.0F * w, -slab.top_a - thickness), edges);
  if (crossings<false>(b, edges, a, frames.pad, search.evaluator, exact)) return true;
  VertexRows moved_a;
  gatherEdges(a, moveVertices(a, frames.b_from_a, moved_a),
              facing(a.vertices, w, slab.bottom_b - thickness), edges);
  return crossings<true>(a, edges, b, frames.pad, search.evaluator, exact);
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
