// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes that are broken on purpose, and what repair() says of them.

#include "fcl_kios/interior/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "interior/solid_meshes.h"
#include "scenes/mesh_folder.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using Vector3d = fcl::Vector3d;

Repairedd repaired(const Mesh& mesh, const RepairOptions& options = {}) {
  return repair(mesh.vertices, mesh.triangles, options);
}

RepairOptions filling(int edges) {
  RepairOptions options;
  options.max_hole_edges = edges;
  return options;
}

/// Six times the signed volume.
double volumeOf(const std::vector<Vector3d>& v, const std::vector<fcl::Triangle>& triangles) {
  double sum = 0;
  for (const fcl::Triangle& t : triangles) sum += v[t[0]].dot(v[t[1]].cross(v[t[2]]));
  return sum;
}

/// What is reported is what was done.
void expectHonest(const Mesh& mesh, const Repairedd& r) {
  ASSERT_EQ(r.vertex_of.size(), mesh.vertices.size());
  ASSERT_EQ(r.triangle_of.size(), r.triangles.size());
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const fcl::Triangle& t : mesh.triangles) used[t[0]] = used[t[1]] = used[t[2]] = true;
  double farthest = 0;
  int moved = 0;
  std::set<std::pair<int, int>> stands;  // vertices of the result, by the first given ones
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (r.vertex_of[v] < 0) continue;
    ASSERT_TRUE(used[v]);
    const Vector3d& to = r.vertices.at(static_cast<std::size_t>(r.vertex_of[v]));
    const double way = (to - mesh.vertices[v]).norm();
    EXPECT_LE(way, r.weld * (1 + 1e-12));
    farthest = std::max(farthest, way);
    moved += to != mesh.vertices[v] ? 1 : 0;
  }
  EXPECT_NEAR(farthest, r.farthest_weld, 1e-15 + 1e-12 * farthest);
  EXPECT_EQ(moved, r.moved_vertices);
  EXPECT_EQ(r.farthest_vertex >= 0, moved > 0);
  int flipped = 0, added = 0;
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    const fcl::Triangle& now = r.triangles[i];
    if (r.triangle_of[i] < 0) {
      ++added;
      continue;
    }
    const fcl::Triangle& given = mesh.triangles[static_cast<std::size_t>(r.triangle_of[i])];
    std::array<int, 3> was{};
    for (int k = 0; k < 3; ++k) was[static_cast<std::size_t>(k)] = r.vertex_of[given[k]];
    const auto is = [&](int a, int b, int c) {
      return static_cast<int>(now[0]) == was[static_cast<std::size_t>(a)] &&
             static_cast<int>(now[1]) == was[static_cast<std::size_t>(b)] &&
             static_cast<int>(now[2]) == was[static_cast<std::size_t>(c)];
    };
    const bool same = is(0, 1, 2) || is(1, 2, 0) || is(2, 0, 1);
    EXPECT_TRUE(same || is(0, 2, 1) || is(2, 1, 0) || is(1, 0, 2));
    flipped += same ? 0 : 1;
  }
  EXPECT_EQ(flipped, r.flipped_triangles);
  EXPECT_EQ(added, r.filled_triangles);
  EXPECT_EQ(mesh.triangles.size() + static_cast<std::size_t>(added),
            r.triangles.size() + static_cast<std::size_t>(r.degenerate_triangles) +
                static_cast<std::size_t>(r.double_triangles));
  EXPECT_EQ(r.closedness.isSolid(), inspectClosedness(r.vertices, r.triangles).isSolid());
  // Each edge that is left open is at one of the holes, where all that is at edges of one face.
  std::size_t edges = 0;
  for (const Hole& hole : r.open) {
    edges += hole.vertices.size();
    double around = 0;
    for (std::size_t i = 0; i < hole.vertices.size(); ++i) {
      const auto at = [&](std::size_t j) {
        return r.vertices.at(static_cast<std::size_t>(hole.vertices[j % hole.vertices.size()]));
      };
      around += (at(i + 1) - at(i)).norm();
    }
    EXPECT_NEAR(around, hole.perimeter, 1e-12 * around);
  }
  EXPECT_LE(edges, static_cast<std::size_t>(r.closedness.open_edges));
}

/// Every triangle with vertices of its own, which are off by up to `by`.
Mesh shaken(const Mesh& mesh, double by, std::uint64_t seed) {
  Mesh soup = scenes::soup(mesh);
  scenes::Random random(seed);
  for (Vector3d& p : soup.vertices) {
    for (int c = 0; c < 3; ++c) p[c] += random.uniform(-by, by);
  }
  return soup;
}

TEST(Repair, ASolidStaysAsItIs) {
  for (const auto& [name, mesh] : solidMeshes()) {
    const auto r = repaired(mesh);
    expectHonest(mesh, r);
    EXPECT_TRUE(r.closedness.isSolid()) << name << ": " << summaryOf(r);
    EXPECT_EQ(r.flipped_triangles, 0) << name;
    EXPECT_EQ(r.moved_vertices, 0) << name;
    EXPECT_EQ(r.degenerate_triangles + r.double_triangles + r.filled_triangles, 0) << name;
    EXPECT_TRUE(r.open.empty()) << name;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      EXPECT_EQ(r.triangle_of[i], static_cast<int>(i));
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(r.vertices[r.triangles[i][k]], mesh.vertices[mesh.triangles[i][k]]);
      }
    }
  }
}

TEST(Repair, WeldsWithinTheTolerance) {
  for (const double scale : {1e-200, 1e-9, 1.0, 1e9, 1e200}) {
    const Mesh ball = transformed(scenes::icosphere(1, 2), scale, {3 * scale, 0, 0});
    const double extent = 2 * std::sqrt(3.0) * scale;
    for (const double by : {0.0, 1e-9, 1e-6, 2e-6}) {
      const Mesh soup = shaken(ball, by * scale, 3);
      const auto r = repaired(soup);
      EXPECT_NEAR(r.weld, 1e-5 * extent, 1e-6 * extent);
      if (scale < 1e-100 || scale > 1e100) {
        EXPECT_EQ(r.vertices.size(), ball.vertices.size()) << scale;
        continue;
      }
      expectHonest(soup, r);
      EXPECT_TRUE(r.closedness.isSolid()) << scale << " " << by << ": " << summaryOf(r);
      EXPECT_EQ(r.vertices.size(), ball.vertices.size());
      EXPECT_EQ(r.welded_vertices, static_cast<int>(soup.vertices.size() - ball.vertices.size()));
      EXPECT_LE(r.farthest_weld, 2 * std::sqrt(3.0) * by * scale);
      RepairOptions exact;
      exact.relative_weld = 0;
      EXPECT_EQ(repaired(soup, exact).closedness.closed, by == 0) << by;
      exact.absolute_weld = 1e-5 * extent;
      EXPECT_TRUE(repaired(soup, exact).closedness.isSolid()) << by;
    }
  }
}

// A row of vertices, each within the tolerance of the next, doesn't shrink to a point.
TEST(Repair, WeldsDontChain) {
  Mesh row;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.6 * i;
    row.vertices.emplace_back(x, 0, 0);
    row.vertices.emplace_back(x, 100, 0);
    row.vertices.emplace_back(x, 0, 100);
    const auto n = static_cast<std::size_t>(3 * i);
    row.triangles.emplace_back(n, n + 1, n + 2);
  }
  RepairOptions options;
  options.relative_weld = 0;
  options.absolute_weld = 1;
  const auto r = repaired(row, options);
  expectHonest(row, r);
  EXPECT_EQ(r.vertices.size(), 150U);  // every second one
  for (std::size_t i = 0; i < r.vertices.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((r.vertices[i] - r.vertices[j]).norm(), 1);
  }
  EXPECT_EQ(r.double_triangles, 50);
}

TEST(Repair, LeavesOutDegenerateAndDoubleTriangles) {
  const Mesh ball = scenes::icosphere(1, 1);
  Mesh mesh = ball;
  mesh.triangles.emplace_back(3, 3, 5);
  mesh.triangles.emplace_back(4, 4, 4);
  mesh.triangles.push_back(ball.triangles[7]);
  const fcl::Triangle& t = ball.triangles[9];
  mesh.triangles.emplace_back(t[1], t[2], t[0]);  // the same, from another corner
  const fcl::Triangle& back = ball.triangles[11];
  mesh.triangles.emplace_back(back[0], back[2], back[1]);
  ASSERT_FALSE(inspectClosedness(mesh.vertices, mesh.triangles).isSolid());
  const auto r = repaired(mesh);
  expectHonest(mesh, r);
  EXPECT_EQ(r.degenerate_triangles, 2);
  EXPECT_EQ(r.double_triangles, 3);
  EXPECT_TRUE(r.closedness.isSolid()) << summaryOf(r);
  EXPECT_EQ(r.triangles.size(), ball.triangles.size());

  // Everything twice, and everything with its back.
  for (const Mesh& other : {ball, flipped(ball)}) {
    const Mesh twice = {ball.vertices, [&] {
                          auto all = ball.triangles;
                          all.insert(all.end(), other.triangles.begin(), other.triangles.end());
                          return all;
                        }()};
    const auto once = repaired(twice);
    expectHonest(twice, once);
    EXPECT_EQ(once.triangles.size(), ball.triangles.size());
    EXPECT_TRUE(once.closedness.isSolid());
    EXPECT_GT(volumeOf(once.vertices, once.triangles), 0);
  }
  // A sheet with its back, which is all there is, stays.
  Mesh sheet = scenes::sheet(1, 1, 3, 3, 0);
  const std::size_t fronts = sheet.triangles.size();
  for (std::size_t i = 0; i < fronts; ++i) {
    const fcl::Triangle f = sheet.triangles[i];
    sheet.triangles.emplace_back(f[0], f[2], f[1]);
  }
  EXPECT_EQ(repaired(sheet).triangles.size(), 2 * fronts);
}

TEST(Repair, TurnsComponentsOutwards) {
  scenes::Random random(5);
  const Mesh parts[] = {scenes::icosphere(1, 1), transformed(scenes::bumpyTorus(200), 1, {5, 0, 0}),
                        transformed(scenes::subdividedBox({1, 2, 1}, 2), 1, {-4, 0, 0})};
  for (int round = 0; round < 20; ++round) {
    Mesh mesh;
    int odd = 0;
    for (const Mesh& part : parts) {
      Mesh one = part;
      for (fcl::Triangle& t : one.triangles) {
        if (random.unit() > 0.5 * round / 19) continue;
        t.set(t[0], t[2], t[1]);
        ++odd;
      }
      mesh = scenes::merged({mesh, one});
    }
    const auto r = repaired(mesh);
    expectHonest(mesh, r);
    EXPECT_TRUE(r.closedness.isSolid()) << summaryOf(r);
    EXPECT_EQ(r.flipped_triangles, odd);
    EXPECT_GT(volumeOf(r.vertices, r.triangles), 0);
  }
  // Turned inside out as a whole: each component by itself.
  const Mesh all = scenes::merged({parts[0], parts[1], parts[2]});
  const auto r = repaired(flipped(all));
  EXPECT_TRUE(r.closedness.isSolid());
  EXPECT_EQ(r.flipped_triangles, static_cast<int>(all.triangles.size()));
}

// Walls of cavities, as given, are no mistake; nor are solids in solids.
TEST(Repair, KeepsCavities) {
  const Mesh hollow = shell(2, 1, 2);
  const auto r = repaired(hollow);
  EXPECT_TRUE(r.closedness.isSolid());
  EXPECT_EQ(r.flipped_triangles, 0);
  const Mesh within = scenes::merged({scenes::icosphere(2, 1), scenes::icosphere(1, 1)});
  EXPECT_EQ(repaired(within).flipped_triangles, 0);
  // The outer wall is inside out, the cavity's not: the outer one alone is turned.
  const Mesh wrong = flipped(shell(2, 1, 1));
  const auto turned = repaired(wrong);
  EXPECT_TRUE(turned.closedness.isSolid()) << summaryOf(turned);
}

TEST(Repair, FillsHolesOfTheStatedSize) {
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
  RepairOptions small = filling(100);
  small.max_hole_perimeter = open.open[0].perimeter * (1 - 1e-9);
  EXPECT_EQ(repaired(mesh, small).open.size(), 1U);
  small.max_hole_perimeter = open.open[0].perimeter;
  for (const RepairOptions& options : {small, filling(edges)}) {
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
TEST(Repair, FillsManyHoles) {
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
    const auto r = repaired(mesh, filling(RepairOptions::kMostHoleEdges));
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

TEST(Repair, OneSidedSurfacesAndBranchesAreSaidToBeNone) {
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

TEST(Repair, RefusesBadInput) {
  const Mesh ball = scenes::icosphere(1, 0);
  const auto refused = [&](const Mesh& mesh, const RepairOptions& options, const char* part) {
    try {
      repaired(mesh, options);
      ADD_FAILURE() << part;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  Mesh wrong = ball;
  wrong.triangles[2].set(0, 1, 99);
  refused(wrong, {}, "triangle 2 refers to vertex 99");
  wrong = ball;
  wrong.vertices[ball.triangles[0][0]][1] = std::nan("");
  refused(wrong, {}, "not finite");
  for (const double value : {-1.0, 1.0, std::nan("")}) {
    RepairOptions options;
    options.relative_weld = value;
    refused(ball, options, "relative_weld");
  }
  RepairOptions options;
  options.absolute_weld = -1;
  refused(ball, options, "absolute_weld");
  options = filling(257);
  refused(ball, options, "max_hole_edges");
  options = {};
  options.max_hole_perimeter = -1;
  refused(ball, options, "max_hole_perimeter");
  const auto nothing = repair<double>({}, {});
  EXPECT_TRUE(nothing.triangles.empty());
  EXPECT_FALSE(nothing.closedness.isSolid());
}

TEST(Repair, OfFloats) {
  const Mesh soup = shaken(scenes::icosphere(1, 2), 1e-6, 9);
  std::vector<fcl::Vector3f> vertices;
  for (const Vector3d& p : soup.vertices) vertices.push_back(p.cast<float>());
  const auto r = repair(vertices, soup.triangles);
  EXPECT_TRUE(r.closedness.isSolid());
  markSolid(*makeModel(r.vertices, r.triangles));
}

// Real ones: what docs/solids.md says of them.
TEST(Repair, OfRobotsLinks) {
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
