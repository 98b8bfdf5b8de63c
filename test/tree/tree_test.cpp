// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The prepared tree holds the mesh, all of it, and nothing sticks out of its volumes.

#include <algorithm>
#include <cstring>

#include "scalars.h"
#include "tree/tree_check.h"

namespace kios::testing {
namespace {

using engine::Node;

KIOS_SCALAR_SUITE(PreparedTree);

TYPED_TEST(PreparedTree, HoldsTheMesh) {
  for (const NamedMesh& named : allMeshes<TypeParam>()) {
    SCOPED_TRACE(named.name);
    const MeshIn<TypeParam> shape(named.mesh);
    const auto tree = engine::prepare(viewOf(shape));
    TreeOf<TypeParam>(shape, *tree).check();
    const bool flat = std::any_of(tree->nodes.begin(), tree->nodes.end(),
                                  [](const Node& node) { return node.flat != 0; });
    EXPECT_EQ(tree->boxes.empty(), !flat);
  }
}

// Nothing of what a build is given but the mesh shows in the tree.
TYPED_TEST(PreparedTree, DependsOnTheMeshAlone) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  for (const NamedMesh& named : unitMeshes()) {
    SCOPED_TRACE(named.name);
    const MeshIn<TypeParam> shape(named.mesh), copy(named.mesh);
    const auto one = engine::prepare(viewOf(shape));
    engine::prepare(viewOf(MeshIn<TypeParam>(scenes::icosphere(1, 2))));
    const auto two = engine::prepare(viewOf(copy));
    EXPECT_TRUE(same(one->nodes, two->nodes) && same(one->blocks, two->blocks));
    EXPECT_TRUE(same(one->boxes, two->boxes) && same(one->box_blocks, two->box_blocks));
    EXPECT_TRUE(same(one->lanes, two->lanes) && same(one->features, two->features));
    EXPECT_EQ(one->bytes(), two->bytes());
  }
}

// Vertices that no triangle uses change nothing, wherever they are.
TYPED_TEST(PreparedTree, UnusedVerticesAreIgnored) {
  Mesh mesh = scenes::bumpyTorus(300);
  const MeshIn<TypeParam> plain(mesh);
  mesh.vertices.emplace_back(1e8, 0, 0);
  const MeshIn<TypeParam> shape(mesh);
  const auto tree = engine::prepare(viewOf(shape));
  TreeOf<TypeParam>(shape, *tree).check();
  EXPECT_EQ(tree->reach, engine::prepare(viewOf(plain))->reach);
}

}  // namespace
}  // namespace kios::testing
