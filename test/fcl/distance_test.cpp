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

ReturnedDistance query(const Modeld& a, const Modeld& b, const Frame& frame) {
  const fcl::DistanceRequestd request(true);
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

TEST(Distance, ObjectsGeometriesAndSolversAgreeBitwise) {
  const MeshCase pair = meshCases().front();
  const auto model_a = kiosModel(pair.a), model_b = kiosModel(pair.b);
  for (const Frame& frame : randomFrames(40, 2 * pair.spread, 14)) {
    const fcl::CollisionObjectd a(model_a, frame.X_WA), b(model_b, frame.X_WB);
    fcl::DistanceRequestd request(true);
    request.gjk_solver_type = fcl::GST_INDEP;
    fcl::DistanceResultd result;
    const ReturnedDistance expected = query(*model_a, *model_b, frame);
    EXPECT_EQ(fcl::distance(&a, &b, request, result), expected.returned);
    EXPECT_EQ(result.min_distance, expected.result.min_distance);
    EXPECT_EQ(result.b1, expected.result.b1);
    EXPECT_EQ(result.b2, expected.result.b2);
    if (expected.returned == 0) continue;
    EXPECT_EQ(result.nearest_points[0], expected.result.nearest_points[0]);
    EXPECT_EQ(result.nearest_points[1], expected.result.nearest_points[1]);
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

}  // namespace
}  // namespace kios::testing
