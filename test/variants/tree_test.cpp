// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees of all volumes answer as the oracle does.
#include "fcl_kios/variants/variant_tree.h"

#include <gtest/gtest.h>

#include "bv/point_sets.h"
#include "fcl_kios/variants/kios_policy.h"
#include "scenes/oracle.h"
#include "scenes/shapes.h"

namespace kios::test {
namespace {

TEST(VariantTree, KiosDistance) {
  const scenes::Mesh a = scenes::bentTorus(), b = scenes::bumpyBlob();
  const scenes::MeshOracle oracle(a, b);
  const auto split_a = std::make_shared<MeshSplit>(a.vertices, a.triangles);
  const auto split_b = std::make_shared<MeshSplit>(b.vertices, b.triangles);
  const VariantTree<KiosPolicy> tree_a(split_a), tree_b(split_b);
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    fcl::Transform3d X_WA = fcl::Transform3d::Identity(), X_WB = X_WA;
    X_WA.linear() = randomRotation(random);
    X_WB.linear() = randomRotation(random);
    X_WB.translation() = randomDirection(random) * random.uniform(0, 3);
    const RelativePose<double> X(X_WA, X_WB);
    const auto d = tree_a.distance(tree_b, X);
    EXPECT_NEAR(d.distance, oracle.distance(X_WA, X_WB), 1e-14);
    const auto c = tree_a.collide(tree_b, X);
    EXPECT_EQ(c.contact, oracle.collide(X_WA, X_WB));
  }
}

}  // namespace
}  // namespace kios::test
