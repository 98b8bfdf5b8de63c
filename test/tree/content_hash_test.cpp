// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Content hashes tell meshes apart.

#include <gtest/gtest.h>

#include <vector>

#include "fcl/mesh_cases.h"
#include "tree/content_hash.h"

namespace kios::testing {
namespace {

using engine::ContentHash;

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

}  // namespace
}  // namespace kios::testing
