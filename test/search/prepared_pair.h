// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "all_pairs.h"
#include "build/mesh_view.h"
#include "search/mesh_search.h"
#include "shapes.h"
#include "tree/prepare.h"
#include "tree/refit.h"

// Shapes with their trees, and pairs of them, that the tests of the engine share.

namespace kios::testing {

template <typename S>
engine::MeshView<S> viewOf(const MeshIn<S>& shape) {
  return {shape.vertices.data(), shape.vertices.size(), shape.triangles.data(),
          shape.triangles.size()};
}

/// Returns the tree as prepared, or as refitted from where the mesh was before; nullptr if it can't
/// be.
template <typename S>
std::unique_ptr<engine::Tree> treeOf(const MeshIn<S>& shape, const MeshIn<S>* before) {
  if (!before) return engine::prepare(viewOf(shape));
  auto tree = engine::prepare(viewOf(*before));
  return engine::refit(viewOf(shape), *tree) ? std::move(tree) : nullptr;
}

/// Returns the triangles below each node.
inline std::vector<std::vector<std::uint32_t>> contents(const engine::Tree& tree) {
  std::vector<std::vector<std::uint32_t>> below(tree.nodes.size());
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children follow their parents
    const engine::Node& node = tree.nodes[n];
    if (node.isLeaf()) {
      const engine::Leaf& leaf = tree.leaves[node.leaf()];
      for (std::size_t i = 0; i < leaf.num_faces; ++i) {
        below[n].push_back(tree.features[leaf.feature_offset + i].triangle());
      }
      continue;
    }
    for (std::uint32_t i = 0; i < tree.children[static_cast<std::size_t>(node.child)].count; ++i) {
      const auto& child = below[node.first_child + i];
      below[n].insert(below[n].end(), child.begin(), child.end());
    }
  }
  return below;
}

/// Returns points in heaps that fill leaves: volumes of size 0, whose bounds are as wide as the
/// pads let them be.
inline Mesh heaps(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Mesh> parts;
  for (int i = 0; i < count; ++i) {
    const fcl::Vector3d p = inCube(random);
    parts.insert(parts.end(), engine::kLeafTriangles, scenes::singleTriangle(p, p, p));
  }
  return scenes::merged(parts);
}

/// Holds two shapes with their trees, at a pose.
template <typename S>
class PosedPair {
 public:
  explicit PosedPair(const Mesh& a, const Mesh& b, bool refitted = false)
      : a(a), b(b), tree_a(made(this->a, a, refitted)), tree_b(made(this->b, b, refitted)) {}

  /// Returns false if floats can't serve the pair there.
  bool pose(const fcl::Transform3<S>& X_A, const fcl::Transform3<S>& X_B) {
    pair_.emplace(kios::Mesh(viewOf(a), *tree_a, kIOS<S>(), nullptr), X_A,
                  kios::Mesh(viewOf(b), *tree_b, kIOS<S>(), nullptr), X_B);
    return pair_->floats_serve;
  }
  const MeshPair& pair() const { return *pair_; }
  AllPairs all() const { return {trianglesOf(a), trianglesOf(b), pair_->X_AB}; }

  const MeshIn<S> a, b;
  const std::unique_ptr<engine::Tree> tree_a, tree_b;

 private:
  static std::unique_ptr<engine::Tree> made(const MeshIn<S>& shape, const Mesh& mesh,
                                            bool refitted) {
    const MeshIn<S> before(swayed(mesh));
    auto tree = treeOf(shape, refitted ? &before : nullptr);
    return tree ? std::move(tree) : engine::prepare(viewOf(shape));
  }
  std::optional<MeshPair> pair_;
};

}  // namespace kios::testing
