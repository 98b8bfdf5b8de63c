// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A prepared tree whose mesh moved: refitted, or refused where that can't be.

#include <algorithm>

#include "scalars.h"
#include "tree/node_layout.h"
#include "tree/tree_check.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(RefittedTree);

// Refitted from where it was before. What the refit refuses is prepared anew by queries.
TYPED_TEST(RefittedTree, HoldsTheMesh) {
  int refitted = 0, all = 0;
  for (const NamedMesh& named : allMeshes<TypeParam>()) {
    SCOPED_TRACE(named.name);
    const MeshIn<TypeParam> shape(named.mesh), before(swayed(named.mesh));
    const auto tree = treeOf(shape, &before);
    ++all;
    if (!tree) continue;
    ++refitted;
    TreeOf<TypeParam>(shape, *tree).check();
  }
  EXPECT_GE(refitted, all - 4);
}

// Moves and turns in a row leave a tree as good as a new one, nearly.
TYPED_TEST(RefittedTree, ManyTimes) {
  const Mesh mesh = scenes::bumpyTorus(2000);
  const auto tree = engine::prepare(viewOf(MeshIn<TypeParam>(mesh)));
  const double cost = tree->cost;
  for (int i = 0; i < 20; ++i) {
    const fcl::Transform3d X(Eigen::AngleAxisd(i, fcl::Vector3d(1, i, 2).normalized()));
    const MeshIn<TypeParam> shape(swayed(scenes::moved(X, mesh)));
    ASSERT_TRUE(engine::refit(viewOf(shape), *tree));
    EXPECT_LT(engine::searchCost(*tree), 1.25 * engine::prepare(viewOf(shape))->cost);
    EXPECT_EQ(tree->cost, cost);
  }
}

// Plates and strips have boxes, which hold them wherever they turn, and stay about as flat as new
// ones.
TYPED_TEST(RefittedTree, BoxesOfFlatMeshes) {
  const auto flatOf = [](const Tree& tree) {
    return std::count_if(tree.nodes.begin(), tree.nodes.end(),
                         [](const Node& node) { return node.flat != 0; });
  };
  const Mesh meshes[] = {scenes::stripCylinder(60, 0.8, 0.004),
                         scenes::boredBlock({0.4, 0.25, 0.03}, 0.03, 0.004, 0.05, 32),
                         scenes::sheet(2, 2, 8, 8, 0), scenes::subdividedBox({1, 1, 1e-3}, 4)};
  for (const Mesh& mesh : meshes) {
    const auto tree = engine::prepare(viewOf(MeshIn<TypeParam>(mesh)));
    ASSERT_FALSE(tree->boxes.empty());
    for (int i = 1; i < 6; ++i) {
      const fcl::Transform3d X(Eigen::AngleAxisd(i, fcl::Vector3d(1, i, 2).normalized()));
      const MeshIn<TypeParam> shape(scenes::moved(X, mesh));
      ASSERT_TRUE(engine::refit(viewOf(shape), *tree));
      TreeOf<TypeParam>(shape, *tree).check();
      EXPECT_GE(2 * flatOf(*tree), flatOf(*engine::prepare(viewOf(shape))));
    }
  }
}

TYPED_TEST(RefittedTree, RefusesAnotherMesh) {
  const Mesh torus = scenes::bumpyTorus(300), apart = scenes::soup(torus);
  const auto refits = [](const Mesh& before, const Mesh& after) {
    const MeshIn<TypeParam> from(before), to(after);
    return treeOf(to, &from) != nullptr;
  };
  EXPECT_TRUE(refits(torus, torus));
  EXPECT_TRUE(refits(apart, apart));
  EXPECT_FALSE(refits(torus, scenes::bumpyTorus(400)));
  Mesh torn = apart;  // a corner of one triangle only: it was one vertex with its neighbours'
  torn.vertices.back()[0] += 1e-3;
  EXPECT_FALSE(refits(apart, torn));
  EXPECT_TRUE(refits(torn, apart));  // what comes together is no harm
  Mesh other = torus;                // as many triangles of the same vertices
  std::swap(other.triangles[3], other.triangles[200]);
  EXPECT_FALSE(refits(torus, other));
  Mesh shuffled = torus;  // a partition that holds no more
  Random random(5);
  for (fcl::Vector3d& p : shuffled.vertices) {
    p = torus.vertices[static_cast<std::size_t>(random.uniform(0, 100))];
  }
  EXPECT_FALSE(refits(torus, shuffled));
}

}  // namespace
}  // namespace kios::testing
