// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/prepare.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/leaf_layout.h"
#include "engine/node_layout.h"
#include "engine/ownership.h"
#include "engine/partition.h"
#include "engine/weld.h"
#include "engine/wide_tree.h"
#include "volume/fit/sphere_fitter.h"

namespace kios::engine {
namespace {

template <typename S>
class Preparation {
 public:
  explicit Preparation(const MeshView<S>& mesh)
      : mesh_(mesh),
        tree_(std::make_unique<Tree>()),
        corners_(tree_->corners),
        order_(mesh.num_triangles) {
    std::iota(order_.begin(), order_.end(), 0U);
    const std::vector<std::uint32_t> first = weld(mesh);
    corners_.resize(mesh.num_triangles);
    fcl::Vector3<S> low = mesh.corner(0, 0), high = low;
    for (std::size_t t = 0; t < mesh.num_triangles; ++t) {
      for (int k = 0; k < 3; ++k) {
        corners_[t][k] = first[mesh.triangles[t][k]];
        low = low.cwiseMin(mesh.corner(t, k));
        high = high.cwiseMax(mesh.corner(t, k));
      }
    }
    origin_ = 0.5 * (low.template cast<double>() + high.template cast<double>());
    points_.resize(mesh.num_vertices);
    for (std::size_t v = 0; v < mesh.num_vertices; ++v) {
      if (first[v] == v) points_[v] = relative(mesh.vertices[v]).template cast<float>();
    }
    stamps_.assign(mesh.num_vertices, 0);
    place_.resize(mesh.num_vertices);
  }

  std::unique_ptr<Tree> run() {
    std::copy_n(origin_.data(), 3, tree_->origin);
    binary_ = partitioned();
    layOut();
    fillLeaves();
    tree_->cost = searchCost(*tree_);
    return std::move(tree_);
  }

 private:
  Eigen::Vector3d relative(const fcl::Vector3<S>& v) const {
    return v.template cast<double>() - origin_;
  }

  std::vector<BinaryNode> partitioned() {
    std::vector<Corners> triangles(mesh_.num_triangles);
    for (std::size_t t = 0; t < mesh_.num_triangles; ++t) {
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3f& p = points_[corners_[t][k]];
        triangles[t].v[k] = lanes::Float4{p[0], p[1], p[2], 0};
      }
    }
    return partition(triangles, order_);
  }

  /// Nodes and blocks, depth first, children of a block in a row.
  void layOut() {
    const Collapse collapse(binary_);
    struct Pending {
      std::uint32_t node;
      int binary, depth;
    };
    std::vector<Pending> stack = {{0, 0, 0}};
    std::vector<int> children;
    tree_->nodes.reserve(binary_.size());
    tree_->nodes.push_back(fitted(0));
    while (!stack.empty()) {
      const Pending at = stack.back();
      stack.pop_back();
      if (binary_[at.binary].isLeaf()) {
        tree_->nodes[at.node].child = ~static_cast<std::int32_t>(leaves_.size());
        leaves_.push_back(at.binary);
        continue;
      }
      tree_->depth = std::max(tree_->depth, at.depth + 1);
      collapse.children(at.binary, children);
      tree_->nodes[at.node].child = static_cast<std::int32_t>(tree_->blocks.size());
      tree_->nodes[at.node].first_child = static_cast<std::uint32_t>(tree_->nodes.size());
      Children& of_block = tree_->children.emplace_back();
      of_block.count = static_cast<std::uint8_t>(children.size());
      Block& block = tree_->blocks.emplace_back();
      for (int lane = 0; lane < kLanes; ++lane) {
        if (lane < static_cast<int>(children.size())) {
          stack.push_back(
              {static_cast<std::uint32_t>(tree_->nodes.size()), children[lane], at.depth + 1});
          tree_->nodes.push_back(fitted(children[lane]));
          of_block.flat |= static_cast<std::uint8_t>(tree_->nodes.back().flat << lane);
          of_block.leaves |= static_cast<std::uint8_t>(binary_[children[lane]].isLeaf() << lane);
        }
        const bool used = lane < static_cast<int>(children.size());
        writeLane(tree_->nodes[tree_->nodes[at.node].first_child + (used ? lane : 0)], lane, block);
      }
    }
    const auto flat = [](const Node& node) { return node.flat != 0; };
    if (std::none_of(tree_->nodes.begin(), tree_->nodes.end(), flat)) tree_->boxes.clear();
    tree_->boxes.shrink_to_fit();
    tree_->children.shrink_to_fit();
    tree_->nodes.shrink_to_fit();
    tree_->blocks.shrink_to_fit();
  }

  Node fitted(int binary) {
    const BinaryNode& range = binary_[binary];
    gathered_.clear();
    ++stamp_;
    for (int i = range.first; i < range.first + range.count; ++i) {
      for (const std::uint32_t v : corners_[order_[i]]) {
        if (std::exchange(stamps_[v], stamp_) != stamp_) gathered_.push_back(points_[v]);
      }
    }
    Node node;
    SphereFitter<float>::Split frame;
    writeSpheres(fitter_.fit(gathered_.data(), static_cast<int>(gathered_.size()),
                             FitMethod::kTuned, &frame),
                 node);
    tree_->boxes.push_back(boxAround(gathered_, frame.axes));
    node.flat = isFlat(tree_->boxes.back());
    tree_->reach = std::max(tree_->reach, reachOf(node));
    return node;
  }

  void fillLeaves() {
    // Leaves as the nodes number them; triangles in that order.
    std::vector<std::uint32_t> order, begin = {0};
    order.reserve(order_.size());
    for (const int leaf : leaves_) {
      const auto first = order_.begin() + binary_[leaf].first;
      std::copy(first, first + binary_[leaf].count, std::back_inserter(order));
      std::sort(order.begin() + begin.back(), order.end());
      begin.push_back(static_cast<std::uint32_t>(order.size()));
    }
    const Ownership owned = assignFeatures(corners_, order, begin, mesh_.num_vertices);
    tree_->leaves.reserve(leaves_.size());
    tree_->lanes.reserve(leaves_.size() * 22);
    tree_->features.reserve(order.size() + owned.edges.size() + owned.vertices.size());
    LeafContent content;
    for (std::size_t l = 0; l < leaves_.size(); ++l) {
      gather(order.data() + begin[l], begin[l + 1] - begin[l], owned, l, content);
      appendLeaf(content, *tree_);
    }
    tree_->lanes.shrink_to_fit();
  }

  Eigen::Vector3d cornerOf(FeatureId id, std::uint32_t step) const {
    return relative(mesh_.corner(id.triangle(), (id.corner() + step) % 3));
  }

  void gather(const std::uint32_t* triangles, std::size_t n, const Ownership& owned, std::size_t l,
              LeafContent& content) {
    content.triangles.clear();
    content.faces.clear();
    content.edges.clear();
    content.owned.clear();
    content.vertices.clear();
    ++stamp_;
    const auto addVertex = [&](std::uint32_t v) {
      if (std::exchange(stamps_[v], stamp_) != stamp_) {
        place_[v] = static_cast<std::uint8_t>(content.vertices.size());
        content.vertices.push_back(points_[v]);
      }
      return place_[v];
    };
    for (std::uint32_t i = owned.vertex_begin[l]; i < owned.vertex_begin[l + 1]; ++i) {
      const FeatureId id = owned.vertices[i];
      addVertex(corners_[id.triangle()][id.corner()]);
      content.owned.push_back(id);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Corners3& v = corners_[triangles[i]];
      const FeatureId id = {triangles[i] << 2};
      content.triangles.push_back(
          {triangles[i], {addVertex(v[0]), addVertex(v[1]), addVertex(v[2])}});
      content.faces.push_back({cornerOf(id, 0), cornerOf(id, 1), cornerOf(id, 2)});
    }
    for (std::uint32_t i = owned.edge_begin[l]; i < owned.edge_begin[l + 1]; ++i) {
      const FeatureId id = owned.edges[i];
      const Corners3& v = corners_[id.triangle()];
      content.edges.push_back({id, place_[v[id.corner()]], place_[v[(id.corner() + 1) % 3]]});
    }
  }

  const MeshView<S> mesh_;
  std::unique_ptr<Tree> tree_;
  std::vector<Corners3>& corners_;  ///< of the tree
  Eigen::Vector3d origin_;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3f> points_;  ///< relative to the origin, by welded vertex
  std::vector<std::uint32_t> stamps_;    ///< by welded vertex
  std::vector<std::uint8_t> place_;      ///< in the leaf at hand, by welded vertex
  std::uint32_t stamp_ = 0;
  std::vector<BinaryNode> binary_;
  std::vector<int> leaves_;  ///< binary nodes
  std::vector<Eigen::Vector3f> gathered_;
  SphereFitter<float> fitter_;
};

}  // namespace

template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh) {
  return Preparation<S>(mesh).run();
}

template std::unique_ptr<Tree> prepare(const MeshView<double>&);
template std::unique_ptr<Tree> prepare(const MeshView<float>&);

}  // namespace kios::engine
