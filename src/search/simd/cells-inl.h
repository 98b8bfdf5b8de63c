// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels. search/cell_search.h derives the pads.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

constexpr float kLeastGap = 0x1p-96F;

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
        storeAt(moved(X, corners.pointOf(view.vertices, k, l)), l, p[k][0], p[k][1], p[k][2]);
      }
    }
  }
};

/// Whether the widest gap counts.
HWY_INLINE hn::Mask<D> areApart(V widest) { return hn::Gt(widest, set(kLeastGap)); }

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
  V widest = set(-kInfinityFloat);
  const auto note = [&](V middle, V own, V reach) {
    widest = hn::Max(widest, hn::Sub(hn::Abs(middle), hn::Add(own, reach)));
  };
  for (int i = 0; i < 3; ++i) {
    note(at[i], dot(size[0][i], size[1][i], size[2][i], half.x, half.y, half.z), g);
    note(dot(e[i], c), halves[i], hn::Mul(g, hn::Add(hn::Add(size[i][0], size[i][1]), size[i][2])));
  }
  if (hn::AllTrue(d, areApart(widest))) return widest;
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
  V widest = set(-kInfinityFloat);
  const auto note = [&](V low, V high, V reach) {
    widest = hn::Max(widest, hn::Sub(hn::Max(low, hn::Neg(high)), reach));
  };
  for (int i = 0; i < 3; ++i) {
    const V center = set(c[i]);
    for (int k = 0; k < 3; ++k) v[k][i] = hn::Sub(load(t.p[k][i], l), center);
    note(hn::Min(hn::Min(v[0][i], v[1][i]), v[2][i]), hn::Max(hn::Max(v[0][i], v[1][i]), v[2][i]),
         g);
  }
  if (hn::AllTrue(d, areApart(widest))) return widest;
  for (int k = 0; k < 3; ++k) {
    V middle[3];
    for (int i = 0; i < 3; ++i) {
      e[k][i] = hn::Sub(v[(k + 1) % 3][i], v[k][i]);
      middle[i] = hn::Mul(set(0.5F), hn::Add(v[(k + 1) % 3][i], v[k][i]));
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
    for (size_t i = search_.num_start; i-- > 0;) waiting_.push_back({search_.start[i], 0});
    while (!waiting_.empty()) {
      const Entry at = waiting_.back();
      waiting_.pop_back();
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
  static constexpr size_t kPlaced = 8;

  float grown(float half, float pad) const { return half * (1 + 0x1p-20F) + pad; }
  float at(int32_t units) const { return static_cast<float>(units) * frame_.unit; }
  /// The eight children, one a lane, against the node's spheres, and where that helps its box.
  void openCell(const Entry& entry, const Node& node, float half) {
    ++search_.counts.expansions;
    search_.counts.volume_tests += kLanes;
    const Cell& cell = entry.cell;
    const float h = 0.5F * half;
    const auto q = static_cast<int32_t>(cell.half / 2);
    const int32_t middle[3] = {cell.x, cell.y, cell.z};
    Lanes c[3];  // of the children
    for (uint32_t i = 0; i < kLanes; ++i) {
      for (uint32_t k = 0; k < 3; ++k) c[k].v[i] = at(middle[k] + ((i >> k & 1) != 0 ? q : -q));
    }
    const auto sphere = [&](int row, float sign) {
      const auto side = [&](const float* v) { return v[row] + sign * v[row + 1]; };
      return std::make_pair(moved(X_, Vec3{side(node.x), side(node.y), side(node.z)}),
                            side(node.r));
    };
    const Vec3 s0 = moved(X_, {node.x[kCentral], node.y[kCentral], node.z[kCentral]});
    const std::pair<Vec3, float> spheres[kSphereRows] = {{s0, node.r[kCentral]},
                                                         sphere(kMiddle2, 1),
                                                         sphere(kMiddle2, -1),
                                                         sphere(kMiddle1, 1),
                                                         sphere(kMiddle1, -1)};
    const V g = set(grown(h, frame_.pad));
    uint32_t near =
        0xFF & ~lanesWhere([&](size_t l) {
          const V3 child = rowsAt(c, l);
          auto away = hn::Gt(hn::Zero(d), hn::Zero(d));
          for (const auto& [center, r] : spheres) {
            const auto beyond = [&](V p, float of) {
              return positive(hn::Sub(hn::Abs(hn::Sub(set(of), p)), g));
            };
            away = hn::Or(away, hn::Gt(square(beyond(child.x, center.x), beyond(child.y, center.y),
                                              beyond(child.z, center.z)),
                                       set(r * r)));
          }
          return away;
        });
    if (near != 0 && node.flat != 0) near &= ~boxMissesChildren(tree_.boxes[entry.node], c, h);
    if (near == 0) return;
    const void* children[8];
    uint32_t leaves;
    near = search_.cells.open(cell.node, near, children, leaves);
    // The child on the node's side of the middle comes last, and so is taken first.
    const uint32_t side = uint32_t{s0.x > at(cell.x)} | uint32_t{s0.y > at(cell.y)} << 1 |
                          uint32_t{s0.z > at(cell.z)} << 2;
    for (const uint32_t flip : {7U, 6U, 5U, 3U, 4U, 2U, 1U, 0U}) {
      const uint32_t i = side ^ flip;
      if ((near >> i & 1) == 0) continue;
      waiting_.push_back({cell.child(i, children[i], (leaves >> i & 1) != 0), entry.node});
    }
  }

  /// The children, as bits, that the node's box misses.
  HWY_NOINLINE uint32_t boxMissesChildren(const Box& box, const Lanes (&c)[3], float h) const {
    V3 e[3];
    for (int j = 0; j < 3; ++j) e[j] = rotated(X_, BoxLanes::column(box, j));
    const V3 half = {set(box.half[0]), set(box.half[1]), set(box.half[2])};
    const V3 center = moved(X_, BoxLanes::column(box, kCenter));
    const V g = set(grown(h, frame_.box_pad));
    return lanesWhere(
        [&](size_t l) { return areApart(widestGap(e, half, center - rowsAt(c, l), g)); });
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
    const V g = set(grown(half, frame_.pad));
    alignas(32) float from_middle[kLanes];
    uint32_t near =
        children.all() & ~lanesWhere([&](size_t l) {
          const auto beyond = [&](V p) { return positive(hn::Sub(hn::Abs(p), g)); };
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
          return away;
        });
    if ((near & children.flat) != 0) {
      const BoxBlock& boxes = tree_.box_blocks[block_at];
      const V box_g = set(grown(half, frame_.box_pad));
      near &= ~lanesWhere([&](size_t l) {
        V3 e[3];
        for (int j = 0; j < 3; ++j) e[j] = rotated(X, BoxLanes::column(boxes, j, l));
        const V3 halves = {load(boxes.half[0], l), load(boxes.half[1], l), load(boxes.half[2], l)};
        const V3 c = moved(X, BoxLanes::column(boxes, kCenter, l));
        return areApart(widestGap(e, halves, c, box_g));
      });
    }
    if (near == 0) return;
    size_t nearest = waiting_.size();
    float least = kInfinityFloat;
    for (; near != 0; near &= near - 1) {
      const uint32_t lane = firstOf(near);
      if (from_middle[lane] < least) {
        least = from_middle[lane];
        nearest = waiting_.size();
      }
      hwy::Prefetch(&tree_.nodes[node.first_child + lane]);
      waiting_.push_back({entry.cell, node.first_child + lane});
    }
    std::swap(waiting_[nearest], waiting_[waiting_.size() - 1]);
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
    const V g = set(grown(half, frame_.pad));
    const V inner = set(half * (1 - 0x1p-20F) - frame_.pad);
    uint32_t sure = 0;
    const uint32_t apart = lanesWhere([&](size_t l) {
      V depth = set(kInfinityFloat);
      const V widest = widestGap(placed, l, c, g, depth);
      sure |= bitsOf(hn::Lt(depth, inner)) << l;
      return areApart(widest);
    });
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
  DepthFirst<Entry> waiting_;
  MovedTriangles placed_[kPlaced];
};

void cells(const CellSearch& search) { CellTraversal(search).run(); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
