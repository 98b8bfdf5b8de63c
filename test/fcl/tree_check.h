// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "fcl_kios/model/model.h"

// Whether the tree of an fcl::BVHModel over k-IOS is what queries rely on.

namespace kios::testing {

/// Whether p lies in each sphere of the representation, in long double.
template <typename S>
bool containsExactly(const kIOS<S>& bv, const fcl::Vector3<S>& p) {
  using Point = Eigen::Matrix<long double, 3, 1>;
  const Point v = p.template cast<long double>() - bv.center0.template cast<long double>();
  if (bv.k() == 0 || !(v.norm() <= static_cast<long double>(bv.radius0))) return false;
  for (int i = 0; i + 1 < bv.k(); ++i) {
    const Point unscaled(bv.cap_x[i], bv.cap_y[i], bv.cap_z[i]);
    const long double scale = std::ldexp(1.0L, bv.exponent);
    if (!((v - scale * unscaled).norm() <= scale * bv.cap_r[i])) return false;
  }
  return true;
}

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
          outside += !containsExactly(bv, vertices[id]) || !bv.contain(vertices[id]);
        }
      }
    }
  }
  EXPECT_EQ(outside, 0);
}

template <typename S>
bool sameVolume(const kIOS<S>& a, const kIOS<S>& b) {
  const auto same = [](const float* x, const float* y) { return std::equal(x, x + 4, y); };
  return a.center0 == b.center0 && a.radius0 == b.radius0 && same(a.cap_x, b.cap_x) &&
         same(a.cap_y, b.cap_y) && same(a.cap_z, b.cap_z) && same(a.cap_r, b.cap_r) &&
         a.reach == b.reach && a.exponent == b.exponent && a.k() == b.k();
}

/// The nodes of a model that may go: while it lives, builds of equal meshes copy them.
template <typename S>
std::vector<fcl::BVNode<kIOS<S>>> nodesOf(const Model<S>& model) {
  return {&model.getBV(0), &model.getBV(0) + model.getNumBVs()};
}

/// Equal topology, and volumes that are equal bit by bit.
template <typename S>
bool sameTree(const Model<S>& a, const std::vector<fcl::BVNode<kIOS<S>>>& b) {
  return a.getNumBVs() == static_cast<int>(b.size()) &&
         std::equal(b.begin(), b.end(), &a.getBV(0), [](const auto& x, const auto& y) {
           return x.first_child == y.first_child && x.first_primitive == y.first_primitive &&
                  x.num_primitives == y.num_primitives && sameVolume(x.bv, y.bv);
         });
}
template <typename S>
bool sameTree(const Model<S>& a, const Model<S>& b) {
  return sameTree(a, nodesOf(b));
}

}  // namespace kios::testing
