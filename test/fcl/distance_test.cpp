// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::distance of two meshes over k-IOS against the oracle.

#include <gtest/gtest.h>

#include <cmath>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

constexpr double kTolerance = 1e-12;  // of the size

struct ReturnedDistance {
  double returned;
  fcl::DistanceResultd result;
};

ReturnedDistance query(const Modeld& a, const Modeld& b, const Frame& frame,
                       fcl::GJKSolverType solver = fcl::GST_LIBCCD) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  ReturnedDistance answer;
  answer.returned = fcl::distance(&a, frame.X_WA, &b, frame.X_WB, request, answer.result);
  return answer;
}

// |p0 - p1| is the distance, and each point lies on the triangle that the result names.
void expectWitness(const ReturnedDistance& answer, const Mesh& a, const Mesh& b, const Frame& frame,
                   const Modeld* model_a, const Modeld* model_b, double tolerance) {
  const fcl::DistanceResultd& result = answer.result;
  EXPECT_EQ(result.o1, model_a);
  EXPECT_EQ(result.o2, model_b);
  ASSERT_GE(result.b1, 0);
  ASSERT_LT(result.b1, model_a->num_tris);
  ASSERT_GE(result.b2, 0);
  ASSERT_LT(result.b2, model_b->num_tris);
  const Vector3d &p0 = result.nearest_points[0], &p1 = result.nearest_points[1];
  EXPECT_NEAR((p0 - p1).norm(), result.min_distance, tolerance);
  EXPECT_LE(distanceToTriangle(p0, frame.X_WA, a, result.b1), tolerance);
  EXPECT_LE(distanceToTriangle(p1, frame.X_WB, b, result.b2), tolerance);
}

void expectAgreesWithOracle(const MeshCase& pair, const std::vector<Frame>& frames,
                            double world_size) {
  SCOPED_TRACE(pair.name);
  const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
  const scenes::MeshOracle oracle(pair.a, pair.b);
  const double size = sizeOf(pair.a, pair.b);
  const double witness_tolerance = kTolerance * size + 1e-15 * world_size;
  int apart = 0;
  for (const Frame& frame : frames) {
    const double exact = oracle.distance(frame.X_WA, frame.X_WB);
    apart += exact > 0;
    const ReturnedDistance ab = query(*model_a, *model_b, frame);
    EXPECT_EQ(ab.returned, ab.result.min_distance);
    EXPECT_NEAR(ab.returned, exact, kTolerance * size);
    EXPECT_EQ(ab.returned == 0, exact == 0);
    expectWitness(ab, pair.a, pair.b, frame, model_a.get(), model_b.get(), witness_tolerance);

    const Frame swapped{frame.X_WB, frame.X_WA};
    const ReturnedDistance ba = query(*model_b, *model_a, swapped);
    EXPECT_NEAR(ba.returned, exact, kTolerance * size);
    EXPECT_EQ(ba.returned == 0, exact == 0);
    expectWitness(ba, pair.b, pair.a, swapped, model_b.get(), model_a.get(), witness_tolerance);
  }
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, static_cast<int>(frames.size()));
}

TEST(Distance, AgreesWithTheOracleInBothOrders) {
  for (const MeshCase& pair : meshCases()) {
    expectAgreesWithOracle(pair, randomFrames(120, pair.spread, 11), 10);
  }
}

// The distance does not feel where the world's origin is; the points are rounded there.
TEST(Distance, AgreesWithTheOracleFarFromTheWorldsOrigin) {
  const Vector3d offset(0x1p30, -0x1p29, 0x1p28);
  for (const MeshCase& pair : meshCases()) {
    expectAgreesWithOracle(pair, randomFrames(60, pair.spread, 12, offset), 0x1p32);
  }
}

TEST(Distance, NestedMeshesDoNotMeet) {
  const Mesh inner = scenes::icosphere(0.3, 2), outer = scenes::icosphere(2, 2);
  const auto model_inner = kiosModel(inner), model_outer = kiosModel(outer);
  const scenes::MeshOracle oracle(inner, outer);
  for (const Frame& frame : randomFrames(20, 0.3, 13)) {
    const double exact = oracle.distance(frame.X_WA, frame.X_WB);
    ASSERT_GT(exact, 0.5);
    const ReturnedDistance answer = query(*model_inner, *model_outer, frame);
    EXPECT_NEAR(answer.returned, exact, 1e-12);
    expectWitness(answer, inner, outer, frame, model_inner.get(), model_outer.get(), 1e-12);
  }
}

TEST(Distance, ObjectsGeometriesAndSolversAgreeBitwise) {
  const MeshCase pair = meshCases().front();
  const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
  fcl::CollisionObjectd object_a(model_a), object_b(model_b);
  for (const Frame& frame : randomFrames(40, 2 * pair.spread, 14)) {
    object_a.setTransform(frame.X_WA);
    object_b.setTransform(frame.X_WB);
    const ReturnedDistance expected = query(*model_a, *model_b, frame);
    for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
      const ReturnedDistance again = query(*model_a, *model_b, frame, solver);
      fcl::DistanceRequestd request(true);
      request.gjk_solver_type = solver;
      fcl::DistanceResultd result;
      const double returned = fcl::distance(&object_a, &object_b, request, result);
      const ReturnedDistance objects{returned, result};
      for (const ReturnedDistance* answer : {&again, &objects}) {
        EXPECT_EQ(answer->returned, expected.returned);
        EXPECT_EQ(answer->result.min_distance, expected.result.min_distance);
        EXPECT_EQ(answer->result.b1, expected.result.b1);
        EXPECT_EQ(answer->result.b2, expected.result.b2);
        if (expected.returned == 0) continue;
        EXPECT_EQ(answer->result.nearest_points[0], expected.result.nearest_points[0]);
        EXPECT_EQ(answer->result.nearest_points[1], expected.result.nearest_points[1]);
      }
    }
  }
}

TEST(Distance, PointsAreLeftAloneUnlessAskedFor) {
  const MeshCase pair = meshCases().front();
  const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
  Frame frame{Transform3d::Identity(), Transform3d::Identity()};
  frame.X_WB.translation() = Vector3d(9, 0, 0);
  fcl::DistanceResultd result;
  const Vector3d mark(1, 2, 3);
  result.nearest_points[0] = result.nearest_points[1] = mark;
  const double d = fcl::distance(model_a.get(), frame.X_WA, model_b.get(), frame.X_WB,
                                 fcl::DistanceRequestd(), result);
  EXPECT_EQ(d, query(*model_a, *model_b, frame).returned);
  EXPECT_EQ(result.nearest_points[0], mark);
  EXPECT_EQ(result.nearest_points[1], mark);
  EXPECT_EQ(result.o1, model_a.get());
  EXPECT_GE(result.b1, 0);
}

// Where rounding of the pose decides what touches, the tree must not change the verdict: the answer
// is the least that the triangle kernel gives over all pairs, but for the contract's 16 eps L.
void expectEqualsLeaf(const Mesh& a, const Mesh& b, const std::vector<Frame>& frames) {
  const auto model_a = kiosModel(a), model_b = kiosModel(b);
  for (const Frame& frame : frames) {
    const auto compare = [](double answer, double least, double extent) {
      EXPECT_NEAR(answer, least, 16 * std::numeric_limits<double>::epsilon() * extent);
      EXPECT_EQ(answer == 0, least == 0);
    };
    const double extent = scenes::extent(a) + scenes::extent(b);
    compare(query(*model_a, *model_b, frame).returned, leafDistance(a, b, frame), extent);
    const Frame swapped{frame.X_WB, frame.X_WA};
    compare(query(*model_b, *model_a, swapped).returned, leafDistance(b, a, swapped), extent);
  }
}

std::vector<Frame> touchingFrames(const std::vector<double>& shifts) {
  std::vector<Frame> frames;
  for (const Transform3d& X : scenes::randomPoses(2, 2, 15)) {
    for (const double shift : shifts) {
      Frame frame{X, X};
      frame.X_WB = X * Eigen::Translation3d(shift, shift / 4, 0);
      frames.push_back(frame);
    }
  }
  frames.push_back({Transform3d::Identity(), Transform3d::Identity()});
  return frames;
}

TEST(Distance, TouchingAndCoincidentMeshesEqualTheLeafKernel) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 2);
  expectEqualsLeaf(box, box, touchingFrames({0, 1e-9, 1, 2, 2 + 1e-12, 2.5}));
  const Mesh flat = scenes::sheet(2, 2, 5, 5, 0);
  expectEqualsLeaf(flat, flat, touchingFrames({0, 1, 2, 3}));
  expectEqualsLeaf(flat, box, touchingFrames({0, 1, 2, 3}));
  const Mesh ball = scenes::icosphere(1, 1);
  expectEqualsLeaf(ball, ball, touchingFrames({0, 1e-15, 1e-6, 0.5, 2}));
}

// Poses that round nothing: 0 if and only if the meshes touch, here along faces, edges, corners.
TEST(Distance, TouchingOnALatticeIsExact) {
  const Mesh box = scenes::subdividedBox({2, 2, 2}, 2);
  const auto model = kiosModel(box);
  const scenes::MeshOracle oracle(box, box);
  for (const double x : {0.0, 1.0, 2.0, 2 + 0x1p-20, 3.0}) {
    for (const double y : {0.0, -0.5, 2.0, 2 + 0x1p-20}) {
      for (const double z : {0.0, 0.25, -2.0}) {
        const Frame frame{Transform3d::Identity(), Transform3d(Eigen::Translation3d(x, y, z))};
        EXPECT_EQ(query(*model, *model, frame).returned, oracle.distance(frame.X_WA, frame.X_WB));
      }
    }
  }
}

TEST(Distance, TinyMeshesEqualTheLeafKernel) {
  Mesh torus = scenes::bumpyTorus(140), soup = scenes::randomSoup(60, 1, 1e-2, 1, 6);
  for (Vector3d& p : torus.vertices) p *= 1e-4;
  for (Vector3d& p : soup.vertices) p *= 1e-4;
  expectEqualsLeaf(torus, soup, randomFrames(10, 2e-4, 16));
  expectEqualsLeaf(torus, torus, randomFrames(10, 2e-4, 17));
  for (Vector3d& p : torus.vertices) p *= 1e-6;
  expectEqualsLeaf(torus, torus, randomFrames(5, 2e-10, 18));
  expectEqualsLeaf(torus, scenes::bumpyTorus(100), randomFrames(5, 1, 19));
}

}  // namespace
}  // namespace kios::testing
