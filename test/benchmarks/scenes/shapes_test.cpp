// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include <fcl/math/bv/OBBRSS.h>

#include "benchmarks/scenes/mesh_checks.h"

namespace kios::scenes {
namespace {

TEST(Shapes, ClosedAndWoundOutward) {
  for (const Mesh& mesh : {knobbyTorus(), bentTorus(), bumpyBlob(), bumpyTorus(1000),
                           subdividedBox({1, 2, 3}, 4), icosphere(1, 2), uvSphere(1, 5, 7)}) {
    expectClosed(mesh);
  }
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
  EXPECT_NEAR(signedVolume(icosphere(2, 5)), 32 * std::acos(-1.0) / 3, 0.05);
}

TEST(Shapes, SoupHasTheSameTriangles) {
  const Mesh shared = icosphere(1, 1);
  const Mesh unshared = soup(shared);
  ASSERT_EQ(unshared.vertices.size(), 3 * shared.triangles.size());
  for (std::size_t t = 0; t < shared.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(unshared.vertices[unshared.triangles[t][i]],
                shared.vertices[shared.triangles[t][i]]);
    }
  }
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

TEST(Shapes, ModelHasAllTrianglesAndAnEmptyMeshIsRefused) {
  EXPECT_EQ(buildModel<fcl::OBBRSSd>(icosphere(1, 1))->num_tris, 80);
  EXPECT_THROW(buildModel<fcl::OBBRSSd>(Mesh{}), std::runtime_error);
}

}  // namespace
}  // namespace kios::scenes
