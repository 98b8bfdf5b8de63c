// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Meshes that are broken on purpose, and what repair() says of them: welds, doubles, orientation.

#include <gtest/gtest.h>

#include <cmath>

#include "all_pairs.h"
#include "fcl/expect_refused.h"
#include "scenes/random.h"
#include "solid/repair_check.h"

namespace kios::testing {
namespace {

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

/// Tetrahedra and boxes over few places, so that they share bases, faces and edges, lie in each
/// other and are there twice; some as thin as the tolerance.
Mesh sharingParts(scenes::Random& random) {
  std::vector<Mesh> parts;
  const auto place = [&] { return std::floor(random.uniform(0, 3)); };
  for (int n = 2 + static_cast<int>(random.uniform(0, 4)); n > 0; --n) {
    Mesh part;
    if (random.unit() < 0.5) {
      const double z = place();
      part.vertices = {{0, 0, z}, {1, 0, z}, {0, 1, z}, {place(), place(), z + 1 + place()}};
      part.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    } else {
      const Vector3d low(place(), place(), place());
      const double thin = random.unit() < 0.1 ? 1e-6 : 1 + place();
      part = scenes::subdividedBox({1, 1, 1}, 1);
      for (Vector3d& p : part.vertices) {
        p = low +
            (p.array() > 0).select(Vector3d(1 + place(), 1 + place(), thin), Vector3d::Zero());
      }
    }
    parts.push_back(part);
  }
  if (random.unit() < 0.2) {  // a cavity, and what fills it
    parts.push_back(flipped(parts.front()));
    parts.push_back(transformed(scenes::subdividedBox({12, 12, 12}, 1), 1, {4, 4, 4}));
  }
  return scenes::merged(parts);
}

TEST(Repair, SolidsThatSharePartsStayAsTheyAre) {
  scenes::Random random(7);
  for (int i = 0; i < casesOr(1000); ++i) {
    const Mesh mesh = sharingParts(random);
    ASSERT_TRUE(inspectClosedness(mesh.vertices, mesh.triangles).isSolid()) << i;
    const auto r = repaired(mesh);
    expectHonest(mesh, r);
    ASSERT_TRUE(r.closedness.isSolid()) << i << ": " << summaryOf(r);
    EXPECT_EQ(r.triangles.size(), mesh.triangles.size()) << i << ": " << summaryOf(r);
    EXPECT_EQ(r.flipped_triangles + r.moved_vertices, 0) << i;
    EXPECT_NEAR(volumeOf(r.vertices, r.triangles), volumeOf(mesh.vertices, mesh.triangles), 1e-9);
    const auto before = trianglesOf(MeshIn<double>(mesh)),
               after = trianglesOf(MeshIn<double>({r.vertices, r.triangles}));
    for (int k = 0; k < 8; ++k) {
      const Vector3d p = Vector3d::Constant(2) + 2.5 * inCube(random);
      EXPECT_NEAR(windingNumber(after, p), windingNumber(before, p), 1e-6) << i;
    }
  }
}

// Patches of all sizes, whose faces are there again, wound alike or turned: the copies go.
TEST(Repair, DoubledPatchesAreMended) {
  scenes::Random random(8);
  const Mesh solids[] = {scenes::subdividedBox({1, 2, 3}, 1), scenes::subdividedBox({1, 2, 3}, 3),
                         scenes::icosphere(1, 1), scenes::bumpyTorus(200)};
  for (int i = 0; i < casesOr(400); ++i) {
    const Mesh& solid = solids[i % 4];
    const auto begin =
        static_cast<std::size_t>(random.uniform(0, static_cast<double>(solid.triangles.size())));
    const double most = 0.9 * static_cast<double>(solid.triangles.size());
    const auto size = static_cast<std::size_t>(std::pow(most, random.unit()));
    Mesh mesh = solid;
    for (std::size_t k = 0; k < size; ++k) {
      const fcl::Triangle& t = solid.triangles[(begin + k) % solid.triangles.size()];
      const bool turned = random.unit() < (i % 2 == 0 ? 1 : 0.5);
      for (int copies = i % 3 == 0 ? 2 : 1; copies > 0; --copies) {
        mesh.triangles.emplace_back(t[1], t[turned ? 0 : 2], t[turned ? 2 : 0]);
      }
    }
    if (inspectClosedness(mesh.vertices, mesh.triangles).isSolid()) continue;
    const auto r = repaired(mesh);
    expectHonest(mesh, r);
    EXPECT_TRUE(r.closedness.isSolid()) << i << ", " << size << ": " << summaryOf(r);
    EXPECT_EQ(r.triangles.size(), solid.triangles.size()) << i << ", " << size;
    EXPECT_NEAR(volumeOf(r.vertices, r.triangles), volumeOf(solid.vertices, solid.triangles), 1e-9);
  }
}

TEST(Repair, WithoutAToleranceEqualVerticesAloneAreWelded) {
  RepairRequest none;
  none.relative_weld = 0;
  for (const double scale : {1e-150, 1.0, 1e150}) {
    for (const double small : {1e-9, 1e-17, 1e-100}) {
      Mesh open = scenes::subdividedBox({scale, scale, scale}, 1);
      open.triangles.pop_back();  // what is a solid isn't welded at all
      const Mesh tiny = transformed(scenes::icosphere(1, 0), small * scale, {0, 0, 0});
      const Mesh mesh = scenes::merged({open, scenes::soup(tiny)});
      const auto r = repaired(mesh, none);
      EXPECT_EQ(r.moved_vertices, 0) << scale << " " << small;
      EXPECT_EQ(r.vertices.size(), open.vertices.size() + tiny.vertices.size());
      EXPECT_EQ(r.triangles.size(), mesh.triangles.size());
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
      RepairRequest exact;
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
  RepairRequest options;
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

  // Everything with its back; everything twice is a solid as it is.
  for (const Mesh& other : {ball, flipped(ball)}) {
    Mesh twice = ball;
    twice.triangles.insert(twice.triangles.end(), other.triangles.begin(), other.triangles.end());
    const auto r = repaired(twice);
    expectHonest(twice, r);
    const bool alike = other.triangles[0][1] == ball.triangles[0][1];
    EXPECT_EQ(r.triangles.size(), (alike ? 2 : 1) * ball.triangles.size());
    EXPECT_TRUE(r.closedness.isSolid());
    EXPECT_GT(volumeOf(r.vertices, r.triangles), 0);
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

TEST(Repair, RefusesBadInput) {
  const Mesh ball = scenes::icosphere(1, 0);
  const auto refused = [&](const Mesh& mesh, const RepairRequest& options, const char* part) {
    expectRefused([&] { repaired(mesh, options); }, part);
  };
  Mesh wrong = ball;
  wrong.triangles[2].set(0, 1, 99);
  refused(wrong, {}, "triangle 2 refers to vertex 99");
  wrong = ball;
  wrong.vertices[ball.triangles[0][0]][1] = std::nan("");
  refused(wrong, {}, "not finite");
  for (const double value : {-1.0, 1.0, std::nan("")}) {
    RepairRequest options;
    options.relative_weld = value;
    refused(ball, options, "relative_weld");
  }
  RepairRequest options;
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

}  // namespace
}  // namespace kios::testing
