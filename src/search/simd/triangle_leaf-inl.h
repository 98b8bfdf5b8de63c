// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// A triangle of a leaf as a leaf of its own, which all kernels of leaves serve. It has those edges
/// and vertices that the leaf owns and the triangle touches: an edge that two triangles of the leaf
/// share is looked at with each. So the features of all triangles of a leaf are the leaf's, and a
/// feature is left out only with triangles that contain it.
class TriangleLeaf {
 public:
  LeafView view() const { return {leaf_, lanes_, ids_}; }

  [[gnu::hot]] HWY_NOINLINE void make(const Tree& tree, uint32_t node) {
    if (node == node_) return;
    node_ = node;
    const LeafView from(tree, tree.leaves[leafOfTriangle(node)]);
    const uint32_t lane = laneOfTriangle(node);
    takeVertices(from.leaf, lane);
    takeFeatures(from, lane);
    copyVertices(from);
    copyFace(from, lane);
  }

 private:
  /// The corners, each once; owned vertices come first, as in every leaf.
  void takeVertices(const Leaf& from, uint32_t lane) {
    const uint8_t* const corners = from.corners + 3 * lane;
    known_ = 0;
    uint32_t count = 0;
    for (const bool owned : {true, false}) {
      for (int k = 0; k < 3; ++k) {
        const uint32_t v = corners[k];
        if ((v < from.num_owned) != owned || (known_ >> v & 1U) != 0) continue;
        known_ |= 1U << v;
        vertices_[count++] = v;
      }
      if (owned) leaf_.num_owned = static_cast<uint8_t>(count);
    }
    leaf_.num_vertices = static_cast<uint8_t>(count);
    for (int k = 0; k < 3; ++k) leaf_.corners[k] = static_cast<uint8_t>(placeOf(corners[k]));
  }

  uint32_t placeOf(uint32_t vertex) const {
    uint32_t place = 0;
    while (vertices_[place] != vertex) ++place;
    return place;
  }

  void takeFeatures(const LeafView& from, uint32_t lane) {
    FeatureId* id = ids_;
    leaf_.num_faces = 1;
    *id++ = from.face(lane);
    leaf_.num_edges = 0;
    for (uint32_t i = 0; i < from.leaf.num_edges; ++i) {
      const uint32_t start = from.leaf.ends[i] & 0xFFU, end = from.leaf.ends[i] >> 8U;
      if ((known_ >> start & known_ >> end & 1U) == 0) continue;
      leaf_.ends[leaf_.num_edges++] = static_cast<uint16_t>(placeOf(start) | placeOf(end) << 8U);
      *id++ = from.edge(i);
    }
    for (uint32_t i = 0; i < leaf_.num_owned; ++i) *id++ = from.vertex(vertices_[i]);
  }

  void copyVertices(const LeafView& from) {
    for (int i = 0; i < 2 * kLanes; ++i) {
      const uint32_t v =
          vertices_[std::min<uint32_t>(static_cast<uint32_t>(i), leaf_.num_vertices - 1U)];
      const Lanes* const rows = from.vertices.rows + 3 * (v / kLanes);
      Lanes* const to = lanes_ + 3 * (i / kLanes);
      for (int c = 0; c < 3; ++c) to[c].v[i % kLanes] = rows[c].v[v % kLanes];
    }
    for (int c = 0; c < 3; ++c) {
      const float* const p = lanes_[c].v;  // there are three at least, if not all distinct
      leaf_.centroid[c] =
          0.5F * (std::min(std::min(p[0], p[1]), p[2]) + std::max(std::max(p[0], p[1]), p[2]));
    }
  }

  void copyFace(const LeafView& from, uint32_t lane) {
    Lanes* const face = lanes_ + 6;
    for (int r = 0; r < kFaceRows; ++r) {
      const V row = set(from.faces[r].v[lane]);
      for (size_t l = 0; l < kLanes; l += step()) hn::Store(row, d, face[r].v + l);
    }
    Vec3 normal = {face[kFacePlane].v[0], face[kFacePlane + 1].v[0], face[kFacePlane + 2].v[0]};
    if (dot(normal, normal) < 0.5F) normal = {1, 0, 0};  // too thin for one
    leaf_.normal[0] = normal.x;
    leaf_.normal[1] = normal.y;
    leaf_.normal[2] = normal.z;
    const Points points = {lanes_, 2};
    const float h0 = dot(normal, points.at(0)), h1 = dot(normal, points.at(1)),
                h2 = dot(normal, points.at(2));
    leaf_.normal_bottom = std::min(std::min(h0, h1), h2);
    leaf_.normal_top = std::max(std::max(h0, h1), h2);
  }

  uint32_t node_ = 0;     ///< 0, which is no triangle, for none
  uint32_t known_ = 0;    ///< the leaf's vertices that are corners, as bits
  uint32_t vertices_[3];  ///< their indices in the leaf, in the order taken
  Leaf leaf_;
  Lanes lanes_[6 + kFaceRows];  ///< two chunks of vertices, and the face
  FeatureId ids_[1 + kMaxLeafFeatures + 3];
};

/// The leaves of one tree, by node, which may be a triangle of a leaf.
class Leaves {
 public:
  explicit Leaves(const Tree& tree) : tree_(tree) {}

  /// Valid until the next call.
  HWY_INLINE LeafView operator()(uint32_t node) {
    if (HWY_LIKELY(!isTriangle(node))) return {tree_, tree_.leaves[tree_.nodes[node].leaf()]};
    triangle_.make(tree_, node);
    return triangle_.view();
  }

 private:
  const Tree& tree_;
  TriangleLeaf triangle_;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
