// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance of two float meshes, and FCL's recursion over their nodes, against
// the oracle in long double, before and after refits.

#include <gtest/gtest.h>

#include <algorithm>

#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include "model/bvh_check.h"
#include "model/deform.h"

namespace kios::testing {
namespace {

/// Returns the mesh and the poses with coordinates that floats hold.
Mesh inFloats(Mesh mesh) {
  for (Vector3d& p : mesh.vertices) p = p.cast<float>().cast<double>();
  return mesh;
}

Frame inFloats(const Frame& f) {
  return {f.X_WA.cast<float>().cast<double>(), f.X_WB.cast<float>().cast<double>()};
}

std::vector<Frame> floatFrames(int count, double spread, std::uint64_t seed) {
  std::vector<Frame> frames = randomFrames(count, spread, seed);
  for (Frame& f : frames) f = inFloats(f);
  return frames;
}

/// The tolerance for answers about objects of extent `size` about the origin.
double tolerance(double size) { return 128 * 0x1p-23 * size; }

/// Holds a pair of float models, and the oracle over their vertices.
struct FloatPair {
  FloatPair(const Mesh& mesh_a_, const Mesh& mesh_b_)
      : mesh_a(inFloats(mesh_a_)),
        mesh_b(inFloats(mesh_b_)),
        a(scenes::buildModel<kIOSf>(mesh_a)),
        b(scenes::buildModel<kIOSf>(mesh_b)),
        oracle(mesh_a, mesh_b) {}

  fcl::CollisionResultf collide(const Frame& f, std::size_t contacts, bool by_nodes) const {
    const fcl::Transform3f X_WA = f.X_WA.cast<float>(), X_WB = f.X_WB.cast<float>();
    const fcl::CollisionRequestf request(contacts);
    fcl::CollisionResultf result;
    MeshCollisionTraversalNodef node;
    if (!by_nodes) {
      fcl::collide(a.get(), X_WA, b.get(), X_WB, request, result);
    } else if (initialize(node, *a, X_WA, *b, X_WB, request, result)) {
      fcl::detail::collide<float>(&node);
    }
    return result;
  }
  fcl::DistanceResultf distance(const Frame& f, bool by_nodes,
                                float at_most = std::numeric_limits<float>::max()) const {
    const fcl::Transform3f X_WA = f.X_WA.cast<float>(), X_WB = f.X_WB.cast<float>();
    const fcl::DistanceRequestf request(true);
    fcl::DistanceResultf result(at_most);
    MeshDistanceTraversalNodef node;
    if (!by_nodes) {
      fcl::distance(a.get(), X_WA, b.get(), X_WB, request, result);
    } else if (initialize(node, *a, X_WA, *b, X_WB, request, result)) {
      fcl::detail::distance<float>(&node);
    }
    return result;
  }

  Mesh mesh_a, mesh_b;
  std::shared_ptr<Modelf> a, b;
  scenes::MeshOracle oracle;
};

// The pairs that meet wherever B is moved by `tol`, and the pairs that meet somewhere there.
struct Bracket {
  Pairs surely, possibly;
};
Bracket bracket(const scenes::MeshOracle& oracle, const Frame& frame, double tol) {
  Bracket found;
  found.surely = found.possibly = oracle.collidingPairs(frame.X_WA, frame.X_WB);
  for (int way = 0; way < 6; ++way) {
    Frame moved = frame;
    moved.X_WB.translation()[way / 2] += way % 2 == 0 ? tol : -tol;
    const Pairs pairs = oracle.collidingPairs(moved.X_WA, moved.X_WB);
    Pairs both, any;
    std::set_intersection(found.surely.begin(), found.surely.end(), pairs.begin(), pairs.end(),
                          std::back_inserter(both));
    std::set_union(found.possibly.begin(), found.possibly.end(), pairs.begin(), pairs.end(),
                   std::back_inserter(any));
    found.surely.swap(both);
    found.possibly.swap(any);
  }
  return found;
}

bool within(const Pairs& part, const Pairs& whole) {
  return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

void expectRight(const FloatPair& pair, const std::vector<Frame>& frames) {
  const double size = sizeOf(pair.mesh_a, pair.mesh_b);
  for (const Frame& frame : frames) {
    const double tol =
        tolerance(size + frame.X_WA.translation().norm() + frame.X_WB.translation().norm());
    const Bracket truth = bracket(pair.oracle, frame, 8 * tol);
    const double exact = pair.oracle.distance(frame.X_WA, frame.X_WB);
    for (const bool by_nodes : {false, true}) {
      const bool hit = pair.collide(frame, 1, by_nodes).isCollision();
      EXPECT_TRUE(hit ? !truth.possibly.empty() : truth.surely.empty());
      const Pairs pairs = contactPairs(pair.collide(frame, kAllContacts, by_nodes));
      EXPECT_TRUE(within(truth.surely, pairs) && within(pairs, truth.possibly));

      const auto near = pair.distance(frame, by_nodes);
      EXPECT_NEAR(near.min_distance, exact, tol);
      if (exact <= tol) continue;
      const Vector3d p = near.nearest_points[0].cast<double>();
      const Vector3d q = near.nearest_points[1].cast<double>();
      EXPECT_NEAR((p - q).norm(), exact, tol);
      EXPECT_LE(distanceToTriangle(p, frame.X_WA, pair.mesh_a, near.b1), tol);
      EXPECT_LE(distanceToTriangle(q, frame.X_WB, pair.mesh_b, near.b2), tol);
      const auto below = static_cast<float>(0.5 * exact), above = static_cast<float>(2 * exact);
      EXPECT_EQ(pair.distance(frame, by_nodes, below).min_distance, below);
      EXPECT_NEAR(pair.distance(frame, by_nodes, above).min_distance, exact, tol);
    }
  }
}

TEST(FloatMeshes, GeneralPosition) {
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    expectRight(FloatPair(c.a, c.b), floatFrames(30, c.spread, 301));
  }
}

// After FCL's refits, in both directions, and a rebuild.
TEST(FloatMeshes, DeformingModels) {
  FloatPair pair(scenes::bumpyTorus(200), scenes::icosphere(0.7, 1));
  const Mesh original = pair.mesh_a;
  const auto frames = floatFrames(8, 1.2, 305);
  for (int step = 0; step < 6; ++step) {
    SCOPED_TRACE(step);
    pair.mesh_a = inFloats({swayed(original, 0.7 * step), original.triangles});
    pair.oracle = scenes::MeshOracle(pair.mesh_a, pair.mesh_b);
    std::vector<fcl::Vector3f> vertices;
    for (const Vector3d& p : pair.mesh_a.vertices) vertices.push_back(p.cast<float>());
    pair.a->beginReplaceModel();
    pair.a->replaceSubModel(vertices);
    pair.a->endReplaceModel(step % 3 != 2, step % 3 == 0);
    expectValidTree(*pair.a);
    expectRight(pair, frames);
  }
}

}  // namespace
}  // namespace kios::testing
