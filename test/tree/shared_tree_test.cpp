// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models of equal content share a prepared tree, and no others do.

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fcl/mesh_cases.h"
#include "model/prepared.h"
#include "together.h"
#include "tree/prepare.h"
#include "tree/shared_tree.h"

namespace kios::testing {
namespace {

using engine::ContentHash;
using engine::SharedTree;

template <typename S>
ContentHash hashOf(const std::vector<fcl::Vector3<S>>& vertices,
                   const std::vector<fcl::Triangle>& triangles) {
  return engine::contentHash(
      engine::MeshView<S>{vertices.data(), vertices.size(), triangles.data(), triangles.size()});
}
ContentHash hashOf(const Mesh& mesh) { return hashOf(mesh.vertices, mesh.triangles); }

// Meshes of 1 to 12 triangles: xxHash has other code for short input.
TEST(ContentHash, EveryBitCounts) {
  for (const int count : {1, 2, 5, 12}) {
    Mesh mesh = scenes::icosphere(1, 1);
    mesh.triangles.resize(static_cast<std::size_t>(count));
    mesh.vertices.resize(40);
    const ContentHash before = hashOf(mesh);
    const Mesh copy = mesh;
    EXPECT_TRUE(hashOf(copy) == before);
    const auto flip = [&](void* array, std::size_t bytes) {
      auto* const at = static_cast<unsigned char*>(array);
      for (std::size_t bit = 0; bit < 8 * bytes; ++bit) {
        at[bit / 8] = static_cast<unsigned char>(at[bit / 8] ^ 1U << bit % 8);
        ASSERT_FALSE(hashOf(mesh) == before) << bit;
        at[bit / 8] = static_cast<unsigned char>(at[bit / 8] ^ 1U << bit % 8);
      }
    };
    flip(mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
    flip(static_cast<void*>(mesh.triangles.data()),
         mesh.triangles.size() * sizeof(mesh.triangles[0]));
    EXPECT_TRUE(hashOf(mesh) == before);
  }
}

TEST(ContentHash, CountsAndScalarsCount) {
  const Mesh mesh = scenes::icosphere(1, 0);
  Mesh more = mesh;
  more.vertices.emplace_back(0, 0, 0);  // used by no triangle
  EXPECT_FALSE(hashOf(more) == hashOf(mesh));
  // Doubles and floats have the same bytes here.
  const std::vector<Vector3d> zeros(2, Vector3d::Zero());
  const std::vector<fcl::Vector3f> float_zeros(4, fcl::Vector3f::Zero());
  EXPECT_FALSE(hashOf<double>(zeros, mesh.triangles) == hashOf<float>(float_zeros, mesh.triangles));
  // The last vertex can't pass for the first of the triangles.
  const std::vector<Vector3d> none;
  Mesh moved = mesh;
  moved.vertices.resize(1);
  EXPECT_FALSE(hashOf<double>(none, mesh.triangles) == hashOf(moved));
}

std::unique_ptr<engine::Tree> treeAt(double x) {
  auto tree = std::make_unique<engine::Tree>();
  tree->origin[0] = x;
  return tree;
}

TEST(SharedTree, IsMadeOnceAndGoesWithTheLastHolder) {
  int made = 0;
  const auto make = [&] { return treeAt(++made); };
  for (int round = 1; round <= 2; ++round) {
    SharedTree first({1, 2}, make), second({1, 2}, make), third;
    EXPECT_EQ(made, round);
    EXPECT_EQ(first.get(), second.get());
    third = std::move(first);
    EXPECT_FALSE(first);  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(third.get(), second.get());
    const SharedTree other({1, 3}, [] { return treeAt(0); });
    EXPECT_NE(other.get(), second.get());
  }
}

TEST(SharedTree, DetachedTreesAreTheHoldersOwn) {
  const ContentHash content = {5, 5};
  SharedTree first(content, [] { return treeAt(1); });
  const engine::Tree* const at = first.get();
  EXPECT_EQ(&first.detach(), at);  // nobody else holds it
  SharedTree second(content, [] { return treeAt(2); });
  EXPECT_EQ(second.get()->origin[0], 2);  // and nobody finds it any more
  SharedTree third(content, [] { return treeAt(3); });
  third.detach().origin[0] = 4;
  EXPECT_EQ(second.get()->origin[0], 2);
  EXPECT_EQ(third.get()->origin[0], 4);
  EXPECT_EQ(SharedTree(content, [] { return treeAt(5); }).get(), second.get());
}

TEST(SharedTree, AFailureLeavesNothing) {
  const ContentHash content = {6, 6};
  const auto fail = []() -> std::unique_ptr<engine::Tree> { throw std::runtime_error("failed"); };
  EXPECT_THROW(SharedTree(content, fail), std::runtime_error);
  SharedTree tree(content, [] { return treeAt(1); });
  EXPECT_EQ(tree.get()->origin[0], 1);
  EXPECT_EQ(SharedTree(content, fail).get(), tree.get());
}

TEST(SharedTree, OfModels) {
  const Mesh mesh = scenes::bumpyTorus(500);
  const auto a = kiosModel(mesh), b = kiosModel(mesh);
  const auto copy = std::make_shared<Modeld>(*a);
  const auto published = std::make_shared<Modeld>();
  published->bv_fitter.reset(new fcl::detail::BVFitter<kIOSd>(FitMethod::kMethodII));
  published->beginModel();
  published->addSubModel(mesh.vertices, mesh.triangles);
  published->endModel();
  const engine::Tree* const tree = preparedTree(*a).operator->();
  ASSERT_NE(tree, nullptr);
  for (const auto& model : {b, copy, published}) {
    EXPECT_EQ(preparedTree(*model).operator->(), tree);
  }
  // One that moved has its own, made of the shared one; the others keep theirs.
  Mesh moved = mesh;
  moved.vertices[0] += Vector3d(1e-3, 0, 0);
  b->beginReplaceModel();
  b->replaceSubModel(moved.vertices);
  b->endReplaceModel();
  EXPECT_NE(preparedTree(*b).operator->(), tree);
  EXPECT_EQ(preparedTree(*a).operator->(), tree);
  EXPECT_EQ(preparedTree(*kiosModel(mesh)).operator->(), tree);
  EXPECT_NE(preparedTree(*kiosModel(moved)).operator->(), preparedTree(*b).operator->());
}

// What a query prepares of vertices that were written in place isn't taken for the old ones.
TEST(SharedTree, VerticesWrittenInPlace) {
  const Mesh mesh = scenes::bumpyTorus(500);
  const auto written = kiosModel(mesh);
  written->vertices[0] += Vector3d(1e-3, 0, 0);
  const engine::Tree* const stale = preparedTree(*written).operator->();
  EXPECT_NE(preparedTree(*kiosModel(mesh)).operator->(), stale);
}

TEST(SharedTree, ManyThreadsWaitForOne) {
  for (std::uint64_t round = 0; round < 100; ++round) {
    std::atomic<int> made{0}, failed{0}, wrong{0};
    together(10, [&](int t) {
      for (int i = 0; i < 20; ++i) {
        try {
          SharedTree tree({round, 1}, [&] {
            if (++made % 3 == 0) throw std::runtime_error("failed");
            return treeAt(7);
          });
          wrong += tree.get()->origin[0] != 7;
          if ((i + t) % 5 != 0) continue;
          tree.detach().origin[0] = t;
          wrong += tree.get()->origin[0] != t;
        } catch (const std::runtime_error&) {
          ++failed;
        }
      }
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(failed, made / 3);
  }
}

}  // namespace
}  // namespace kios::testing
