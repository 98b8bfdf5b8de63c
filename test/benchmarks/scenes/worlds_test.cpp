// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/worlds.h"

#include <gtest/gtest.h>

#include <map>

#include "benchmarks/scenes/mesh_checks.h"
#include "scenes/cad_parts.h"
#include "scenes/oracle.h"

namespace kios::scenes {
namespace {

TEST(Worlds, BoxesAreWoundOutwardAndCounted) {
  const std::map<std::string, std::size_t> counts = {
      {"table_top", 12}, {"table", 60}, {"floor", 12}, {"room", 60},
      {"shelf", 108},    {"crate", 60}, {"bins", 240}, {"stairs", 144}};
  for (const World& world : boxWorlds()) {
    EXPECT_EQ(world.mesh.triangles.size(), counts.at(world.name)) << world.name;
    ASSERT_EQ(world.mesh.triangles.size(), 12 * world.boards.size()) << world.name;
    double volume = 0;
    for (const Board& board : world.boards) volume += board.size.prod();
    EXPECT_NEAR(signedVolume(world.mesh), volume, 1e-12 * (1 + volume)) << world.name;
  }
}

TEST(Worlds, MeshesHaveTheirTriangles) {
  std::map<std::string, std::size_t> counts;
  for (const World& world : meshWorlds(30000)) counts[world.name] = world.mesh.triangles.size();
  EXPECT_EQ(counts["terrain_1m"], 1800u);
  EXPECT_EQ(counts["terrain_10m"], 1800u);
  EXPECT_EQ(counts["terrain_5cm"], 28800u);
  EXPECT_GE(counts["building"], 30000u);
  EXPECT_LE(counts["building"], 37000u);
  EXPECT_EQ(counts["needles"], 150u);
  EXPECT_EQ(counts["strips"], 800u);
}

TEST(Worlds, TwoOfSevenPosesTouchAndHalfAreNear) {
  const Mesh link = cadParts().front();
  const int count = 35;
  for (const World& world : boxWorlds()) {
    const auto poses = posesNear(world, link, count, 3);
    const MeshOracle oracle(world.mesh, link);
    int near = 0, touching = 0;
    for (const fcl::Transform3d& X : poses) {
      const double distance = oracle.distance(fcl::Transform3d::Identity(), X);
      near += distance < 0.01;
      touching += distance == 0;
    }
    EXPECT_GE(near, count / 2) << world.name;
    EXPECT_LE(near, count * 4 / 5) << world.name;
    EXPECT_NEAR(touching, 10, 2) << world.name;
  }
}

TEST(Worlds, LinksOfARoomAreInIt) {
  const Mesh link = cadParts().front();
  for (const World& world : boxWorlds()) {
    if (world.name != "room") continue;
    for (const fcl::Transform3d& X : posesNear(world, link, 70, 3)) {
      const fcl::Vector3d p = X * link.vertices.front();
      EXPECT_TRUE((p.array() > world.lower.array() - 0.5).all() &&
                  (p.array() < world.upper.array() + 0.5).all());
    }
  }
}

TEST(Worlds, PosesAreSeeded) {
  const World world = boxWorlds().front();
  const Mesh link = cadParts().front();
  const auto first = posesNear(world, link, 10, 3), again = posesNear(world, link, 10, 3);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].matrix(), again[i].matrix());
  }
}

TEST(Worlds, ScansLieOnTheirSurfaces) {
  for (const fcl::Vector3d& p : scannedTable(0.05, 0.002, 1)) {
    const bool table = std::abs(p.z() - 0.75) <= 0.002, wall = std::abs(p.y() - 0.6) <= 0.002;
    const bool box = std::abs(p.y() - 0.1) <= 0.002 || std::abs(p.x() - 0.1) <= 0.002 ||
                     std::abs(p.z() - 1) <= 0.002;
    EXPECT_TRUE(table || wall || box) << p.transpose();
  }
}

}  // namespace
}  // namespace kios::scenes
