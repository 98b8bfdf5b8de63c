// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solids.h"

#include <gtest/gtest.h>

#include <ctime>

#include <cmath>
#include <locale>
#include <string>

#include "fcl_kios/repair.h"
#include "solid/solid_meshes.h"

namespace kios {
namespace {

using scenes::Mesh;
using testing::flipped;

Closedness inspect(const Mesh& mesh) { return inspectClosedness(*testing::modelOf(mesh)); }

std::string refusal(const Mesh& mesh) {
  const auto model = testing::modelOf(mesh);
  try {
    markSolid(*model);
  } catch (const std::invalid_argument& error) {
    EXPECT_FALSE(isSolid(*model));
    return error.what();
  }
  return {};
}

TEST(Closedness, SolidsAreClosedAndTheirComponentsCounted) {
  const int components[] = {1, 1, 1, 1, 1, 5, 3, 2, 1};
  const auto meshes = testing::solidMeshes();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (const Mesh& mesh : {meshes[i].mesh, scenes::soup(meshes[i].mesh)}) {
      const Closedness c = inspect(mesh);
      EXPECT_TRUE(c.closed) << meshes[i].name;
      EXPECT_TRUE(c.oriented) << meshes[i].name;
      EXPECT_EQ(c.components, components[i]) << meshes[i].name;
      EXPECT_EQ(c.open_edges + c.misoriented_edges + c.inside_out, 0) << meshes[i].name;
      EXPECT_EQ(c.first[0].triangle, -1);
      EXPECT_TRUE(faultsOf(c).empty());
      EXPECT_TRUE(refusal(mesh).empty());
    }
  }
}

/// Writes 1234.5 as 1.234,5.
struct CommaAndGroups : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Closedness, TextsDontChangeWithTheLocale) {
  Mesh mesh = scenes::soup(scenes::icosphere(1, 4));
  mesh.triangles.resize(mesh.triangles.size() / 2);
  const auto texts = [&] {
    RepairRequest options;
    options.absolute_weld = -1234.5;
    std::string unfit;
    try {
      repair(mesh.vertices, mesh.triangles, options);
    } catch (const std::invalid_argument& error) {
      unfit = error.what();
    }
    return faultsOf(inspect(mesh)) + summaryOf(repair(mesh.vertices, mesh.triangles)) + unfit +
           refusal(mesh);
  };
  const std::string plain = texts();
  EXPECT_NE(plain.find("-1234.5"), std::string::npos) << plain;
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaAndGroups));
  const std::string other = texts();
  std::locale::global(before);
  EXPECT_EQ(other, plain);
}

TEST(Closedness, AMissingTriangleOpensThreeEdges) {
  Mesh mesh = scenes::icosphere(1, 1);
  const fcl::Triangle gone = mesh.triangles.back();
  mesh.triangles.pop_back();
  const Closedness c = inspect(mesh);
  EXPECT_FALSE(c.closed);
  EXPECT_TRUE(c.oriented);
  EXPECT_EQ(c.open_edges, 3);
  EXPECT_EQ(c.misoriented_edges, 0);
  for (const FaultyEdge& edge : c.first) {
    ASSERT_GE(edge.triangle, 0);
    int ends = 0;
    for (int k = 0; k < 3; ++k) {
      ends += mesh.vertices[gone[k]] == edge.from || mesh.vertices[gone[k]] == edge.to;
    }
    EXPECT_EQ(ends, 2);
  }
  EXPECT_LT(c.first[0].triangle, c.first[2].triangle);
  const std::string message = refusal(mesh);
  EXPECT_NE(message.find("3 open edges; the first: triangle " +
                         std::to_string(c.first[0].triangle) + ", ("),
            std::string::npos)
      << message;
}

TEST(Closedness, ATurnedTriangleMisorientsItsEdges) {
  Mesh mesh = scenes::subdividedBox({1, 2, 3}, 2);
  fcl::Triangle& t = mesh.triangles[5];
  t.set(t[0], t[2], t[1]);
  const Closedness c = inspect(mesh);
  EXPECT_TRUE(c.closed);
  EXPECT_FALSE(c.oriented);
  EXPECT_EQ(c.misoriented_edges, 3);
  EXPECT_NE(refusal(mesh).find("3 misoriented edges; the first: triangle"), std::string::npos);
}

TEST(Closedness, ComponentsThatAreInsideOutAreRefused) {
  const Mesh ball = scenes::icosphere(1, 1), small = scenes::icosphere(0.5, 1);
  EXPECT_NE(refusal(flipped(ball)).find("1 component inside out (with triangle 0)"),
            std::string::npos);
  EXPECT_NE(refusal(scenes::merged({ball, testing::transformed(flipped(small), 1, {3, 0, 0})}))
                .find("1 component inside out (with triangle 80)"),
            std::string::npos);
  EXPECT_EQ(inspect(scenes::merged({flipped(ball), flipped(small)})).inside_out, 2);
  // Walls of cavities point inwards: once, but not twice, round one ball.
  EXPECT_TRUE(refusal(scenes::merged({ball, flipped(small)})).empty());
  EXPECT_EQ(inspect(scenes::merged({ball, flipped(small), flipped(scenes::icosphere(0.25, 1))}))
                .inside_out,
            1);
  EXPECT_TRUE(refusal(scenes::merged({ball, small})).empty());
}

// Each is asked for its place among the others, in time that hardly grows with their number.
TEST(Closedness, OfManyCavitiesThoseOutsideAreFound) {
  scenes::Random random(3);
  for (const double scale : {1e-9, 1.0, 1e9}) {
    std::vector<Mesh> parts = {scenes::subdividedBox({2, 2, 2}, 1), scenes::icosphere(1.2, 4)};
    int outside = 0;
    for (int i = 0; i < 3000; ++i) {
      const double size = std::pow(10, random.uniform(-4, -2));
      const fcl::Vector3d at = 2 * testing::inCube(random);
      const bool in_box = at.cwiseAbs().maxCoeff() < 1 - size;
      const bool in_ball = at.norm() < 1.19 - size;
      const bool out = at.cwiseAbs().maxCoeff() > 1 + size && at.norm() > 1.2 + size;
      if (!out && !in_box && !in_ball) continue;
      outside += out ? 1 : 0;
      parts.push_back(testing::transformed(flipped(scenes::icosphere(1, 0)), size, at));
    }
    ASSERT_GT(outside, 100);
    const Mesh mesh =
        testing::transformed(scenes::merged(parts), scale, scale * fcl::Vector3d(3, -1, 7));
    const Closedness c = inspect(mesh);
    EXPECT_EQ(c.components, static_cast<int>(parts.size()));
    EXPECT_EQ(c.inside_out, outside) << scale;
  }
}

// One behind the other as a ray sees them, each vertex nearly on the ray from that of the next.
// Rays that looked at all of them would take a minute.
TEST(Closedness, CavitiesInLineDontSeeEachOther) {
  const fcl::Vector3d along(0.36602540378443865, 0.61803398874989485, 1);
  for (const bool turned : {false, true}) {
    constexpr int kCavities = 3000;
    std::vector<Mesh> parts = {
        testing::transformed(scenes::subdividedBox({1300, 2000, 3100}, 3), 1, 1500 * along)};
    for (int i = 0; i < kCavities; ++i) {
      parts.push_back(testing::transformed(flipped(scenes::icosphere(0.3, 1)), 1, i * along));
    }
    if (turned) parts[0] = flipped(parts[0]);
    const std::clock_t start = std::clock();
    const Closedness c = inspect(scenes::merged(parts));
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 8);
    EXPECT_EQ(c.components, kCavities + 1);
    EXPECT_EQ(c.inside_out, turned ? kCavities + 1 : 0);
  }
}

TEST(Closedness, AllSheetsAtAnEdgeMustPassItBothWays) {
  const Mesh box = scenes::subdividedBox({1, 1, 1}, 1);
  const Mesh other = testing::transformed(box, 1, {1, 1, 0});
  const Closedness both = inspect(scenes::merged({box, other}));
  EXPECT_EQ(both.branching_edges, 1);
  EXPECT_TRUE(both.closed && both.oriented);
  Mesh doubled = box;
  doubled.triangles.push_back(box.triangles[0]);
  const Closedness three = inspect(doubled);
  EXPECT_EQ(three.open_edges, 3);
  EXPECT_EQ(three.branching_edges, 3);
  doubled.triangles.push_back(box.triangles[0]);
  EXPECT_EQ(inspect(doubled).misoriented_edges, 3);
}

TEST(Closedness, TrianglesThatAreSegmentsOrPointsChangeNothing) {
  Mesh mesh = scenes::subdividedBox({1, 2, 3}, 1);
  mesh.triangles.emplace_back(mesh.triangles[0][0], mesh.triangles[0][1], mesh.triangles[0][1]);
  mesh.triangles.emplace_back(0, 0, 0);
  EXPECT_TRUE(refusal(mesh).empty());
  EXPECT_EQ(inspect(mesh).components, 1);
  Mesh point;
  point.vertices = {{1, 2, 3}};
  point.triangles = {{0, 0, 0}};
  EXPECT_NE(refusal(point).find("it has no edges"), std::string::npos);
}

// The volume's sign is that of exact arithmetic: this one is flat but for the last bit.
TEST(Closedness, ThinShellsAreToldFromInsideOutOnes) {
  Mesh mesh;
  mesh.vertices = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 1 + 0x1p-52}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(inspect(mesh).oriented);
  EXPECT_EQ(inspect(flipped(mesh)).inside_out, 1);
}

}  // namespace
}  // namespace kios
