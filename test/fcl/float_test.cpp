// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance of two float meshes against the oracle in long double: the cases
// that collide_test, distance_test, request_test and model/refit_test ask in double.

#include <gtest/gtest.h>

#include <algorithm>

#include "fcl/mesh_cases.h"
#include "model/deform.h"
#include "scenes/random.h"

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

  fcl::CollisionResultf collide(const Frame& f, std::size_t contacts) const {
    fcl::CollisionResultf result;
    const fcl::CollisionRequestf request(contacts);
    fcl::collide(a.get(), f.X_WA.cast<float>(), b.get(), f.X_WB.cast<float>(), request, result);
    return result;
  }
  fcl::DistanceResultf distance(const Frame& f,
                                float at_most = std::numeric_limits<float>::max()) const {
    fcl::DistanceResultf result(at_most);
    const fcl::DistanceRequestf request(true);
    fcl::distance(a.get(), f.X_WA.cast<float>(), b.get(), f.X_WB.cast<float>(), request, result);
    return result;
  }
  double exact(const Frame& f) const { return oracle.distance(f.X_WA, f.X_WB); }

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
    const double exact = pair.exact(frame);
    const bool hit = pair.collide(frame, 1).isCollision();
    EXPECT_TRUE(hit ? !truth.possibly.empty() : truth.surely.empty());
    const Pairs pairs = contactPairs(pair.collide(frame, kAllContacts));
    EXPECT_TRUE(within(truth.surely, pairs) && within(pairs, truth.possibly));

    const auto near = pair.distance(frame);
    EXPECT_NEAR(near.min_distance, exact, tol);
    if (exact <= tol) continue;
    const Vector3d p = near.nearest_points[0].cast<double>();
    const Vector3d q = near.nearest_points[1].cast<double>();
    EXPECT_NEAR((p - q).norm(), exact, tol);
    EXPECT_LE(distanceToTriangle(p, frame.X_WA, pair.mesh_a, near.b1), tol);
    EXPECT_LE(distanceToTriangle(q, frame.X_WB, pair.mesh_b, near.b2), tol);
    const auto below = static_cast<float>(0.5 * exact), above = static_cast<float>(2 * exact);
    EXPECT_EQ(pair.distance(frame, below).min_distance, below);
    EXPECT_NEAR(pair.distance(frame, above).min_distance, exact, tol);
  }
}

TEST(FloatMeshes, GeneralPosition) {
  for (const MeshCase& c : meshCases()) {
    SCOPED_TRACE(c.name);
    expectRight(FloatPair(c.a, c.b), floatFrames(30, c.spread, 301));
  }
}

// Segments, points and slivers among the triangles.
TEST(FloatMeshes, DegenerateTriangles) {
  scenes::Random random(302);
  const auto flatten = [&](Mesh mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vector3d* p = &mesh.vertices[mesh.triangles[i][0]];  // a soup's corners stand together
      if (i % 3 == 0) p[2] = p[0] + random.unit() * (p[1] - p[0]);
      if (i % 3 == 1) p[2] = p[0] + random.unit() * (p[1] - p[0]) + Vector3d::Constant(1e-9);
      if (i % 9 == 2) p[1] = p[2] = p[0];
    }
    return mesh;
  };
  for (int i = 0; i < 4; ++i) {
    expectRight(FloatPair(flatten(scenes::randomSoup(40, 0.4, 0.1, 1, 303 + i)),
                          flatten(scenes::randomSoup(40, 0.4, 0.1, 1, 313 + i))),
                floatFrames(25, 1.2, 304));
  }
}

// Boxes of dyadic size that share a face, an edge or a corner, or miss by 2^-10.
TEST(FloatMeshes, Touching) {
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 2);
  const FloatPair pair(box, box);
  for (int x = 0; x <= 1; ++x) {
    for (int y = 0; y <= 1; ++y) {
      for (const double gap : {0.0, 0x1p-10}) {
        for (const double shift : {0.0, 0.125, 0.3125}) {
          Frame frame{Transform3d::Identity(), Transform3d::Identity()};
          frame.X_WB.translation() = Vector3d(1 + gap, y ? 1 + gap : shift, x ? 1 + gap : shift);
          const double exact = pair.exact(frame);
          EXPECT_EQ(pair.collide(frame, 1).isCollision(), exact == 0);
          const float d = pair.distance(frame).min_distance;
          EXPECT_NEAR(d, exact, tolerance(2));
          EXPECT_EQ(d == 0, exact == 0);
        }
      }
    }
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
    expectRight(pair, frames);
  }
}

// One result for many queries keeps the nearest answer so far, and its points where they were.
TEST(FloatMeshes, ReusedResult) {
  const FloatPair pair(scenes::bumpyTorus(120), scenes::icosphere(0.4, 1));
  fcl::DistanceResultf result;
  fcl::Vector3f before = fcl::Vector3f::Zero();
  float least = std::numeric_limits<float>::max();
  int kept = 0;
  for (const Frame& frame : floatFrames(400, 4, 306)) {
    if (least < 0.05) {
      result.clear();
      least = std::numeric_limits<float>::max();
    }
    fcl::distance(pair.a.get(), frame.X_WA.cast<float>(), pair.b.get(), frame.X_WB.cast<float>(),
                  fcl::DistanceRequestf(true), result);
    if (result.min_distance == least) {
      EXPECT_EQ(result.nearest_points[0], before);
      ++kept;
    }
    least = result.min_distance;
    before = result.nearest_points[0];
  }
  EXPECT_GT(kept, 100);
}

// Far from the world's origin together: the offset is common to both and costs nothing.
TEST(FloatMeshes, CommonOffset) {
  const FloatPair pair(scenes::bumpyTorus(150), scenes::bumpyTorus(150));
  for (Frame frame : floatFrames(40, 2, 307)) {
    frame.X_WA.translation() += Vector3d::Constant(0x1p10);
    frame.X_WB.translation() += Vector3d::Constant(0x1p10);
    frame = inFloats(frame);
    const double exact = pair.exact(frame);
    EXPECT_NEAR(pair.distance(frame).min_distance, exact, tolerance(8));
    if (exact > tolerance(8)) {
      EXPECT_FALSE(pair.collide(frame, 1).isCollision());
    }
  }
}

}  // namespace
}  // namespace kios::testing
