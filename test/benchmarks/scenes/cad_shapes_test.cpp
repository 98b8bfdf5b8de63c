// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/cad_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "benchmarks/scenes/mesh_checks.h"
#include "scenes/shapes.h"

namespace kios::scenes {
namespace {

TEST(CadShapes, ClosedAndWoundOutward) {
  for (const Mesh& mesh : {stripCylinder(100, 0.6, 0.005), flangedCylinder(0.05, 0.2, 48),
                           boredBlock({0.2, 0.1, 0.08}, 0.01, 0.005, 0.03, 32)}) {
    expectClosed(mesh);
  }
}

TEST(CadShapes, StripsHaveTheirWidthAndLength) {
  const Mesh mesh = stripCylinder(400, 0.6, 0.001);
  EXPECT_EQ(mesh.triangles.size(), 1600u);
  EXPECT_NEAR((mesh.vertices[0] - mesh.vertices[1]).norm(), 0.001, 1e-12);
  EXPECT_NEAR((mesh.vertices[0] - mesh.vertices[400]).norm(), 0.6, 1e-12);
}

TEST(CadShapes, VolumesAndCounts) {
  EXPECT_NEAR(signedVolume(turnedPart({{0, 0}, {2, 0}, {2, 3}, {0, 3}}, 500)), 12 * kPi, 2e-3);
  const Mesh block = boredBlock({2, 3, 4}, 1e-4, 1e-4, 0.5, 400);
  EXPECT_EQ(block.triangles.size(), 4800u);
  EXPECT_NEAR(signedVolume(block), 24 - kPi, 2e-3);
}

TEST(CadShapes, RefusesWhatItCannotBuild) {
  EXPECT_THROW(turnedPart({{1, 0}, {1, 1}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(turnedPart({{0, 0}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(boredBlock({1, 1, 1}, 0.1, 0.1, 0.1, 10), std::invalid_argument);
}

TEST(CadShapes, WeldedUndoesSoup) {
  const Mesh shared = icosphere(1, 2);
  const Mesh again = welded(soup(shared));
  ASSERT_EQ(again.vertices.size(), shared.vertices.size());
  ASSERT_EQ(again.triangles.size(), shared.triangles.size());
  expectClosed(again);
}

TEST(CadShapes, MergedKeepsPartsAndMovedMovesThem) {
  const Mesh part = icosphere(1, 0);
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.translation().x() = 5;
  const Mesh both = merged({part, moved(X, part)});
  EXPECT_EQ(both.vertices.size(), 2 * part.vertices.size());
  EXPECT_EQ(both.triangles.size(), 2 * part.triangles.size());
  EXPECT_NEAR(signedVolume(both), 2 * signedVolume(part), 1e-12);
  EXPECT_EQ(both.vertices[12].x(), part.vertices[0].x() + 5);
}

}  // namespace
}  // namespace kios::scenes
