// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fcl/math/bv/OBBRSS.h>

#include "benchmarks/scenes/mesh_checks.h"
#include "scenes/cad_parts.h"
#include "scenes/cad_shapes.h"

namespace kios::scenes {
namespace {

TEST(Shapes, ClosedAndWoundOutward) {
  std::vector<Mesh> meshes = {knobbyTorus(),
                              bentTorus(),
                              bumpyBlob(),
                              bumpyTorus(1000),
                              subdividedBox({1, 2, 3}, 4),
                              icosphere(1, 2),
                              uvSphere(1, 5, 7),
                              stripCylinder(100, 0.6, 0.005),
                              flangedCylinder(0.05, 0.2, 48),
                              boredBlock({0.2, 0.1, 0.08}, 0.01, 0.005, 0.03, 32)};
  for (const Mesh& part : cadParts()) {
    meshes.push_back(part);
    EXPECT_GE(part.triangles.size(), 800u);
    EXPECT_LE(part.triangles.size(), 6000u);
    EXPECT_GE(extent(part), 0.04);
    EXPECT_LE(extent(part), 0.4);
  }
  for (const Mesh& mesh : meshes) expectClosed(mesh);
}

TEST(Shapes, TriangleCounts) {
  EXPECT_EQ(knobbyTorus().triangles.size(), 3240u);
  EXPECT_EQ(bentTorus().triangles.size(), 1332u);
  EXPECT_EQ(bumpyBlob().triangles.size(), 2204u);
  EXPECT_EQ(subdividedBox({1, 1, 1}, 5).triangles.size(), 300u);
  EXPECT_EQ(icosphere(1, 3).triangles.size(), 1280u);
  EXPECT_EQ(uvSphere(1, 6, 9).triangles.size(), 90u);
  EXPECT_EQ(sheet(1, 1, 3, 4, 0).triangles.size(), 24u);
  for (const int n : {100, 333, 1000, 5000, 20000, 80000, 1000000}) {
    EXPECT_NEAR(static_cast<double>(bumpyTorus(n).triangles.size()), n, 0.01 * n);
  }
}

TEST(Shapes, Volumes) {
  EXPECT_NEAR(signedVolume(subdividedBox({1, 2, 3}, 4)), 6, 1e-12);
  EXPECT_NEAR(signedVolume(icosphere(2, 5)), 32 * kPi / 3, 0.05);
  EXPECT_NEAR(signedVolume(turnedPart({{0, 0}, {2, 0}, {2, 3}, {0, 3}}, 500)), 12 * kPi, 2e-3);
  EXPECT_NEAR(signedVolume(boredBlock({2, 3, 4}, 1e-4, 1e-4, 0.5, 400)), 24 - kPi, 2e-3);
  EXPECT_NEAR(signedVolume(tube(1, 2, 3, 600)), 9 * kPi, 1e-3);
  EXPECT_NEAR(signedVolume(filletedBar(2, 3, 5, 0.5, 200)), 5 * (6 - (1 - kPi / 4)), 1e-3);
  EXPECT_NEAR(signedVolume(drilledPlate(3, 2, 1, 0.25, 0.1, 400)), 0.1 * (6 - 6 * kPi * 0.0625),
              1e-4);
  // Between the roots' and the tips' circles, and between the core and the outer thread.
  const double gear = signedVolume(spurGear(20, 0.1, 1, 0.3, 40));
  EXPECT_GT(gear, kPi * (0.875 * 0.875 - 0.09) * 0.98);
  EXPECT_LT(gear, kPi * (1.1 * 1.1 - 0.09));
  const double head = 0.7 * 1.5 * std::sqrt(3.0) * 1.8 * 1.8;
  const double thread = signedVolume(screw(1, 0.3, 10, 120)) - head;
  EXPECT_GT(thread, 3 * kPi * 0.85 * 0.85 * 0.99);
  EXPECT_LT(thread, 3 * kPi);
}

TEST(Shapes, TrianglesAreAsLongAsCadKernelsMakeThem) {
  const auto worstAspect = [](const Mesh& mesh) {
    double worst = 0;
    for (const fcl::Triangle& t : mesh.triangles) {
      double longest = 0;
      for (int i = 0; i < 3; ++i) {
        longest = std::max(longest, (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]]).norm());
      }
      const fcl::Vector3d u = mesh.vertices[t[1]] - mesh.vertices[t[0]],
                          v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
      worst = std::max(worst, longest * longest / u.cross(v).norm());
    }
    return worst;
  };
  double worst = 0;
  for (const Mesh& mesh : cadParts()) worst = std::max(worst, worstAspect(mesh));
  EXPECT_GT(worst, 1000);
  EXPECT_LT(worst, 1e5);
}

TEST(Shapes, StripsHaveTheirWidthAndLength) {
  const Mesh mesh = stripCylinder(400, 0.6, 0.001);
  EXPECT_EQ(mesh.triangles.size(), 1600u);
  EXPECT_NEAR((mesh.vertices[0] - mesh.vertices[1]).norm(), 0.001, 1e-12);
  EXPECT_NEAR((mesh.vertices[0] - mesh.vertices[400]).norm(), 0.6, 1e-12);
}

TEST(Shapes, RefuseWhatTheyCannotBuild) {
  EXPECT_THROW(spurGear(10, 0.1, 1, 0.5, 20), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.6, 0.1, 8), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.2, 0.1, 10), std::invalid_argument);
  EXPECT_THROW(turnedPart({{1, 0}, {1, 1}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(turnedPart({{0, 0}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(boredBlock({1, 1, 1}, 0.1, 0.1, 0.1, 10), std::invalid_argument);
  EXPECT_THROW(buildModel<fcl::OBBRSSd>(Mesh{}), std::runtime_error);
}

TEST(Shapes, WeldedUndoesSoup) {
  const Mesh shared = icosphere(1, 2), apart = soup(shared), again = welded(apart);
  ASSERT_EQ(apart.vertices.size(), 3 * shared.triangles.size());
  ASSERT_EQ(again.vertices.size(), shared.vertices.size());
  ASSERT_EQ(again.triangles.size(), shared.triangles.size());
  expectClosed(again);
}

TEST(Shapes, MergedKeepsPartsAndMovedMovesThem) {
  const Mesh part = icosphere(1, 0);
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.translation().x() = 5;
  const Mesh both = merged({part, moved(X, part)});
  EXPECT_EQ(both.vertices.size(), 2 * part.vertices.size());
  EXPECT_EQ(both.triangles.size(), 2 * part.triangles.size());
  EXPECT_NEAR(signedVolume(both), 2 * signedVolume(part), 1e-12);
  EXPECT_EQ(both.vertices[12].x(), part.vertices[0].x() + 5);
}

TEST(Shapes, RandomSoupIsSeededAndWithinItsEdgeLengths) {
  const Mesh mesh = randomSoup(200, 1, 1e-2, 10, 5);
  const Mesh again = randomSoup(200, 1, 1e-2, 10, 5);
  EXPECT_EQ(mesh.vertices, again.vertices);
  EXPECT_NE(mesh.vertices, randomSoup(200, 1, 1e-2, 10, 6).vertices);
  for (const fcl::Triangle& t : mesh.triangles) {
    for (int i = 1; i < 3; ++i) {
      const double length = (mesh.vertices[t[i]] - mesh.vertices[t[0]]).norm();
      EXPECT_GE(length, 0.99e-2);
      EXPECT_LE(length, 10.01);
    }
  }
}

TEST(Shapes, ShrunkSoupMovesVerticesByItsFactors) {
  const Mesh mesh = knobbyTorus();
  const Mesh shrunk = shrunkSoup(mesh, 1e-6, 1e-3, 3);
  ASSERT_EQ(shrunk.triangles.size(), mesh.triangles.size());
  ASSERT_EQ(shrunk.vertices.size(), 3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const fcl::Triangle& from = mesh.triangles[t];
    const fcl::Triangle& to = shrunk.triangles[t];
    const double before = (mesh.vertices[from[0]] - mesh.vertices[from[1]]).norm();
    const double after = (shrunk.vertices[to[0]] - shrunk.vertices[to[1]]).norm();
    EXPECT_GE(1 - after / before, 0.99e-6);
    EXPECT_LE(1 - after / before, 1.01e-3);
  }
  EXPECT_EQ(shrunk.vertices, shrunkSoup(mesh, 1e-6, 1e-3, 3).vertices);
  EXPECT_NE(shrunk.vertices, shrunkSoup(mesh, 1e-6, 1e-3, 4).vertices);
}

}  // namespace
}  // namespace kios::scenes
