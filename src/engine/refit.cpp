// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/refit.h"

#include <algorithm>
#include <vector>

#include "engine/leaf_layout.h"
#include "engine/node_layout.h"
#include "engine/quick_fit.h"

namespace kios::engine {
namespace {

/// A partition that makes a search so much dearer than when it was made is made anew.
constexpr double kPoor = 1.5;

template <typename S>
class Refit {
 public:
  Refit(const MeshView<S>& mesh, Tree& tree) : mesh_(mesh), tree_(tree) {}

  bool run() {
    if (!sameTopology()) return false;
    moveOrigin();
    content_.resize(tree_.nodes.size());
    chunks_.reserve(3 * tree_.leaves.size());
    placeLeaves();
    // Nodes lie before their children.
    tree_.reach = 0;
    for (std::size_t n = tree_.nodes.size(); n-- > 0;) fit(n);
    if (!tree_.boxes.empty()) writeBoxBlocks(tree_);
    return searchCost(tree_) <= kPoor * tree_.cost;
  }

 private:
  /// Chunks of points below a node, in the order of leaves.
  struct Content {
    std::size_t begin = 0, end = 0;
    Moments moments;
  };

  /// What holds of the topology holds of every mesh whose corners are where the tree's are.
  bool sameTopology() const {
    if (mesh_.num_triangles != tree_.corners.size()) return false;
    for (std::size_t t = 0; t < mesh_.num_triangles; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t stored = mesh_.index(t, k), welded = tree_.corners[t][k];
        if (stored == welded) continue;
        if (welded >= mesh_.num_vertices) return false;
        if (mesh_.vertices[stored] != mesh_.vertices[welded]) return false;
      }
    }
    return true;
  }

  void moveOrigin() {
    fcl::Vector3<S> low = mesh_.corner(0, 0), high = low;
    for (const Corners3& corners : tree_.corners) {
      for (const std::uint32_t v : corners) {
        low = low.cwiseMin(mesh_.vertices[v]);
        high = high.cwiseMax(mesh_.vertices[v]);
      }
    }
    origin_ = 0.5 * (low.template cast<double>() + high.template cast<double>());
    std::copy_n(origin_.data(), 3, tree_.origin);
  }

  void placeLeaves() {
    Eigen::Vector3f vertices[kMaxLeafFeatures];
    FaceCorners faces[kLeafTriangles];
    leaf_content_.resize(tree_.leaves.size());
    for (std::size_t l = 0; l < tree_.leaves.size(); ++l) {
      Leaf& leaf = tree_.leaves[l];
      for (int i = 0; i < leaf.num_faces; ++i) {
        const Corners3& corners = tree_.corners[tree_.features[leaf.feature_offset + i].triangle()];
        for (int k = 0; k < 3; ++k) {
          faces[i][k] = mesh_.vertices[corners[k]].template cast<double>() - origin_;
          vertices[leaf.corners[3 * i + k]] = faces[i][k].template cast<float>();
        }
      }
      placeLeaf(vertices, faces, leaf, tree_);
      Content& content = leaf_content_[l];
      content.begin = chunks_.size();
      const Lanes* const lanes = &tree_.lanes[leaf.offset];
      for (int i = 0; i < leaf.num_vertices; i += kLanes) {
        const Lanes* const rows = lanes + 3 * (i / kLanes);
        chunks_.push_back({rows[0], rows[1], rows[2]});
      }
      content.end = chunks_.size();
      content.moments = momentsOf(vertices, leaf.num_vertices);
    }
  }

  void fit(std::size_t n) {
    Node& node = tree_.nodes[n];
    Content& content = content_[n];
    if (node.isLeaf()) {
      content = leaf_content_[node.leaf()];
    } else {
      const int count = tree_.children[static_cast<std::size_t>(node.child)].count;
      content = content_[node.first_child];
      for (int i = 1; i < count; ++i) {
        const Content& child = content_[node.first_child + i];
        content.begin = std::min(content.begin, child.begin);
        content.end = std::max(content.end, child.end);
        content.moments.add(child.moments);
      }
    }
    quickFit(&chunks_[content.begin], content.end - content.begin, content.moments, node,
             tree_.boxes.empty() ? nullptr : &tree_.boxes[n]);
    tree_.reach = std::max(tree_.reach, reachOf(node));
    if (!node.isLeaf()) fillBlock(node);
  }

  void fillBlock(const Node& node) {
    Block& block = tree_.blocks[static_cast<std::size_t>(node.child)];
    Children& children = tree_.children[static_cast<std::size_t>(node.child)];
    children.flat = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool used = lane < children.count;
      const Node& child = tree_.nodes[node.first_child + (used ? lane : 0)];
      if (used) children.flat |= static_cast<std::uint8_t>(child.flat << lane);
      writeLane(child, lane, block);
    }
  }

  const MeshView<S> mesh_;
  Tree& tree_;
  Eigen::Vector3d origin_;
  std::vector<PointChunk> chunks_;
  std::vector<Content> leaf_content_, content_;  ///< by leaf, by node
};

}  // namespace

template <typename S>
bool refit(const MeshView<S>& mesh, Tree& tree) {
  return Refit<S>(mesh, tree).run();
}

template bool refit(const MeshView<double>&, Tree&);
template bool refit(const MeshView<float>&, Tree&);

}  // namespace kios::engine
