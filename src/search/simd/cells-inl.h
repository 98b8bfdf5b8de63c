// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels. search/cell_search.h derives the pads.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

constexpr float kLeastGap = 0x1p-96F;

/// The spheres of a node, one a lane, in the frame of the cells; from the sixth lane on S0 again.
struct SphereLanes {
  Lanes x, y, z, r;
  SphereLanes(const Node& node, const FloatPose& X) {
    alignas(32) static constexpr uint32_t kBase[kLanes] = {0, 1, 1, 3, 3, 0, 0, 0};
    alignas(32) static constexpr uint32_t kHalf[kLanes] = {0, 2, 2, 4, 4, 0, 0, 0};
    alignas(32) static constexpr float kSign[kLanes] = {0, 1, -1, 1, -1, 0, 0, 0};
    const float* const rows[4] = {node.x, node.y, node.z, node.r};
    for (size_t l = 0; l < kLanes; l += step()) {
      const V sign = hn::Load(d, kSign + l);
      V p[4];
      for (int i = 0; i < 4; ++i) {
        if constexpr (hn::MaxLanes(d) == kLanes) {
          const V row = hn::LoadU(d, rows[i]);
          const auto base = hn::IndicesFromVec(d, hn::Load(du, kBase));
          const auto half = hn::IndicesFromVec(d, hn::Load(du, kHalf));
          p[i] = hn::Add(hn::TableLookupLanes(row, base),
                         hn::Mul(sign, hn::TableLookupLanes(row, half)));
        } else {
          float base[kLanes], half[kLanes];
          for (size_t k = 0; k < step(); ++k) {
            base[k] = rows[i][kBase[l + k]];
            half[k] = rows[i][kHalf[l + k]];
          }
          p[i] = hn::Add(hn::LoadU(d, base), hn::Mul(sign, hn::LoadU(d, half)));
        }
      }
      const V3 center = moved(X, {p[0], p[1], p[2]});
      hn::Store(center.x, d, x.v + l);
      hn::Store(center.y, d, y.v + l);
      hn::Store(center.z, d, z.v + l);
      hn::Store(p[3], d, r.v + l);
    }
  }
};

/// The triangles of a leaf, one a lane, in the frame of the cells.
struct MovedTriangles {
  uint32_t leaf = ~0U;
  uint32_t used;
  Lanes p[3][3];  ///< by corner and coordinate

  HWY_NOINLINE void place(const LeafView& view, const FloatPose& X) {
    const CornerLanes corners(view.leaf);
    used = (1U << view.leaf.num_faces) - 1;
    for (size_t l = 0; l < kLanes; l += step()) {
      for (int k = 0; k < 3; ++k) {
        const V3 corner = corners.pointOf(view.vertices, k, l);
        const V3 p_k = moved(X, corner);
        hn::Store(p_k.x, d, p[k][0].v + l);
        hn::Store(p_k.y, d, p[k][1].v + l);
        hn::Store(p_k.z, d, p[k][2].v + l);
      }
    }
  }
};

/// The lanes, as bits, whose widest gap counts.
HWY_INLINE uint32_t apartBits(V widest) { return bitsOf(hn::Gt(widest, hn::Set(d, kLeastGap))); }

/// The widest gaps between boxes and cubes of half size g along the octree's axes, one of either a
/// lane: `e` are the box's moved axes, `half` its halves, `c` its centre less the cube's. Along the
/// axes of both, and only if that leaves a lane, along their products.
HWY_INLINE V widestGap(const V3 (&e)[3], const V3& half, const V3& c, V g) {
  const V halves[3] = {half.x, half.y, half.z}, at[3] = {c.x, c.y, c.z};
  const V axis[3][3] = {
      {e[0].x, e[0].y, e[0].z}, {e[1].x, e[1].y, e[1].z}, {e[2].x, e[2].y, e[2].z}};
  V size[3][3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) size[j][i] = hn::Abs(axis[j][i]);
  }
  V widest = hn::Set(d, -kInfinityFloat);
  const auto note = [&](V middle, V own, V reach) {
    widest = hn::Max(widest, hn::Sub(hn::Abs(middle), hn::Add(own, reach)));
  };
  for (int i = 0; i < 3; ++i) {
    note(at[i], dot(size[0][i], size[1][i], size[2][i], half.x, half.y, half.z), g);
    note(dot(e[i], c), halves[i], hn::Mul(g, hn::Add(hn::Add(size[i][0], size[i][1]), size[i][2])));
  }
  if (hn::AllTrue(d, hn::Gt(widest, hn::Set(d, kLeastGap)))) return widest;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {  // w = unit vector i x axis j
      const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
      const auto along = [&](const V(&v)[3]) {
        return hn::Sub(hn::Mul(axis[j][k], v[l]), hn::Mul(axis[j][l], v[k]));
      };
      note(along(at),
           hn::Add(hn::Mul(hn::Abs(along(axis[m])), halves[m]),
                   hn::Mul(hn::Abs(along(axis[n])), halves[n])),
           hn::Mul(g, hn::Add(size[j][k], size[j][l])));
    }
  }
  return widest;
}

/// The widest gaps between triangles and a cube of half size g about c, along the octree's axes,
/// and only if that leaves a lane, along the normal and the nine products of edges. Then `depth` is
/// the least half size of such a cube that a corner or the middle of an edge lies in.
HWY_INLINE V widestGap(const MovedTriangles& t, size_t l, const float (&c)[3], V g, V& depth) {
  V v[3][3], e[3][3], n[3];
  V widest = hn::Set(d, -kInfinityFloat);
  const auto note = [&](V low, V high, V reach) {
    widest = hn::Max(widest, hn::Sub(hn::Max(low, hn::Neg(high)), reach));
  };
  for (int i = 0; i < 3; ++i) {
    const V center = hn::Set(d, c[i]);
    for (int k = 0; k < 3; ++k) v[k][i] = hn::Sub(load(t.p[k][i], l), center);
    note(hn::Min(hn::Min(v[0][i], v[1][i]), v[2][i]), hn::Max(hn::Max(v[0][i], v[1][i]), v[2][i]),
         g);
  }
  if (hn::AllTrue(d, hn::Gt(widest, hn::Set(d, kLeastGap)))) return widest;
  for (int k = 0; k < 3; ++k) {
    V middle[3];
    for (int i = 0; i < 3; ++i) {
      e[k][i] = hn::Sub(v[(k + 1) % 3][i], v[k][i]);
      middle[i] = hn::Mul(hn::Set(d, 0.5F), hn::Add(v[(k + 1) % 3][i], v[k][i]));
    }
    for (const auto& p : {v[k], middle}) {
      depth = hn::Min(depth, hn::Max(hn::Max(hn::Abs(p[0]), hn::Abs(p[1])), hn::Abs(p[2])));
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = hn::Sub(hn::Mul(e[0][j], e[1][k]), hn::Mul(e[0][k], e[1][j]));
  }
  const auto height = [&](int k) { return dot(n[0], n[1], n[2], v[k][0], v[k][1], v[k][2]); };
  // The computed normal of a sliver may be any direction: all three corners count.
  const V h0 = height(0), h1 = height(1), h2 = height(2);
  note(hn::Min(h0, hn::Min(h1, h2)), hn::Max(h0, hn::Max(h1, h2)),
       hn::Mul(g, hn::Add(hn::Add(hn::Abs(n[0]), hn::Abs(n[1])), hn::Abs(n[2]))));
  for (int k = 0; k < 3; ++k) {
    const int other = (k + 2) % 3;
    for (int i = 0; i < 3; ++i) {  // w = unit vector i x edge k; both ends of the edge lie alike
      const int j = (i + 1) % 3, m = (i + 2) % 3;
      const auto along = [&](int corner) {
        return hn::Sub(hn::Mul(e[k][j], v[corner][m]), hn::Mul(e[k][m], v[corner][j]));
      };
      const V a = along(k), b = along(other);
      note(hn::Min(a, b), hn::Max(a, b), hn::Mul(g, hn::Add(hn::Abs(e[k][j]), hn::Abs(e[k][m]))));
    }
  }
  return widest;
}

/// Cells against nodes, depth first: the larger one is divided.
class CellTraversal {
 public:
  explicit CellTraversal(const CellSearch& search)
      : search_(search), tree_(search.tree), frame_(search.frame), X_(search.frame.from_mesh) {}

  void run() {
    // At most seven of each level that was opened wait.
    const size_t room =
        search_.num_start + (static_cast<size_t>(tree_.depth) + kCellLevels + 1) * kLanes;
    Entry usual[kUsual];
    std::vector<Entry> more;
    waiting_ = usual;
    if (HWY_UNLIKELY(room > kUsual)) {
      more.resize(room);
      waiting_ = more.data();
    }
    for (size_t i = search_.num_start; i-- > 0;) waiting_[size_++] = {search_.start[i], 0};
    while (size_ > 0) {
      const Entry at = waiting_[--size_];
      const Node& node = tree_.nodes[at.node];
      const float half = static_cast<float>(at.cell.half) * frame_.unit;
      constexpr float kRadius = 1.75F;  // of a cube, in halves
      if (at.cell.leaf != 0 && node.isLeaf()) {
        if (leafPair(at, node, half)) return;
      } else if (at.cell.leaf == 0 && (node.isLeaf() || kRadius * half > node.size)) {
        openCell(at, node, half);
      } else {
        openNode(at, node, half);
      }
    }
  }

 private:
  struct Entry {
    Cell cell;
    uint32_t node;
  };
  static constexpr size_t kUsual = 512, kPlaced = 8;

  float grown(float half, float pad) const { return half * (1 + 0x1p-20F) + pad; }
  float at(int32_t units) const { return static_cast<float>(units) * frame_.unit; }
  /// The eight children against the node's spheres, one sphere a lane: along each axis there are
  /// but two distances from them.
  void openCell(const Entry& entry, const Node& node, float half) {
    ++search_.counts.expansions;
    search_.counts.volume_tests += kLanes;
    const Cell& cell = entry.cell;
    const SphereLanes s(node, X_);
    const float h = 0.5F * half;
    const auto q = static_cast<int32_t>(cell.half / 2);
    const float low[3] = {at(cell.x - q), at(cell.y - q), at(cell.z - q)};
    const float high[3] = {at(cell.x + q), at(cell.y + q), at(cell.z + q)};
    const V g = hn::Set(d, grown(h, frame_.pad));
    uint32_t near = 0xFF;
    for (size_t l = 0; l < kLanes; l += step()) {
      const auto beyond = [&](V p, float center) {
        const V out = hn::Max(hn::Sub(hn::Abs(hn::Sub(p, hn::Set(d, center))), g), hn::Zero(d));
        return hn::Mul(out, out);
      };
      const V x = load(s.x, l), y = load(s.y, l), z = load(s.z, l), r = load(s.r, l);
      const V ox[2] = {beyond(x, low[0]), beyond(x, high[0])};
      const V oy[2] = {beyond(y, low[1]), beyond(y, high[1])};
      const V oz[2] = {beyond(z, low[2]), beyond(z, high[2])};
      const V square = hn::Mul(r, r);
      for (uint32_t i = 0; i < 8; ++i) {
        const V sum = hn::Add(hn::Add(ox[i & 1], oy[i >> 1 & 1]), oz[i >> 2]);
        near &= ~(static_cast<uint32_t>(!hn::AllFalse(d, hn::Gt(sum, square))) << i);
      }
    }
    if (near != 0 && node.flat != 0) {
      near &= ~boxMissesChildren(tree_.boxes[entry.node], low, high, h);
    }
    if (near == 0) return;
    const void* children[8];
    uint32_t leaves;
    near = search_.cells.open(cell.node, near, children, leaves);
    // The child on the node's side of the middle comes last, and so is taken first.
    const uint32_t side = uint32_t{s.x.v[0] > at(cell.x)} | uint32_t{s.y.v[0] > at(cell.y)} << 1 |
                          uint32_t{s.z.v[0] > at(cell.z)} << 2;
    for (const uint32_t flip : {7U, 6U, 5U, 3U, 4U, 2U, 1U, 0U}) {
      const uint32_t i = side ^ flip;
      if ((near >> i & 1) == 0) continue;
      waiting_[size_++] = {cell.child(i, children[i], (leaves >> i & 1) != 0), entry.node};
    }
  }

  /// The children, as bits, that the node's box misses.
  HWY_NOINLINE uint32_t boxMissesChildren(const Box& box, const float (&low)[3],
                                          const float (&high)[3], float h) const {
    alignas(32) float c[3][kLanes];
    for (uint32_t i = 0; i < kLanes; ++i) {
      for (uint32_t k = 0; k < 3; ++k) c[k][i] = (i >> k & 1) != 0 ? high[k] : low[k];
    }
    V3 e[3];
    for (int j = 0; j < 3; ++j) e[j] = rotated(X_, BoxLanes::column(box, j));
    const V3 half = {hn::Set(d, box.half[0]), hn::Set(d, box.half[1]), hn::Set(d, box.half[2])};
    const V3 center = moved(X_, BoxLanes::column(box, kCenter));
    const V g = hn::Set(d, grown(h, frame_.box_pad));
    uint32_t apart = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      const V3 child = {hn::Load(d, c[0] + l), hn::Load(d, c[1] + l), hn::Load(d, c[2] + l)};
      apart |= apartBits(widestGap(e, half, center - child, g)) << l;
    }
    return apart;
  }

  /// The node's children, one a lane, against the cube: S0, for each axis the cap on the far side,
  /// and where that helps boxes.
  void openNode(const Entry& entry, const Node& node, float half) {
    const auto block_at = static_cast<size_t>(node.child);
    const Block& block = tree_.blocks[block_at];
    const Children& children = tree_.children[block_at];
    ++search_.counts.expansions;
    search_.counts.volume_tests += children.count;
    FloatPose X = X_;  // to the cell's middle
    X.t[0] -= at(entry.cell.x);
    X.t[1] -= at(entry.cell.y);
    X.t[2] -= at(entry.cell.z);
    const V g = hn::Set(d, grown(half, frame_.pad));
    uint32_t near = 0;
    alignas(32) float from_middle[kLanes];
    for (size_t l = 0; l < kLanes; l += step()) {
      const auto beyond = [&](V p) { return hn::Max(hn::Sub(hn::Abs(p), g), hn::Zero(d)); };
      const auto apart = [&](const V3& p, V r) {
        return hn::Gt(square(beyond(p.x), beyond(p.y), beyond(p.z)), hn::Mul(r, r));
      };
      const Spheres s0 = spheresAt(block, kCentral, l);
      const V3 p = moved(X, s0.center);
      hn::Store(square(p.x, p.y, p.z), d, from_middle + l);
      auto away = apart(p, s0.r);
      if (!hn::AllTrue(d, away)) {
        const V3 w = {hn::CopySign(beyond(p.x), p.x), hn::CopySign(beyond(p.y), p.y),
                      hn::CopySign(beyond(p.z), p.z)};
        for (const int middle : {int{kMiddle2}, int{kMiddle1}}) {
          const Spheres m = spheresAt(block, middle, l), h = spheresAt(block, middle + 1, l);
          const V3 by = rotated(X, h.center);
          const Spheres cap = capOf({moved(X, m.center), m.r}, {by, h.r}, dot(by, w));
          away = hn::Or(away, apart(cap.center, cap.r));
        }
      }
      near |= (~bitsOf(away) & ((1U << step()) - 1)) << l;
    }
    near &= children.all();
    if ((near & children.flat) != 0) {
      const BoxBlock& boxes = tree_.box_blocks[block_at];
      const V box_g = hn::Set(d, grown(half, frame_.box_pad));
      uint32_t apart = 0;
      for (size_t l = 0; l < kLanes; l += step()) {
        V3 e[3];
        for (int j = 0; j < 3; ++j) e[j] = rotated(X, BoxLanes::column(boxes, j, l));
        const V3 halves = {load(boxes.half[0], l), load(boxes.half[1], l), load(boxes.half[2], l)};
        const V3 c = moved(X, BoxLanes::column(boxes, kCenter, l));
        apart |= apartBits(widestGap(e, halves, c, box_g)) << l;
      }
      near &= ~apart;
    }
    if (near == 0) return;
    size_t nearest = size_;
    float least = kInfinityFloat;
    for (; near != 0; near &= near - 1) {
      const uint32_t lane = firstOf(near);
      if (from_middle[lane] < least) {
        least = from_middle[lane];
        nearest = size_;
      }
      hwy::Prefetch(&tree_.nodes[node.first_child + lane]);
      waiting_[size_++] = {entry.cell, node.first_child + lane};
    }
    std::swap(waiting_[nearest], waiting_[size_ - 1]);
  }

  /// True to end the search.
  bool leafPair(const Entry& entry, const Node& node, float half) {
    ++search_.counts.leaf_pairs;
    const auto index = static_cast<uint32_t>(node.leaf());
    const LeafView view(tree_, tree_.leaves[index]);
    MovedTriangles& placed = placed_[index % kPlaced];
    if (placed.leaf != index) {
      placed.leaf = index;
      placed.place(view, X_);
    }
    const float c[3] = {at(entry.cell.x), at(entry.cell.y), at(entry.cell.z)};
    const V g = hn::Set(d, grown(half, frame_.pad));
    const V inner = hn::Set(d, half * (1 - 0x1p-20F) - frame_.pad);
    uint32_t apart = 0, sure = 0;
    for (size_t l = 0; l < kLanes; l += step()) {
      V depth = hn::Set(d, kInfinityFloat);
      apart |= apartBits(widestGap(placed, l, c, g, depth)) << l;
      sure |= bitsOf(hn::Lt(depth, inner)) << l;
    }
    const auto evaluate = [&](uint32_t lanes, bool are_sure) {
      for (; lanes != 0; lanes &= lanes - 1) {
        ++search_.counts.exact;
        const uint32_t triangle = view.face(firstOf(lanes)).triangle();
        if (search_.cells.evaluate(entry.cell, triangle, are_sure)) return true;
      }
      return false;
    };
    if (evaluate(placed.used & sure, true)) return true;
    if (evaluate(placed.used & ~sure & ~apart, false)) return true;
    return false;
  }

  const CellSearch& search_;
  const Tree& tree_;
  const CellFrame& frame_;
  const FloatPose& X_;
  Entry* waiting_ = nullptr;
  size_t size_ = 0;
  MovedTriangles placed_[kPlaced];
};

void cells(const CellSearch& search) { CellTraversal(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
