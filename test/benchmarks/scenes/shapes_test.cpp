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

TEST(Shapes, RefuseWhatTheyCannotBuild) {
  EXPECT_THROW(spurGear(10, 0.1, 1, 0.5, 20), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.6, 0.1, 8), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.2, 0.1, 10), std::invalid_argument);
  EXPECT_THROW(turnedPart({{1, 0}, {1, 1}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(turnedPart({{0, 0}, {0, 1}}, 8), std::invalid_argument);
  EXPECT_THROW(boredBlock({1, 1, 1}, 0.1, 0.1, 0.1, 10), std::invalid_argument);
  EXPECT_THROW(buildModel<fcl::OBBRSSd>(Mesh{}), std::runtime_error);
}

}  // namespace
}  // namespace kios::scenes
