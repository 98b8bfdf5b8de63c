// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Brackets of convex solids that are thin in one direction or two, as the vertices' own coordinates
// have them or turned, so that their faces are flat only up to rounding.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scenes/placement.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

void expectClosed(const PenetrationResult& depth, const std::string& what) {
  EXPECT_GT(depth.lower, 0) << what;
  EXPECT_LE(depth.upper, 1.041 * depth.lower) << what;
}

TEST(ThinSolids, BracketsClose) {
  const auto cube = solidOf(scenes::subdividedBox({0.5, 0.5, 0.5}, 1));
  using scenes::shift, scenes::turn;
  const fcl::Vector3d axis = fcl::Vector3d(1, 2, 3).normalized(),
                      other = fcl::Vector3d(3, -1, 2).normalized();
  const fcl::Transform3d X = shift(0.05, 0.1, 0.15) * turn(0.3, axis),
                         Y = shift(0.3, 0.2, 0.1) * turn(1.1, other);
  for (const double thin : {1e-2, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const Mesh needle = scenes::subdividedBox({1, thin, thin}, 1),
               sheet = scenes::subdividedBox({1, 0.7, thin}, 1),
               fine = scenes::subdividedBox({1, 0.7, thin}, 3);
    const std::vector<std::pair<std::string, Mesh>> meshes = {
        {"needle", needle}, {"sheet", sheet}, {"fine", fine}};
    for (const auto& [name, mesh] : meshes) {
      const std::string what = name + " of 1e-7 times " + std::to_string(thin * 1e7);
      expectClosed(penetration(*cube, kHere, *solidOf(mesh), X), what);
      // Faces of coordinates that are rounded bulge by 1e-16, against which thinner ones are thick.
      if (thin >= 1e-6) {
        const auto rounded = solidOf(scenes::moved(Y, mesh));
        expectClosed(penetration(*cube, kHere, *rounded, kHere), what + ", rounded");
      }
    }
  }
}

// What is dented by more than rounding is not taken for convex, however thin: the bound of the hull
// would be none.
TEST(ThinSolids, DentsAreSeen) {
  for (const double thin : {1.0, 1e-3, 1e-5}) {
    // Half of the sheet's top lies at mid-height: a step, in which a small box is free.
    const double half = 0.5 * thin;
    const Mesh step =
        prism({{0, 0}, {1, 0}, {1, half}, {0.5, half}, {0.5, thin}, {0, thin}}, {}, {0, 1});
    const double side = 0.25 * thin;
    const auto box = solidOf(scenes::subdividedBox({side, side, side}, 1));
    // Its lower face is 0.01 thick below the step's tread, which lets it out there.
    const PenetrationResult depth =
        penetration(*solidOf(step), kHere, *box, at(0.75, 0.5, thin * (0.5 + 0.125 - 0.01)));
    EXPECT_LE(depth.lower, 0.0101 * thin) << thin;
    EXPECT_GE(depth.upper, 0.01 * thin * (1 - 1e-9)) << thin;
  }
}

}  // namespace
}  // namespace kios::testing
