// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The costs of the engine that don't depend on the machine: bytes, and work a query.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

double preparedBytesPerTriangle(const Mesh& mesh) {
  const auto model = kiosModel(mesh);
  return static_cast<double>(preparedBytes(*model)) / static_cast<double>(mesh.triangles.size());
}

// Layer 1 takes 300 (shared vertices) and 360 (soups) of 500 and 600 bytes a triangle.
TEST(EngineCost, BytesATriangle) {
  for (const int triangles : {1000, 20000}) {
    const Mesh mesh = scenes::bumpyTorus(triangles);
    EXPECT_LE(preparedBytesPerTriangle(mesh), 200) << triangles;
    EXPECT_LE(preparedBytesPerTriangle(scenes::soup(mesh)), 200) << triangles;
  }
}

// The work of a query, the same on every machine: a search that loses its order or its bounds
// shows here before it shows in times. The limits are a fifth above what was measured.
TEST(EngineCost, WorkAQuery) {
  const auto a = kiosModel(scenes::bentTorus()), b = kiosModel(scenes::knobbyTorus());
  const std::vector<Frame> frames = scenes::fallingMotion(100);
  SearchCounts distance, contact;
  for (const Frame& frame : frames) {
    fcl::DistanceResultd nearest;
    distanceMeshes(*a, frame.X_WA, *b, frame.X_WB, fcl::DistanceRequestd(), nearest, &distance);
    fcl::CollisionResultd hit;
    collideMeshes(*a, frame.X_WA, *b, frame.X_WB, fcl::CollisionRequestd(), hit, &contact);
  }
  const auto n = static_cast<double>(frames.size());
  EXPECT_LE(distance.expansions / n, 60);
  EXPECT_LE(distance.leaf_pairs / n, 46);
  EXPECT_LE(distance.leaf_kernels / n, 11);
  EXPECT_LE(distance.exact / n, 8.5);
  EXPECT_LE(contact.expansions / n, 14);
  EXPECT_LE(contact.leaf_pairs / n, 3.6);
}

}  // namespace
}  // namespace kios::testing
