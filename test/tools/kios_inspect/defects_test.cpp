// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "defects.h"

#include <gtest/gtest.h>

#include "scenes/shapes.h"

namespace kios::inspect {
namespace {

Mesh meshOf(const scenes::Mesh& mesh) {
  Mesh result;
  result.vertices = mesh.vertices;
  result.triangles = mesh.triangles;
  return result;
}

TEST(Defects, NoneInACleanMesh) {
  const scenes::Mesh torus = scenes::knobbyTorus();
  for (const scenes::Mesh& shape : {torus, scenes::soup(torus)}) {
    const Mesh mesh = meshOf(shape);
    const Defects found = findDefects(mesh);
    EXPECT_TRUE(found.surface.closed);
    EXPECT_TRUE(found.surface.oriented);
    EXPECT_EQ(2 * static_cast<std::size_t>(found.surface.edges), 3 * mesh.triangles.size());
    EXPECT_EQ(found.distinct_vertices, torus.vertices.size());
    EXPECT_TRUE(warnings(mesh, found).empty());
  }
}

TEST(Defects, EachKindIsCountedOnce) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},      {3, 0, 0}, {-0.0, 0, 0},
                     {0, 0, 5}, {1, 0, 5}, {0.5, 1e-5, 5}, {9, 9, 9}, {0, 0, 1}};
    for (fcl::Vector3d& v : mesh.vertices) v *= scale;
    mesh.triangles = {{0, 1, 2}, {0, 1, 3},  // a line
                      {1, 1, 2},             // two corners are one
                      {5, 6, 7},             // a sliver
                      {2, 4, 1},             // the first one again, turned over, by -0
                      {0, 1, 9}};            // a third triangle at the edge 0, 1
    const Defects found = findDefects(mesh);
    EXPECT_EQ(found.zero_area, 2u);
    EXPECT_EQ(found.first_zero_area, 1u);
    EXPECT_EQ(found.slivers, 1u);
    EXPECT_EQ(found.first_sliver, 3u);
    EXPECT_EQ(found.duplicates, 1u);
    EXPECT_EQ(found.first_duplicate, 4u);
    EXPECT_EQ(found.unreferenced, 1u);
    EXPECT_EQ(found.distinct_vertices, 8u);
    EXPECT_EQ(found.surface.branching_edges, 2);  // 0-1, and 1-2 by the one with two equal corners
    EXPECT_FALSE(found.surface.closed);
    EXPECT_EQ(warnings(mesh, found).size(), 5u);
  }
}

}  // namespace
}  // namespace kios::inspect
