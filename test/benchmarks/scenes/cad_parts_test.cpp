// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/cad_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "benchmarks/scenes/mesh_checks.h"

namespace kios::scenes {
namespace {

TEST(CadParts, ClosedAndWoundOutward) {
  for (const Mesh& mesh : cadParts()) {
    expectClosed(mesh);
    EXPECT_GE(mesh.triangles.size(), 800u);
    EXPECT_LE(mesh.triangles.size(), 6000u);
    EXPECT_GE(extent(mesh), 0.04);
    EXPECT_LE(extent(mesh), 0.4);
  }
}

TEST(CadParts, Volumes) {
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

TEST(CadParts, TrianglesAreAsLongAsCadKernelsMakeThem) {
  const auto worstAspect = [](const Mesh& mesh) {
    double worst = 0;
    for (const fcl::Triangle& t : mesh.triangles) {
      double longest = 0;
      for (int i = 0; i < 3; ++i) {
        longest = std::max(longest, (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[i]]).norm());
      }
      const fcl::Vector3d u = mesh.vertices[t[1]] - mesh.vertices[t[0]],
                          v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
      worst = std::max(worst, longest * longest / u.cross(v).norm());
    }
    return worst;
  };
  double worst = 0;
  for (const Mesh& mesh : cadParts()) worst = std::max(worst, worstAspect(mesh));
  EXPECT_GT(worst, 1000);
  EXPECT_LT(worst, 1e5);
}

TEST(CadParts, RefusesWhatItCannotBuild) {
  EXPECT_THROW(spurGear(10, 0.1, 1, 0.5, 20), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.6, 0.1, 8), std::invalid_argument);
  EXPECT_THROW(drilledPlate(1, 1, 1, 0.2, 0.1, 10), std::invalid_argument);
}

}  // namespace
}  // namespace kios::scenes
