// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

HWY_INLINE V clamp01(V v) { return hn::Min(positive(v), set(1)); }

/// An edge as it is tested: start, direction a, |a|^2 and its guarded reciprocal.
struct Edges {
  V3 p, a;
  V square, inverse;
};

HWY_INLINE Edges edgesIn(const Lanes* rows, size_t l, V least_square) {
  const V3 a = rowsAt(rows + 3, l);
  const V square = dot(a, a);
  return {rowsAt(rows, l), a, square, hn::Div(set(1), hn::Max(square, least_square))};
}

/// Squared distances of two edges a lane, each at most the true one plus the rounding of the
/// points (the pad's): what the rounding of the parameters can add is taken off.
///
/// u = 2^-24, t = q - p, sin^2 = 1 - (ab / aa)(ab / bb) to 16 u, s = ((at / aa) - (bt / bb)(ab /
/// aa)) / sin^2 with a numerator right to 25 u |t| / |a|. So s errs by at most e = (25 u |t| / |a|
/// + 16 u) / sin^2. The re-projections move both points to the nearest of the other, whatever s:
/// the excess is at most e^2 |a|^2 sin^2 <= 2^-37 (|t|^2 + |a|^2) / sin^2, counted twice. Below
/// sin^2 = 2^-19, where s may be anything in [0, 1], the excess is at most |a|^2 sin^2 < 2^-18
/// |a|^2, which the same term exceeds. Edges shorter than 2^-24 S (least_square) are points to the
/// pad.
HWY_INLINE V edgeDistances(const Edges& a, const Edges& b) {
  const V3 t = b.p - a.p;
  const V ab = dot(a.a, b.a), at = dot(a.a, t), bt = dot(b.a, t);
  const V p = hn::Mul(ab, a.inverse), q = hn::Mul(ab, b.inverse);
  const V alpha = hn::Mul(at, a.inverse), beta = hn::Mul(bt, b.inverse);
  const V sine2 = hn::Max(hn::Sub(set(1), hn::Mul(p, q)), set(0x1p-19F));
  const V over_sine2 = hn::Div(set(1), sine2);
  V s = clamp01(hn::Mul(hn::Sub(alpha, hn::Mul(beta, p)), over_sine2));
  const V v = clamp01(hn::Sub(hn::Mul(s, q), beta));
  s = clamp01(hn::Add(hn::Mul(v, p), alpha));
  const V3 w = t + v * b.a - s * a.a;
  const V excess = hn::Mul(hn::Mul(set(0x1p-36F), hn::Add(dot(t, t), a.square)), over_sine2);
  return hn::Sub(dot(w, w), excess);
}

/// Squared heights of points above the faces that they may project into, infinity elsewhere.
HWY_INLINE V faceDistances(const Faces& faces, const V3& p, V minus_pad) {
  const V h = faces.height(p);
  return hn::IfThenElse(hn::Ge(faces.within(p), minus_pad), hn::Mul(h, h), set(kInfinityFloat));
}

/// Squared distances of the features of two leaves in rows of lanes: an edge of a against a chunk
/// of b's edges; a vertex of one against the other's faces.
class LeafDistances {
 public:
  LeafDistances(const LeafView& a, const LeafView& b) : a_(a), b_(b) {}

  /// The least of them. Features that the slab proves farther than `distance` are left out.
  [[gnu::hot]] float compute(const Points& vertices_b, const FloatFrame& frames, const Slab& slab,
                             float distance) {
    const Vec3 w = slab.along.w;
    const float thickness = distance * slab.along.length;
    const uint32_t near_a = facing(a_.vertices, w, slab.bottom_b - thickness);
    const uint32_t near_b = facing(vertices_b, -1.0F * w, -slab.top_a - thickness);
    gatherEdges(a_, a_.vertices, near_a, edges_a_);
    gatherEdges(b_, vertices_b, near_b, edges_b_);
    V least = edgeRows(0x1p-24F * frames.scale);
    const V minus_pad = set(-frames.pad);
    const uint32_t of_a = near_a & owned(a_), of_b = near_b & owned(b_);
    for (uint32_t left = of_a; left != 0; left &= left - 1) {
      const int i = static_cast<int>(firstOf(left));
      const Vec3 point = moved(frames.b_from_a, a_.vertices.at(i));
      least = hn::Min(least, faceRow(PairKind::kVertexFace, i, b_, point, minus_pad));
    }
    for (uint32_t left = of_b; left != 0; left &= left - 1) {
      const int i = static_cast<int>(firstOf(left));
      least = hn::Min(least, faceRow(PairKind::kFaceVertex, i, a_, vertices_b.at(i), minus_pad));
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
  }

  /// Evaluates everything that may be within evaluator.candidate_limit, the nearest by float first.
  bool evaluateNear(float least, float pad, RefineCallback& evaluator, long long& exact) const {
    if (!(least <= squaredLimit(evaluator, pad))) return false;
    if (evaluateRows(least, true, pad, evaluator, exact)) return true;
    // Where an error is allowed, features that are nearly as near as the nearest are left out.
    if (std::sqrt(std::max(least, 0.0F)) - pad >= evaluator.cull_distance) return false;
    return evaluateRows(least, false, pad, evaluator, exact);
  }

 private:
  /// A row tests edge `index` of those gathered, or vertex `index`, against lanes: edges of the
  /// chunk, or faces.
  struct Row {
    PairKind kind;
    uint8_t index, chunk;
    uint8_t lanes;  ///< those that are features, as bits
  };

  void addRow(PairKind kind, int index, int chunk, uint32_t lanes) {
    row_[rows_++] = {kind, static_cast<uint8_t>(index), static_cast<uint8_t>(chunk),
                     static_cast<uint8_t>(lanes)};
  }

  static uint32_t owned(const LeafView& leaf) { return (1U << leaf.leaf.num_owned) - 1; }

  V edgeRows(float shortest) {
    const V least_square = set(shortest * shortest);
    V least = set(kInfinityFloat);
    alignas(32) float inverse_a[kMaxLeafFeatures], square_a[kMaxLeafFeatures];
    for (int c = 0; c < edges_a_.chunks(); ++c) {
      for (size_t l = 0; l < kLanes; l += step()) {
        const Edges e = edgesIn(edges_a_.rows + 6 * c, l, least_square);
        hn::Store(e.square, d, square_a + c * kLanes + l);
        hn::Store(e.inverse, d, inverse_a + c * kLanes + l);
      }
    }
    for (int c = 0; c < edges_b_.chunks(); ++c) {
      const int first = rows_;
      const uint32_t lanes = firstLanes(edges_b_.count - kLanes * c);
      for (int i = 0; i < edges_a_.count; ++i) addRow(PairKind::kEdgeEdge, i, c, lanes);
      for (size_t l = 0; l < kLanes; l += step()) {
        const Edges eb = edgesIn(edges_b_.rows + 6 * c, l, least_square);
        for (int i = 0; i < edges_a_.count; ++i) {
          const Lanes* const rows = edges_a_.rows + 6 * (i / kLanes);
          const Edges ea = {inAllLanes(Points{rows, 1}.at(i % kLanes)),
                            inAllLanes(Points{rows + 3, 1}.at(i % kLanes)), set(square_a[i]),
                            set(inverse_a[i])};
          const V square = edgeDistances(ea, eb);
          hn::Store(square, d, squares_[first + i].v + l);
          least = hn::Min(least, square);
        }
      }
    }
    return least;
  }

  /// A vertex against the faces of the other leaf, in whose frame it is.
  V faceRow(PairKind kind, int vertex, const LeafView& on, Vec3 point, V minus_pad) {
    const V3 p = inAllLanes(point);
    V least = set(kInfinityFloat);
    for (size_t l = 0; l < kLanes; l += step()) {
      const V square = faceDistances({on.faces, l}, p, minus_pad);
      hn::Store(square, d, squares_[rows_].v + l);
      least = hn::Min(least, square);
    }
    addRow(kind, vertex, 0, firstLanes(on.leaf.num_faces));
    return least;
  }

  static float squaredLimit(const RefineCallback& evaluator, float pad) {
    const float reach = evaluator.candidate_limit + pad;
    return reach * reach;
  }

  bool evaluateRows(float least, bool nearest, float pad, RefineCallback& evaluator,
                    long long& exact) const {
    float limit = squaredLimit(evaluator, pad);
    for (int r = 0; r < rows_; ++r) {
      uint32_t near = lanesWhere([&](size_t l) {
        const V square = load(squares_[r], l);
        const auto match = hn::Eq(square, set(least));
        return nearest ? match : hn::AndNot(match, hn::Le(square, set(limit)));
      });
      if (HWY_LIKELY(near == 0)) continue;
      for (near &= row_[r].lanes; near != 0; near &= near - 1) {
        const uint32_t lane = firstOf(near);
        if (squares_[r].v[lane] > limit) continue;
        ++exact;
        if (evaluator.evaluate(candidate(row_[r], lane))) return true;
        limit = squaredLimit(evaluator, pad);
      }
    }
    return false;
  }

  Candidate candidate(const Row& row, uint32_t lane) const {
    if (row.kind == PairKind::kEdgeEdge) {
      const int j = kLanes * row.chunk + static_cast<int>(lane);
      return {row.kind, a_.edge(edges_a_.index(row.index)), b_.edge(edges_b_.index(j))};
    }
    if (row.kind == PairKind::kVertexFace) return {row.kind, a_.vertex(row.index), b_.face(lane)};
    return {row.kind, a_.face(lane), b_.vertex(row.index)};
  }

  static constexpr int kMaxRows = kMaxLeafFeatures * kMaxChunks + 2 * kMaxLeafFeatures;

  const LeafView& a_;
  const LeafView& b_;
  EdgeRows edges_a_, edges_b_;
  int rows_ = 0;
  Row row_[kMaxRows];
  Lanes squares_[kMaxRows];
};

/// Evaluates all features of two leaves that may be nearest.
[[gnu::hot]] inline HWY_NOINLINE bool nearestOfLeaves(const Search& search, const LeafView& a,
                                                      const LeafView& b, const Slab& slab,
                                                      float bound) {
  const FloatFrame& frames = search.frames;
  RefineCallback& evaluator = search.evaluator;
  ++search.counts.leaf_kernels;
  VertexRows moved_b;
  const Points vertices_b = moveVertices(b, frames.a_from_b, moved_b);
  // Only what overlaps can cross.
  if (bound <= 0 && edgesCross(search, a, b, vertices_b, slab)) return true;
  LeafDistances distances(a, b);
  const float least =
      distances.compute(vertices_b, frames, slab, evaluator.candidate_limit + frames.pad);
  return distances.evaluateNear(least, frames.pad, evaluator, search.counts.exact);
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
