// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The binary tree of a mesh: its order, its volumes, and meshes made to be hard to divide.

#include "build/mesh_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "fcl_kios/volume.h"
#include "model/bvh_check.h"
#include "scalars.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

template <typename S>
struct Built {
  std::vector<engine::VolumeNode<S>> nodes;
  std::vector<unsigned int> primitives;
  bool whole;

  explicit Built(const MeshIn<S>& shape)
      : nodes(2 * shape.triangles.size() - 1), primitives(shape.triangles.size()) {
    whole = engine::buildVolumes(viewOf(shape), nodes.data(), primitives.data());
  }
};

/// The nodes are numbered in pairs, depth first, and share the primitives out. Returns the nodes on
/// the longest way down.
template <typename S>
int expectOrder(const Built<S>& built) {
  struct Part {
    int node, depth;
  };
  int next = 1, deepest = 0;
  std::vector<Part> stack = {{0, 1}};
  while (!stack.empty()) {
    const Part at = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, at.depth);
    const auto& node = built.nodes[at.node];
    if (node.num_primitives == 1) {
      EXPECT_EQ(node.first_child, -static_cast<int>(built.primitives[node.first_primitive]) - 1);
      continue;
    }
    EXPECT_EQ(node.first_child, next);
    if (node.first_child != next) return deepest;
    next += 2;
    const auto &left = built.nodes[node.first_child], &right = built.nodes[node.first_child + 1];
    EXPECT_EQ(left.first_primitive, node.first_primitive);
    EXPECT_EQ(right.first_primitive, node.first_primitive + left.num_primitives);
    EXPECT_EQ(left.num_primitives + right.num_primitives, node.num_primitives);
    EXPECT_GE(std::min(left.num_primitives, right.num_primitives), 1);
    stack.push_back({node.first_child + 1, at.depth + 1});
    stack.push_back({node.first_child, at.depth + 1});
  }
  EXPECT_EQ(next, static_cast<int>(built.nodes.size()));
  std::vector<unsigned int> sorted = built.primitives, all(sorted.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(sorted, all);
  return deepest;
}

template <typename S>
void expectContained(const MeshIn<S>& shape, const Built<S>& built) {
  int outside = 0;
  for (const auto& node : built.nodes) {
    for (int i = 0; i < node.num_primitives; ++i) {
      for (const auto& p : shape.corners(built.primitives[node.first_primitive + i])) {
        outside += !testing::containsExactly(node.bv, p) || !node.bv.contain(p);
      }
    }
  }
  EXPECT_EQ(outside, 0);
}

KIOS_SCALAR_SUITE(MeshTree);

TYPED_TEST(MeshTree, EveryVolumeHoldsItsVertices) {
  using S = TypeParam;
  std::vector<NamedMesh> meshes = allMeshes<S>();
  // Above 64 and above 2048 triangles spheres are placed by some of the points.
  for (const int n : {65, 200, 700, 3000, 9000}) {
    meshes.push_back({"torus", scenes::bumpyTorus(n)});
    meshes.push_back({"soup", scenes::randomSoup(n, 1, 1e-3, 1, 50 + n)});
  }
  const double far = sizeof(S) == sizeof(double) ? 1e12 : 1e5;
  meshes.push_back({"far", transformed(scenes::bumpyTorus(3000), 1, {far, -far, far / 3})});
  for (const double scale : {1e-40, 1e-15, 1e12}) {
    meshes.push_back({"scaled", transformed(scenes::bumpyTorus(700),
                                            scale < 1e-30 && sizeof(S) == 4 ? 1e-16 : scale,
                                            fcl::Vector3d::Zero())});
  }
  scenes::Mesh detail = scenes::bumpyTorus(700);  // far too small for a frame that both share
  detail = scenes::merged({detail, transformed(detail, 1e-6, {0.3, 0.1, 0.2}),
                           transformed(scenes::bumpyTorus(3000), 1e5, {1e6, 0, 0})});
  meshes.push_back({"details of three sizes", detail});
  for (const NamedMesh& named : meshes) {
    SCOPED_TRACE(named.name + ", " + std::to_string(named.mesh.triangles.size()));
    const MeshIn<S> shape(named.mesh);
    const Built<S> built(shape);
    ASSERT_TRUE(built.whole);
    expectOrder(built);
    expectContained(shape, built);
  }
}

TYPED_TEST(MeshTree, WhatItCantServeIsRefused) {
  using S = TypeParam;
  const S none = std::numeric_limits<S>::quiet_NaN(), huge = std::numeric_limits<S>::infinity();
  const S far = sizeof(S) == sizeof(double) ? S(1e200) : S(1e25F);
  for (const S bad : {none, huge, -huge, far}) {
    MeshIn<S> shape(scenes::bumpyTorus(300));
    shape.vertices[17][1] = bad;
    EXPECT_FALSE(Built<S>(shape).whole);
  }
}

/// Over a tree, radii are hardly larger than those of the tuned fit of the same points.
TEST(MeshTreeFit, IsNearlyAsTightAsTheTunedFit) {
  const MeshIn<double> shape(scenes::bumpyTorus(6000));
  const Built<double> built(shape);
  struct Sum {
    double s0 = 0, cap = 0, worst = 0;
    int count = 0;
  };
  Sum triangles, small, large;
  for (const auto& node : built.nodes) {
    std::vector<fcl::Vector3d> points;
    for (int i = 0; i < node.num_primitives; ++i) {
      for (const auto& p : shape.corners(built.primitives[node.first_primitive + i])) {
        if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
      }
    }
    const kIOSd tuned = testing::fitted(points);
    Sum& sum = node.num_primitives == 1 ? triangles : (node.num_primitives <= 8 ? small : large);
    const double ratio = node.bv.radius0 / tuned.radius0;
    sum.s0 += ratio;
    sum.worst = std::max(sum.worst, ratio);
    sum.cap += double{*std::max_element(node.bv.cap_r, node.bv.cap_r + 4)} /
               *std::max_element(tuned.cap_r, tuned.cap_r + 4);
    ++sum.count;
  }
  const auto expect = [](const char* name, const Sum& sum, double mean, double worst) {
    std::printf("%-10s %5d nodes: S0 %.4f, at most %.3f, largest cap %.4f of the tuned fit's\n",
                name, sum.count, sum.s0 / sum.count, sum.worst, sum.cap / sum.count);
    EXPECT_LT(sum.s0 / sum.count, mean);
    EXPECT_LT(sum.cap / sum.count, mean);
    EXPECT_LT(sum.worst, worst);
  };
  expect("triangles", triangles, 1.0001, 1.001);
  expect("small", small, 1.03, 1.2);
  expect("large", large, 1.02, 1.1);
}

/// Returns triangles that are hard to divide. `count` is for the large ones.
std::vector<NamedMesh> hardMeshes(int count) {
  std::vector<NamedMesh> meshes = {{"one triangle again and again", repeated(count)}};
  scenes::Mesh concentric;
  for (int i = 1; i <= count; ++i) {
    const double r = 1 + i % 1000 / 500.0;
    addTriangle(concentric, {r, 0, r}, {-r, r, 0}, {0, -r, -r});
  }
  meshes.push_back({"one centroid", concentric});
  scenes::Mesh fan;
  fan.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i <= count; ++i) {
    const double angle = 6.0 * i / count;
    fan.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    if (i > 0) {
      fan.triangles.emplace_back(0, static_cast<std::size_t>(i), static_cast<std::size_t>(i + 1));
    }
  }
  meshes.push_back({"a fan of slivers", fan});
  scenes::Mesh outlier = scenes::bumpyTorus(count);
  meshes.push_back(
      {"one triangle a million times the others",
       scenes::merged({outlier, scenes::singleTriangle({0, 0, 0}, {1e6, 0, 0}, {0, 1e6, 1e6})})});
  scenes::Mesh chain;  // each so much farther that a plane splits off but a few
  for (int i = 0; i < count; ++i) {
    const double x = std::pow(1.01, std::min(i, 3000)) + 1e-3 * i;
    addTriangle(chain, {x, 0, 0}, {x, 1, 0}, {x, 0, 1});
  }
  meshes.push_back({"farther and farther", chain});
  return meshes;
}

// As every level holds each triangle once, the depth bounds the work: O(n log n).
TYPED_TEST(MeshTree, NoMeshIsDeep) {
  using S = TypeParam;
  for (const int count : {1000, 100000}) {
    for (const NamedMesh& named : hardMeshes(count)) {
      SCOPED_TRACE(named.name);
      const MeshIn<S> shape(named.mesh);
      const Built<S> built(shape);
      ASSERT_TRUE(built.whole);
      const int deepest = expectOrder(built);
      std::printf("%-40s %7zu triangles: %d nodes deep\n", named.name.c_str(),
                  shape.triangles.size(), deepest);
      EXPECT_LE(deepest, engine::kMaxDepth);
      if (count == 1000) expectContained(shape, built);
    }
  }
}

}  // namespace
}  // namespace kios::testing
