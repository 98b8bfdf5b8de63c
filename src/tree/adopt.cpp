// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/adopt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "build/mesh_tree.h"
#include "tree/node_layout.h"

namespace kios::engine {
namespace {

/// Whether all of `n` floats from some address are finite. In integers, as floats would raise
/// exceptions: what is not finite has all bits of the exponent set, to which 1 carries beyond them.
bool areFinite(const void* floats, std::size_t n) {
  constexpr std::uint32_t kExponent = 0x7F800000, kOne = 0x00800000, kCarry = 0x80000000;
  std::uint32_t carries = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t bits;
    std::memcpy(&bits, static_cast<const unsigned char*>(floats) + 4 * i, sizeof(bits));
    carries |= (bits & kExponent) + kOne;
  }
  return (carries & kCarry) == 0;
}

bool isFinite(double x) {
  constexpr std::uint64_t kExponent = 0x7FF0000000000000;
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return (bits & kExponent) != kExponent;
}

/// A search ends whatever the floats are, as it goes down a tree that has an end, each pair of
/// nodes once; comparisons with NaN, which large floats may come to, only leave pairs out. The one
/// float that leads a search is the size of a node: sizes are compared as integers, so that a leaf
/// comes below all that aren't negative (Expander in search/simd/traverse-inl.h).
template <typename S>
class Adoption {
 public:
  Adoption(const MeshView<S>& mesh, Tree& tree) : mesh_(mesh), tree_(tree) {}

  bool run() {
    if (!floatsAreSound() || !isOneTree() || !leavesFit() || !featuresFit() || !cornersFit()) {
      return false;
    }
    tree_.indices = indexHash(mesh_);
    tree_.blocks.resize(tree_.children.size());
    for (const Node& node : tree_.nodes) {
      if (!node.isLeaf()) fillBlock(node, tree_);
    }
    if (!tree_.boxes.empty()) writeBoxBlocks(tree_);
    return true;
  }

 private:
  bool floatsAreSound() const {
    constexpr std::size_t kSpheres = 4 * kSphereRows + 1, kLeafFloats = 8;
    static_assert(offsetof(Node, size) == 4 * (kSpheres - 1) &&
                  offsetof(Leaf, corners) == offsetof(Leaf, centroid) + 4 * kLeafFloats);
    bool sound = isFinite(tree_.cost) && areFinite(&tree_.reach, 1) &&
                 areFinite(&tree_.mean_leaf, 1) && areFinite(&tree_.widest_leaf, 1) &&
                 areFinite(&tree_.root_box, sizeof(Box) / 4) &&
                 areFinite(tree_.boxes.data(), tree_.boxes.size() * sizeof(Box) / 4) &&
                 areFinite(tree_.lanes.data(), tree_.lanes.size() * kLanes);
    for (const double x : tree_.origin) sound &= isFinite(x);
    for (const Node& node : tree_.nodes) {
      sound &= areFinite(node.x, kSpheres);
      sound &= areFinite(&node.width, 1);
      sound &= !std::signbit(node.size);
    }
    for (const Leaf& leaf : tree_.leaves) sound &= areFinite(leaf.centroid, kLeafFloats);
    return sound;
  }

  /// Goes the way of prepare(), which numbers nodes, blocks and leaves as it meets them, and finds
  /// the depth.
  bool isOneTree() {
    struct Pending {
      std::uint32_t node;
      int depth;
    };
    const bool has_boxes = !tree_.boxes.empty();
    if (has_boxes && tree_.boxes.size() != tree_.nodes.size()) return false;
    std::vector<Pending> stack = {{0, 0}};
    std::size_t num_nodes = 1, num_blocks = 0, num_leaves = 0;
    tree_.depth = 0;
    while (!stack.empty()) {
      const Pending at = stack.back();
      stack.pop_back();
      const Node& node = tree_.nodes[at.node];
      if (node.isLeaf()) {
        if (node.leaf() != num_leaves++) return false;
        continue;
      }
      if (static_cast<std::size_t>(node.child) != num_blocks ||
          num_blocks == tree_.children.size() || node.first_child != num_nodes ||
          at.depth == kMaxDepth) {
        return false;
      }
      const Children& children = tree_.children[num_blocks++];
      if (children.count < 2 || children.count > kLanes ||
          children.count > tree_.nodes.size() - num_nodes) {
        return false;
      }
      std::uint32_t flat = 0, leaves = 0;
      for (std::uint32_t lane = 0; lane < children.count; ++lane) {
        const Node& child = tree_.nodes[num_nodes];
        flat |= child.flat << lane;
        leaves |= std::uint32_t{child.isLeaf()} << lane;
        stack.push_back({static_cast<std::uint32_t>(num_nodes++), at.depth + 1});
      }
      if (children.flat != flat || children.leaves != leaves || (flat != 0 && !has_boxes)) {
        return false;
      }
      tree_.depth = std::max(tree_.depth, at.depth + 1);
    }
    return num_nodes == tree_.nodes.size() && num_blocks == tree_.children.size() &&
           num_leaves == tree_.leaves.size() && (tree_.nodes[0].flat == 0 || has_boxes);
  }

  /// Kernels load whole vectors of corners and ends: those beyond the last are checked too.
  bool leavesFit() const {
    constexpr std::size_t kVertices = sizeof(Leaf::corners) + sizeof(Leaf::ends);
    static_assert(offsetof(Leaf, ends) == offsetof(Leaf, corners) + sizeof(Leaf::corners));
    std::size_t lanes = 0, features = 0;
    for (const Leaf& leaf : tree_.leaves) {
      if (leaf.offset != lanes || leaf.feature_offset != features || leaf.num_faces < 1 ||
          leaf.num_faces > kLeafTriangles || leaf.num_edges > kMaxLeafFeatures ||
          leaf.num_vertices < 1 || leaf.num_vertices > kMaxLeafFeatures ||
          leaf.num_owned > leaf.num_vertices) {
        return false;
      }
      std::uint8_t vertices[kVertices], largest = 0;  // of corners and ends, a byte each
      std::memcpy(vertices, leaf.corners, kVertices);
      for (const std::uint8_t vertex : vertices) largest = std::max(largest, vertex);
      if (largest >= leaf.num_vertices) return false;
      lanes += static_cast<std::size_t>(leafRows(leaf.num_vertices));
      features += static_cast<std::size_t>(leaf.num_faces) + leaf.num_edges + leaf.num_owned;
    }
    // A triangle of a leaf is named by the leaf's index << 3: see search/search.h.
    constexpr std::size_t kMostLeaves = std::size_t{1} << 28;
    return lanes == tree_.lanes.size() && features == tree_.features.size() &&
           tree_.leaves.size() <= kMostLeaves;
  }

  /// Features name corners of the mesh, and each triangle is a face of one leaf.
  bool featuresFit() const {
    std::uint32_t largest = 0;
    bool corners = true;
    for (const FeatureId id : tree_.features) {
      largest = std::max(largest, id.triangle());
      corners &= id.corner() < 3;
    }
    const std::size_t n = mesh_.num_triangles;
    if (largest >= n || !corners) return false;
    std::vector<std::uint64_t> met((n + 63) / 64, 0);
    std::size_t num_faces = 0, num_met = 0;
    for (const Leaf& leaf : tree_.leaves) {
      for (std::uint32_t i = 0; i < leaf.num_faces; ++i) {
        const FeatureId face = tree_.features[leaf.feature_offset + i];
        if (face.corner() != 0) return false;
        std::uint64_t& word = met[face.triangle() / 64];
        const std::uint64_t bit = std::uint64_t{1} << face.triangle() % 64;
        num_met += (word & bit) == 0 ? 1 : 0;
        word |= bit;
      }
      num_faces += leaf.num_faces;
    }
    return num_faces == n && num_met == n;
  }

  bool cornersFit() const {
    if (tree_.corners.empty()) return true;
    std::uint32_t largest = 0;
    for (const Corners3& corners : tree_.corners) {
      largest = std::max({largest, corners[0], corners[1], corners[2]});
    }
    return tree_.corners.size() == mesh_.num_triangles && largest < mesh_.num_vertices;
  }

  const MeshView<S> mesh_;
  Tree& tree_;
};

}  // namespace

template <typename S>
bool adopt(const MeshView<S>& mesh, Tree& tree) {
  return Adoption<S>(mesh, tree).run();
}

template bool adopt(const MeshView<double>&, Tree&);
template bool adopt(const MeshView<float>&, Tree&);

}  // namespace kios::engine
