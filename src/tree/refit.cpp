// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/refit.h"

#include <algorithm>
#include <vector>

#include "tree/box_fit.h"
#include "tree/leaf_layout.h"
#include "tree/moment_fit.h"
#include "tree/node_layout.h"
#include "tree/tuning.h"

namespace kios::engine {
namespace {

template <typename S>
class Refit {
 public:
  Refit(const MeshView<S>& mesh, Tree& tree) : mesh_(mesh), tree_(tree) {}

  bool run() {
    if (!sameTopology()) return false;
    placeOrigin(mesh_, tree_);
    moments_.resize(tree_.nodes.size());
    placeLeaves();
    const TreePoints points(tree_);
    // Nodes lie before their children.
    tree_.reach = 0;
    for (std::size_t n = tree_.nodes.size(); n-- > 0;) fit(n, points);
    if (!tree_.boxes.empty()) fitBoxes(points, tree_);  // none need be flat now
    fitRootBox(points, tree_);
    measureLeaves(tree_);
    return searchCost(tree_) <= tuning::kPoor * tree_.cost;
  }

 private:
  /// True if the mesh has the triangles that the tree was made of, and what was one vertex still
  /// is: the tree's topology is then the mesh's.
  bool sameTopology() const {
    if (!(indexHash(mesh_) == tree_.indices)) return false;
    for (std::size_t t = 0; t < tree_.corners.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (mesh_.corner(t, k) != mesh_.vertices[tree_.corners[t][k]]) return false;
      }
    }
    return true;
  }

  void placeLeaves() {
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      if (!tree_.nodes[n].isLeaf()) continue;
      Leaf& leaf = tree_.leaves[tree_.nodes[n].leaf()];
      Eigen::Vector3f vertices[kMaxLeafFeatures];
      placeLeaf(mesh_, leaf, tree_, vertices);
      moments_[n] = momentsOf(vertices, leaf.num_vertices);
    }
  }

  void fit(std::size_t n, const TreePoints& points) {
    Node& node = tree_.nodes[n];
    Moments& moments = moments_[n];
    if (!node.isLeaf()) {
      moments = moments_[node.first_child];
      const int count = tree_.children[static_cast<std::size_t>(node.child)].count;
      for (int i = 1; i < count; ++i) moments.add(moments_[node.first_child + i]);
    }
    Box* box = tree_.boxes.empty() ? nullptr : &tree_.boxes[n];
    if (!box && n == 0) box = &tree_.root_box;
    momentFit(points.chunksOf(n), points.numChunks(n), moments, node, box);
    if (tree_.boxes.empty()) node.flat = 0;  // no search has its box
    tree_.reach = std::max(tree_.reach, reachOf(node));
    if (!node.isLeaf()) fillBlock(node, tree_);
  }

  const MeshView<S> mesh_;
  Tree& tree_;
  std::vector<Moments> moments_;  ///< by node
};

}  // namespace

template <typename S>
bool refit(const MeshView<S>& mesh, Tree& tree) {
  return Refit<S>(mesh, tree).run();
}

template bool refit(const MeshView<double>&, Tree&);
template bool refit(const MeshView<float>&, Tree&);

}  // namespace kios::engine
