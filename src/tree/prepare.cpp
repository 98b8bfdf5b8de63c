// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/prepare.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tree/box_fit.h"
#include "tree/leaf_layout.h"
#include "tree/moment_fit.h"
#include "tree/node_layout.h"
#include "tree/ownership.h"
#include "tree/weld.h"
#include "tree/wide_tree.h"
#include "volume/balls.h"
#include "volume/large_arrays.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

template <typename S>
class Preparation {
 public:
  /// Its own origin is in the middle of the mesh, if that is `placed`, or the mesh's.
  Preparation(const MeshView<S>& mesh, const VolumeNode<S>* volumes, bool placed = true)
      : mesh_(mesh),
        volumes_(volumes),
        tree_(std::make_unique<Tree>()),
        corners_(mesh.num_triangles),
        order_(mesh.num_triangles) {
    const std::vector<std::uint32_t> first = weld(mesh);
    for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = mesh.index(t, k);
        corners_[t][k] = first[v];
        welds_ |= first[v] != v;
      }
    }
    if (placed) placeOrigin(mesh, *tree_);
    stamps_.assign(mesh.num_vertices, 0);
    place_.resize(mesh.num_vertices);
  }

  std::unique_ptr<Tree> run() {
    readBinary();
    layOut();
    fillLeaves();
    placeVolumes();
    tree_->cost = searchCost(*tree_);
    measureLeaves(*tree_);
    tree_->indices = indexHash(mesh_);
    if (welds_) tree_->corners = std::move(corners_);
    return std::move(tree_);
  }

 private:
  /// The binary tree down to the leaves of the wide one, and the order of the triangles.
  void readBinary() {
    const int n = static_cast<int>(mesh_.num_triangles);
    reserveLarge(binary_, n / 2 + 4);
    binary_.push_back({0, n});
    std::vector<int> stack = {0};
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      const VolumeNode<S>& volume = volumes_[binary_[at].volume];
      if (volume.num_primitives <= kLeafTriangles) {
        readTriangles(volume);
        continue;
      }
      binary_[at].size = roundedTo<float>(2 * volume.bv.radius0);
      const int left = static_cast<int>(binary_.size());
      binary_[at].left = left;
      for (const int child : {volume.first_child, volume.first_child + 1}) {
        const VolumeNode<S>& of_child = volumes_[child];
        __builtin_prefetch(&volumes_[std::max(0, of_child.first_child)]);
        binary_.push_back({of_child.first_primitive, of_child.num_primitives, -1, 0, child});
      }
      stack.push_back(left + 1);
      stack.push_back(left);
    }
  }

  /// Reads the triangles of a part. Its nodes follow each other, but for the root.
  void readTriangles(const VolumeNode<S>& root) {
    const auto read = [&](const VolumeNode<S>& node) {
      if (node.first_child >= 0) return;
      order_[node.first_primitive] = static_cast<std::uint32_t>(-node.first_child - 1);
    };
    read(root);
    for (int i = 0; i < 2 * root.num_primitives - 2; ++i) read(volumes_[root.first_child + i]);
  }

  /// Nodes and blocks, depth first, children of a block in a row.
  void layOut() {
    const Collapse collapse(binary_);
    struct Pending {
      std::size_t node;
      int binary, depth;
    };
    struct Links {
      std::int32_t child;
      std::uint32_t first_child;
    };
    std::vector<Pending> stack = {{0, 0, 0}};
    std::vector<int> children;
    std::vector<Links> links(1);  // of nodes: their number isn't known before
    links.reserve(binary_.size());
    of_node_.reserve(binary_.size());
    of_node_.push_back(0);
    while (!stack.empty()) {
      const Pending at = stack.back();
      stack.pop_back();
      if (binary_[at.binary].isLeaf()) {
        links[at.node] = {~static_cast<std::int32_t>(leaves_.size()), 0};
        leaves_.push_back(at.binary);
        continue;
      }
      tree_->depth = std::max(tree_->depth, at.depth + 1);
      collapse.children(at.binary, children);
      links[at.node] = {static_cast<std::int32_t>(tree_->children.size()),
                        static_cast<std::uint32_t>(links.size())};
      Children& of_block = tree_->children.emplace_back();
      of_block.count = static_cast<std::uint8_t>(children.size());
      for (std::size_t lane = 0; lane < children.size(); ++lane) {
        const BinaryNode& child = binary_[children[lane]];
        stack.push_back({links.size(), children[lane], at.depth + 1});
        links.emplace_back();
        of_node_.push_back(child.volume);
        of_block.leaves |= static_cast<std::uint8_t>(child.isLeaf() << lane);
      }
    }
    tree_->children.shrink_to_fit();
    reserveLarge(tree_->blocks, tree_->children.size());
    reserveLarge(tree_->nodes, links.size());
    tree_->blocks.resize(tree_->children.size());
    tree_->nodes.resize(links.size());
    for (std::size_t n = 0; n < links.size(); ++n) {
      tree_->nodes[n].child = links[n].child;
      tree_->nodes[n].first_child = links[n].first_child;
    }
  }

  /// All volumes, bottom-up: nodes lie before their children.
  void placeVolumes() {
    const TreePoints points(*tree_);
    reserveLarge(tree_->boxes, tree_->nodes.size());
    tree_->boxes.resize(tree_->nodes.size());
    bool any_flat = false;
    for (std::size_t n = tree_->nodes.size(); n-- > 0;) {
      constexpr std::size_t kAhead = 4;
      if (n >= kAhead) __builtin_prefetch(&volumes_[of_node_[n - kAhead]].bv.cap_x);
      Node& node = tree_->nodes[n];
      if (!node.isLeaf()) fillBlock(node, *tree_);
      place(volumes_[of_node_[n]].bv, points.chunksOf(n), points.numChunks(n), node,
            tree_->boxes[n]);
      any_flat |= node.flat != 0;
      tree_->reach = std::max(tree_->reach, reachOf(node));
    }
    if (!any_flat || !fitBoxes(points, *tree_)) {
      tree_->root_box = tree_->boxes[0];
      tree_->boxes = {};
      tree_->box_blocks = {};
    }
    fitRootBox(points, *tree_);
  }

  /// The spheres of `bv`, moved to the tree's origin and measured. Caps that it lacks are S0.
  void place(const kIOS<S>& bv, const PointChunk* chunks, std::size_t n, Node& node, Box& box) {
    Eigen::Vector3f centers[kSphereRows];
    for (int c = 0; c < 3; ++c) {
      centers[0][c] = roundedTo<float>(double{bv.center0[c]} - tree_->origin[c]);
    }
    const auto unit = roundedTo<float>(scaled(1.0, bv.exponent));
    for (int i = 1; i < kSphereRows; ++i) {
      centers[i] = centers[0];
      if (i >= bv.k()) continue;
      centers[i] += unit * Eigen::Vector3f(bv.cap_x[i - 1], bv.cap_y[i - 1], bv.cap_z[i - 1]);
    }
    encloseAll(chunks, n, centers, node);
    box = boxAround(axesOf(centers, chunks, n), chunks, n);
    node.flat = isFlat(box);
  }

  void fillLeaves() {
    // Leaves as the nodes number them; triangles in that order.
    std::vector<std::uint32_t> order, begin = {0};
    reserveLarge(order, order_.size());
    for (const int leaf : leaves_) {
      const auto first = order_.begin() + binary_[leaf].first;
      std::copy(first, first + binary_[leaf].count, std::back_inserter(order));
      std::sort(order.begin() + begin.back(), order.end());
      begin.push_back(static_cast<std::uint32_t>(order.size()));
    }
    const Ownership owned = assignFeatures(corners_, order, begin, mesh_.num_vertices);
    reserveLarge(tree_->leaves, leaves_.size());
    reserveLarge(tree_->features, order.size() + owned.edges.size() + owned.vertices.size());
    std::size_t num_rows = 0;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      Leaf& leaf = tree_->leaves.emplace_back();
      leaf.offset = static_cast<std::uint32_t>(num_rows);
      gather(order.data() + begin[l], order.data() + begin[l + 1], owned, l, leaf);
      num_rows += static_cast<std::size_t>(leafRows(leaf.num_vertices));
    }
    reserveLarge(tree_->lanes, num_rows);
    for (Leaf& leaf : tree_->leaves) {
      tree_->lanes.resize(leaf.offset + leafRows(leaf.num_vertices));
      Eigen::Vector3f vertices[kMaxLeafFeatures];
      placeLeaf(mesh_, leaf, *tree_, vertices);
    }
  }

  /// Gathers the features of leaf l, of these triangles: owned vertices come before the others.
  void gather(const std::uint32_t* begin, const std::uint32_t* end, const Ownership& owned,
              std::size_t l, Leaf& leaf) {
    std::vector<FeatureId>& features = tree_->features;
    leaf.feature_offset = static_cast<std::uint32_t>(features.size());
    ++stamp_;
    const auto number = [&](std::uint32_t v) {
      if (std::exchange(stamps_[v], stamp_) != stamp_) place_[v] = leaf.num_vertices++;
      return place_[v];
    };
    const auto first_owned = owned.vertices.begin() + owned.vertex_begin[l];
    const auto last_owned = owned.vertices.begin() + owned.vertex_begin[l + 1];
    for (auto id = first_owned; id != last_owned; ++id) {
      number(corners_[id->triangle()][id->corner()]);
    }
    leaf.num_owned = leaf.num_vertices;
    for (; begin != end; ++begin) {
      for (int k = 0; k < 3; ++k) {
        leaf.corners[3 * leaf.num_faces + k] = number(corners_[*begin][k]);
      }
      ++leaf.num_faces;
      features.push_back({*begin << 2});
    }
    for (std::uint32_t i = owned.edge_begin[l]; i < owned.edge_begin[l + 1]; ++i) {
      const FeatureId id = owned.edges[i];
      const Corners3& v = corners_[id.triangle()];
      const int start = place_[v[id.corner()]], stop = place_[v[(id.corner() + 1) % 3]];
      leaf.ends[leaf.num_edges++] = static_cast<std::uint16_t>(start | stop << 8);
      features.push_back(id);
    }
    features.insert(features.end(), first_owned, last_owned);
  }

  const MeshView<S> mesh_;
  const VolumeNode<S>* const volumes_;
  std::unique_ptr<Tree> tree_;
  std::vector<Corners3> corners_;  ///< by triangle, welded
  bool welds_ = false;             ///< they aren't the mesh's own
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> stamps_;  ///< by welded vertex
  std::vector<std::uint8_t> place_;    ///< in the leaf at hand, by welded vertex
  std::uint32_t stamp_ = 0;
  std::vector<BinaryNode> binary_;
  std::vector<int> leaves_;   ///< binary nodes
  std::vector<int> of_node_;  ///< the model's node of each node
};

}  // namespace

template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh, const VolumeNode<S>* volumes) {
  return Preparation<S>(mesh, volumes).run();
}

// A mesh of no ordinary size or place is prepared as a copy, about its middle and 1 to 2 units
// large. Differences are exact, or off by 2^-53 of the mesh, and its scaling is exact.
template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh) {
  const auto [low, high] = mesh.box();
  const fcl::Vector3d middle = 0.5 * low + 0.5 * high;
  const double half = (high - middle).maxCoeff();
  std::vector<unsigned int> primitives(mesh.num_triangles);
  if (half >= kLeastReach && half <= kLargestReach) {
    std::vector<VolumeNode<S>> volumes(2 * mesh.num_triangles - 1);
    if (buildVolumes(mesh, volumes.data(), primitives.data())) return prepare(mesh, volumes.data());
  }
  const int exponent = half > 0 ? exponentOf(half) : 0;
  std::vector<fcl::Vector3d> vertices(mesh.num_vertices, fcl::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
    for (int k = 0; k < 3; ++k) {
      fcl::Vector3d& v = vertices[mesh.index(t, k)];
      v = mesh.corner(t, k).template cast<double>() - middle;
      for (int c = 0; c < 3; ++c) v[c] = std::ldexp(v[c], -exponent);
    }
  }
  const MeshView<double> copy = {vertices.data(), vertices.size(), mesh.triangles,
                                 mesh.num_triangles};
  std::vector<VolumeNode<double>> volumes(2 * mesh.num_triangles - 1);
  if (!buildVolumes(copy, volumes.data(), primitives.data())) return nullptr;  // not finite
  std::unique_ptr<Tree> tree = Preparation<double>(copy, volumes.data(), false).run();
  Eigen::Map<Eigen::Vector3d>(tree->origin) = middle;
  tree->exponent = exponent;
  tree->reach = std::max(tree->reach, roundedTo<float>(kLeastReach));
  return tree;
}

template std::unique_ptr<Tree> prepare(const MeshView<double>&);
template std::unique_ptr<Tree> prepare(const MeshView<float>&);
template std::unique_ptr<Tree> prepare(const MeshView<double>&, const VolumeNode<double>*);
template std::unique_ptr<Tree> prepare(const MeshView<float>&, const VolumeNode<float>*);

}  // namespace kios::engine
