// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Solids that an adversary would make: with stray triangles, touching exactly, refused while copies
// live, without an inside.

#include <gtest/gtest.h>

#include <climits>
#include <stdexcept>

#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

std::size_t contacts(const Modeld& a, const Modeld& b) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, kHere, &b, kHere, fcl::CollisionRequestd(), result);
}

/// Returns a triangle that is a point.
Mesh withPoint(Mesh mesh, std::size_t vertex) {
  mesh.triangles.emplace_back(vertex, vertex, vertex);
  return mesh;
}

// It is of no component: not of the one within, nor of the one beside.
TEST(OddSolids, PointsAmongTheTrianglesChangeNothing) {
  const Mesh inner = scenes::subdividedBox({1, 1, 1}, 1);
  const Mesh beside = transformed(inner, 1, {-20, 0, 0});
  const auto around = solidOf(scenes::subdividedBox({6, 6, 6}, 1));
  const Mesh both = scenes::merged({inner, beside});
  EXPECT_EQ(contacts(*solidOf(both), *around), 1u);
  EXPECT_EQ(contacts(*solidOf(withPoint(both, inner.vertices.size())), *around), 1u);
  Mesh stray = inner;
  stray.vertices.emplace_back(-10, 0, 0);
  const auto with_stray = solidOf(withPoint(stray, inner.vertices.size()));
  EXPECT_EQ(contacts(*with_stray, *around), 1u);
  EXPECT_GE(penetration(*with_stray, kHere, *around, kHere).upper, 3.5 - 1e-9);
  stray = transformed(inner, 1, {-10, 0, 0});
  stray.vertices.emplace_back(0, 0, 0);
  const auto stray_within = solidOf(withPoint(stray, inner.vertices.size()));
  EXPECT_EQ(contacts(*stray_within, *around), 0u);
}

/// Returns a prism over an L.
Mesh prismL() { return prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {}, {0, 1}); }

TEST(OddSolids, WhatTouchesLeavesByARounding) {
  const auto shape = solidOf(prismL());
  for (const double side : {1.0, 0.1}) {
    const auto cube = solidOf(scenes::subdividedBox({side, side, side}, 1));
    for (const double over : {0.0, 1e-9, 1e-3}) {
      const auto X = at(2, 0.6, 1 + 0.5 * side - over);
      const PenetrationResult depth = penetration(*shape, kHere, *cube, X);
      EXPECT_LE(depth.lower, over + 1e-14);
      EXPECT_GE(depth.upper, over - 1e-14);
      EXPECT_LE(depth.upper, 1.1 * over + 1e-10) << side << " " << over;
    }
  }
  const PenetrationResult corner = penetration(*shape, kHere, *shape, at(1, 0, 1));
  EXPECT_LE(corner.upper, 1e-10);
}

TEST(OddSolids, ARefusedMarkChangesNothing) {
  const Mesh cube = scenes::subdividedBox({1, 1, 1}, 1);
  const auto solid = solidOf(cube);
  Modeld copy(*solid);
  ASSERT_EQ(copy.beginReplaceModel(), fcl::BVH_OK);
  std::vector<fcl::Vector3d> mirrored = cube.vertices;
  for (fcl::Vector3d& p : mirrored) p.x() = -p.x();
  ASSERT_EQ(copy.replaceSubModel(mirrored), fcl::BVH_OK);
  ASSERT_EQ(copy.endReplaceModel(), fcl::BVH_OK);
  EXPECT_THROW(contacts(copy, *solid), std::invalid_argument);
  EXPECT_THROW(markSolid(copy), std::invalid_argument);
  EXPECT_THROW(contacts(copy, *solid), std::invalid_argument);
  ASSERT_EQ(copy.beginReplaceModel(), fcl::BVH_OK);
  ASSERT_EQ(copy.replaceSubModel(cube.vertices), fcl::BVH_OK);
  ASSERT_EQ(copy.endReplaceModel(), fcl::BVH_OK);
  EXPECT_TRUE(isSolid(copy));
}

TEST(OddSolids, ManyTestsAreNotNone) {
  const auto shape = solidOf(prismL());
  const auto cube = solidOf(scenes::subdividedBox({1, 1, 1}, 1));
  PenetrationRequest options;
  options.max_tests = INT_MAX;
  const double most = penetration(*shape, kHere, *cube, at(2, 0.5, 1.2), options).upper;
  EXPECT_LE(most, penetration(*shape, kHere, *cube, at(2, 0.5, 1.2)).upper + 1e-12);
}

// Squares of lengths would vanish, or overflow.
TEST(OddSolids, ScalesBeyondAllSquaresAreRefused) {
  for (const double scale : {1e-165, 1e-100, 1e-80, 1e80, 1e100, 1e155}) {
    const auto cube = solidOf(scenes::subdividedBox({scale, scale, scale}, 1));
    const auto X = at(0.5 * scale, 0, 0);
    EXPECT_EQ(contacts(*cube, *cube), 1u);
    if (scale < 1e-90 || scale > 1e90) {
      EXPECT_THROW(penetration(*cube, kHere, *cube, X), std::invalid_argument) << scale;
    } else {
      EXPECT_GE(penetration(*cube, kHere, *cube, X).upper, 0.5 * scale * (1 - 1e-12));
    }
  }
}

// Both of whose sides are one: nothing is inside.
TEST(OddSolids, ASheetHasNoDepth) {
  Mesh sheet = scenes::singleTriangle({1, 0, 0}, {-1, 1, 0}, {0, -1, 0});
  sheet.triangles.emplace_back(0, 2, 1);
  Mesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}};
  needle.triangles.emplace_back(0, 1, 1);
  const auto around = solidOf(scenes::subdividedBox({6, 6, 6}, 1));
  for (const Mesh& mesh : {sheet, needle}) {
    EXPECT_EQ(penetration(*solidOf(mesh), kHere, *around, kHere).lower, 0);
  }
}

}  // namespace
}  // namespace kios::testing
