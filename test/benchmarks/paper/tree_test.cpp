// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trees of all fits and variants answer as the oracle does. Fixed directions need little memory,
// and nothing is computed again when a model turns (paper, III-A and V-B).
#include "paper/variant_tree.h"

#include <gtest/gtest.h>

#include "benchmarks/paper/policies.h"
#include "scenes/oracle.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

using scenes::Mesh;

template <typename Policy>
VariantTree<Policy> treeOf(const Split& split, const Policy& policy) {
  return VariantTree<Policy>(split, policy);
}

Mesh moved(Mesh mesh, double scale, const fcl::Vector3d& shift) {
  for (auto& p : mesh.vertices) p = scale * p + shift;
  return mesh;
}

struct Pose {
  fcl::Transform3d a = fcl::Transform3d::Identity(), b = fcl::Transform3d::Identity();
};

/// Every policy's answers at every pose, against the oracle's.
void expectTrueAnswers(const Mesh& a, const Mesh& b, const std::vector<Pose>& poses) {
  const scenes::MeshOracle oracle(a, b);
  double coordinates = 0;
  for (const Mesh* mesh : {&a, &b}) {
    for (const auto& p : mesh->vertices) coordinates = std::max(coordinates, p.stableNorm());
  }
  std::vector<double> distances;
  std::vector<bool> contacts;
  for (const Pose& pose : poses) {
    distances.push_back(oracle.distance(pose.a, pose.b));
    contacts.push_back(oracle.collide(pose.a, pose.b));
  }
  const Split split_a = splitOf(a), split_b = splitOf(b);
  forEachPolicy([&](const std::string& name, const auto& policy) {
    const auto tree_a = treeOf(split_a, policy), tree_b = treeOf(split_b, policy);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RelativePose<double> X(poses[i].a, poses[i].b);
      const double shift = (poses[i].b.translation() - poses[i].a.translation()).stableNorm();
      const double tolerance = 64 * std::numeric_limits<double>::epsilon() * (coordinates + shift);
      const VariantResult d = tree_a.distance(tree_b, X);
      ASSERT_NEAR(d.distance, distances[i], tolerance) << name << ", pose " << i;
      ASSERT_EQ(d.contact, d.distance == 0) << name;
      // The triangles that it names realise it, as X moves them.
      TriangleVertices<double> moved_b = split_b->corners(d.triangle_b);
      for (auto& p : moved_b) p = X * p;
      ASSERT_EQ(triangleDistance(split_a->corners(d.triangle_a), moved_b).distance, d.distance);
      const VariantResult c = tree_a.collide(tree_b, X);
      ASSERT_EQ(c.contact, contacts[i]) << name << ", pose " << i;
      ASSERT_EQ(c.distance == 0, c.contact) << name;
      ASSERT_EQ(c.triangle_a >= 0, c.contact) << name;
    }
  });
}

std::vector<Pose> randomPoses(Random& random, int n, double size, double origin) {
  std::vector<Pose> poses(n);
  for (Pose& pose : poses) {
    pose.a.linear() = randomRotation(random);
    pose.b.linear() = randomRotation(random);
    const fcl::Vector3d base = origin * randomDirection(random);
    pose.a.translation() = base;
    pose.b.translation() = base + size * random.uniform(0, 3) * randomDirection(random);
  }
  return poses;
}

TEST(VariantTree, SmallMeshesAtRandomPoses) {
  Random random(1);
  const Mesh torus = scenes::bumpyTorus(200), ball = scenes::icosphere(0.7, 1);
  expectTrueAnswers(torus, ball, randomPoses(random, 8, 1, 0));
  expectTrueAnswers(torus, torus, randomPoses(random, 8, 1, 0));
}

TEST(VariantTree, FarFromTheirOriginsAndAtAnyScale) {
  Random random(3);
  const Mesh torus = scenes::bumpyTorus(100), ball = scenes::icosphere(0.7, 0);
  for (const double scale : {1e-140, 1e-30, 1.0, 1e30, 1e140}) {
    std::vector<Pose> poses = randomPoses(random, 3, scale, 0);
    const Mesh a = moved(torus, scale, scale * fcl::Vector3d(1e5, 0, 0));
    const Mesh b = moved(ball, scale, scale * fcl::Vector3d(0, -1e3, 1));
    for (Pose& pose : poses) {  // so that they are near each other nevertheless
      pose.b.translation() -= pose.b.linear() * (scale * fcl::Vector3d(0, -1e3, 1));
      pose.a.translation() -= pose.a.linear() * (scale * fcl::Vector3d(1e5, 0, 0));
    }
    expectTrueAnswers(a, b, poses);
  }
  // One of them is tiny, one far.
  expectTrueAnswers(torus, moved(ball, 1e-9, {1, 1, 1}), randomPoses(random, 3, 1, 0));
  expectTrueAnswers(torus, moved(ball, 1, {0, 0, 1e9}), randomPoses(random, 3, 1e9, 0));
}

}  // namespace
}  // namespace kios::testing
