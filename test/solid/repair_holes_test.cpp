// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Holes that repair() fills or leaves, and surfaces that it can't close; robots' links.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "scenes/mesh_folder.h"
#include "scenes/random.h"
#include "solid/repair_check.h"

namespace kios::testing {
namespace {

TEST(RepairHoles, FillsHolesOfTheStatedSize) {
  const Mesh ball = scenes::icosphere(1, 2);
  // All triangles round a vertex: a hole of five or six edges.
  Mesh mesh = ball;
  const std::size_t pole = ball.triangles[0][0];
  const auto gone =
      std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const auto& t) { return t[0] == pole || t[1] == pole || t[2] == pole; });
  const auto edges = static_cast<int>(mesh.triangles.end() - gone);
  mesh.triangles.erase(gone, mesh.triangles.end());
  const auto open = repaired(mesh);
  expectHonest(mesh, open);
  ASSERT_EQ(open.open.size(), 1U);
  EXPECT_EQ(static_cast<int>(open.open[0].vertices.size()), edges);
  EXPECT_EQ(open.closedness.open_edges, edges);
  EXPECT_EQ(repaired(mesh, filling(edges - 1)).open.size(), 1U);
  RepairRequest small = filling(100);
  small.max_hole_perimeter = open.open[0].perimeter * (1 - 1e-9);
  EXPECT_EQ(repaired(mesh, small).open.size(), 1U);
  small.max_hole_perimeter = open.open[0].perimeter;
  for (const RepairRequest& options : {small, filling(edges)}) {
    const auto filled = repaired(mesh, options);
    expectHonest(mesh, filled);
    EXPECT_TRUE(filled.closedness.isSolid()) << summaryOf(filled);
    EXPECT_EQ(filled.filled_triangles, edges - 2);
    EXPECT_EQ(filled.filled.size(), 1U);
    EXPECT_EQ(filled.flipped_triangles, 0);
    EXPECT_NEAR(volumeOf(filled.vertices, filled.triangles),
                volumeOf(ball.vertices, ball.triangles), 0.05 * 25);
    markSolid(*makeModel(filled.vertices, filled.triangles));
  }
}

// Holes that share a vertex, holes of all sizes, and a T-junction, which is a hole of no area.
TEST(RepairHoles, FillsManyHoles) {
  scenes::Random random(17);
  const Mesh ball = scenes::icosphere(1, 3);
  for (const double share : {0.01, 0.05, 0.2}) {
    Mesh mesh = ball;
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                        [&](const auto&) { return random.unit() < share; }),
                         mesh.triangles.end());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      fcl::Triangle& t = mesh.triangles[i];
      t.set(t[0], t[2], t[1]);
    }
    const auto r = repaired(mesh, filling(RepairRequest::kMostHoleEdges));
    expectHonest(mesh, r);
    EXPECT_TRUE(r.open.empty());
    EXPECT_EQ(r.closedness.open_edges, 0) << share << ": " << summaryOf(r);
    EXPECT_EQ(r.closedness.misoriented_edges, 0);
    if (share < 0.1) {
      EXPECT_TRUE(r.closedness.isSolid()) << share << ": " << summaryOf(r);
      EXPECT_NEAR(volumeOf(r.vertices, r.triangles), volumeOf(ball.vertices, ball.triangles), 1);
    }
  }
  Mesh box = scenes::subdividedBox({1, 1, 1}, 1);
  const fcl::Triangle t = box.triangles.back();
  box.triangles.pop_back();
  const std::size_t middle = box.vertices.size();
  box.vertices.push_back(0.5 * (box.vertices[t[0]] + box.vertices[t[1]]));
  box.triangles.emplace_back(t[0], middle, t[2]);
  box.triangles.emplace_back(middle, t[1], t[2]);
  ASSERT_EQ(inspectClosedness(box.vertices, box.triangles).open_edges, 3);
  const auto r = repaired(box, filling(3));
  EXPECT_TRUE(r.closedness.isSolid()) << summaryOf(r);
  EXPECT_EQ(r.filled_triangles, 1);
}

TEST(RepairHoles, OneSidedSurfacesAndBranchesAreSaidToBeNone) {
  Mesh strip;  // Moebius'
  constexpr int kSteps = 20;
  for (int i = 0; i < kSteps; ++i) {
    const double u = 2 * M_PI * i / kSteps;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1 + w * std::cos(u / 2);
      strip.vertices.emplace_back(r * std::cos(u), r * std::sin(u), w * std::sin(u / 2));
    }
  }
  for (std::size_t i = 0; i < kSteps; ++i) {
    const std::size_t a = 2 * i, b = a + 1;
    const bool last = i + 1 == kSteps;
    const std::size_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.emplace_back(a, c, b);
    strip.triangles.emplace_back(b, c, d);
  }
  const auto r = repaired(strip, filling(256));
  expectHonest(strip, r);
  EXPECT_FALSE(r.closedness.isSolid());
  EXPECT_FALSE(summaryOf(r).empty());
  Mesh fan = scenes::icosphere(1, 1);
  fan.vertices.emplace_back(3, 0, 0);
  fan.triangles.emplace_back(fan.triangles[0][0], fan.triangles[0][1], fan.vertices.size() - 1);
  const auto branch = repaired(fan, filling(256));
  expectHonest(fan, branch);
  EXPECT_FALSE(branch.closedness.isSolid());
  EXPECT_NE(summaryOf(branch).find("no solid"), std::string::npos);
}

// Real ones: what docs/solids.md says of them.
TEST(RepairHoles, OfRobotsLinks) {
  namespace fs = std::filesystem;
  const char* const data = std::getenv("KIOS_DATA");
  const fs::path root = data ? data : "../shared/data";
  int count = 0, solid = 0, welded = 0, filled = 0;
  for (const char* folder : {"ur5", "mbm/ur5/meshes", "mbm/ur5/meshes/ur5/collision",
                             "mbm/ur5/meshes/robotiq", "mbm/panda/meshes/collision", "fcl"}) {
    if (!fs::exists(root / folder)) GTEST_SKIP() << "no " << (root / folder);
    for (const Mesh& mesh : scenes::loadMeshes(root / folder)) {
      ++count;
      solid += inspectClosedness(mesh.vertices, mesh.triangles).isSolid() ? 1 : 0;
      const auto weld = repaired(mesh), fill = repaired(mesh, filling(64));
      expectHonest(mesh, weld);
      expectHonest(mesh, fill);
      welded += weld.closedness.isSolid() ? 1 : 0;
      filled += fill.closedness.isSolid() ? 1 : 0;
    }
  }
  EXPECT_EQ(count, 37);
  EXPECT_EQ(solid, 30);
  EXPECT_EQ(welded, 32);
  EXPECT_EQ(filled, 37);
}

}  // namespace
}  // namespace kios::testing
