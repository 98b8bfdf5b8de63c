// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fcl_kios/model.h"
#include "volume/exact_spheres.h"

// Checks of the tree of an fcl::BVHModel over k-IOS; tree/tree_check.h checks prepared trees.

namespace kios::testing {

/// The triangles that the leaves below `node` hold.
template <typename S>
void trianglesBelow(const Model<S>& model, int node, std::vector<int>& triangles) {
  const fcl::BVNode<kIOS<S>>& bv_node = model.getBV(node);
  if (bv_node.isLeaf()) {
    triangles.push_back(bv_node.primitiveId());
    return;
  }
  trianglesBelow(model, bv_node.leftChild(), triangles);
  trianglesBelow(model, bv_node.rightChild(), triangles);
}

/// 2n - 1 nodes; each triangle in one leaf; every volume contains the vertices of the triangles
/// below it, and their previous positions where the model keeps them.
template <typename S>
void expectValidTree(const Model<S>& model) {
  ASSERT_EQ(model.getNumBVs(), 2 * model.num_tris - 1);
  std::vector<int> reached;
  trianglesBelow(model, 0, reached);
  std::vector<int> sorted = reached;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(static_cast<int>(sorted.size()), model.num_tris);
  for (int i = 0; i < model.num_tris; ++i) ASSERT_EQ(sorted[i], i);

  int outside = 0;
  for (int node = 0; node < model.getNumBVs(); ++node) {
    const kIOS<S>& bv = model.getBV(node).bv;
    std::vector<int> triangles;
    trianglesBelow(model, node, triangles);
    for (const int triangle : triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        const std::size_t id = model.tri_indices[triangle][corner];
        for (const auto* vertices : {model.vertices, model.prev_vertices}) {
          if (!vertices) continue;
          outside += !testing::containsExactly(bv, vertices[id]) || !bv.contain(vertices[id]);
        }
      }
    }
  }
  EXPECT_EQ(outside, 0);
}

/// The nodes of a model that may go: while it lives, builds of equal meshes copy them.
template <typename S>
std::vector<fcl::BVNode<kIOS<S>>> nodesOf(const Model<S>& model) {
  return {&model.getBV(0), &model.getBV(0) + model.getNumBVs()};
}

/// Asks for equal topology, and volumes that are equal bit by bit.
template <typename S>
bool sameTree(const Model<S>& a, const std::vector<fcl::BVNode<kIOS<S>>>& b) {
  return a.getNumBVs() == static_cast<int>(b.size()) &&
         std::equal(b.begin(), b.end(), &a.getBV(0), [](const auto& x, const auto& y) {
           return x.first_child == y.first_child && x.first_primitive == y.first_primitive &&
                  x.num_primitives == y.num_primitives && testing::bitwiseEqual(x.bv, y.bv);
         });
}
template <typename S>
bool sameTree(const Model<S>& a, const Model<S>& b) {
  return sameTree(a, nodesOf(b));
}

}  // namespace kios::testing
