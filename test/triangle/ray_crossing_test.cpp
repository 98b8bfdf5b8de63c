// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/ray_crossing.h"

#include <gtest/gtest.h>

#include "scenes/containment_oracle.h"
#include "shapes.h"

namespace kios {
namespace {

using scenes::ContainmentOracle;

/// Returns inside, outside or on the surface, by a ray along `direction`.
ContainmentOracle::Place placeOf(const Point<double>& p, const Point<double>& direction,
                                 const scenes::Mesh& mesh) {
  double largest = 0;
  for (const Point<double>& v : mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  const RayCrossing ray(p, direction, largest);
  int winding = 0;
  for (const fcl::Triangle& t : mesh.triangles) {
    switch (ray.cross({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]})) {
      case Crossing::kForward:
        ++winding;
        break;
      case Crossing::kBackward:
        --winding;
        break;
      case Crossing::kOrigin:
        return ContainmentOracle::Place::kSurface;
      case Crossing::kNone:
        break;
    }
  }
  return winding > 0 ? ContainmentOracle::Place::kInside : ContainmentOracle::Place::kOutside;
}

/// Returns two boxes on a grid, one with a cavity, so that rays along the axes and their diagonals
/// meet vertices, run along edges and lie in faces.
scenes::Mesh gridSolid() {
  scenes::Mesh cavity = scenes::subdividedBox({2, 2, 2}, 2);
  for (fcl::Triangle& t : cavity.triangles) t.set(t[0], t[2], t[1]);
  return scenes::merged({scenes::subdividedBox({4, 4, 4}, 4), cavity,
                         testing::transformed(scenes::subdividedBox({2, 4, 2}, 2), 1, {2, 1, 3})});
}

TEST(RayCrossing, WindingIsRightForRaysThroughEdgesAndVerticesAndInFaces) {
  const Point<double> directions[] = {{0, 0, 1},  {0, 0, -1},  {1, 0, 1},  {0, 1, 1},  {1, 1, 1},
                                      {1, -1, 1}, {0.5, 1, 1}, {-1, 0, 2}, {-1, -1, 1}};
  for (const double scale : {1.0, 1e-9, 1e9, 0x1p-300, 0x1p300, 0x1p-1060}) {
    for (const double offset : {0.0, 1e9}) {
      if (offset > 0 && scale != 1) continue;
      const scenes::Mesh mesh =
          testing::transformed(gridSolid(), scale, {offset, -offset, 2 * offset});
      const ContainmentOracle oracle(mesh);
      for (int i = 0; i < 11 * 11 * 15; ++i) {
        const Point<double> p = scale * Point<double>(i % 11 * 0.5 - 2.5, i / 11 % 11 * 0.5 - 2.5,
                                                      i / 121 * 0.5 - 2.5) +
                                Point<double>(offset, -offset, 2 * offset);
        if (scale < 1e-100 && i % 7 != 0) continue;  // by integers of 2000 bits
        const auto place = oracle.placeOf(p);
        for (const Point<double>& direction : directions) {
          ASSERT_EQ(placeOf(p, direction, mesh), place)
              << "scale " << scale << " at " << p.transpose() << " along " << direction.transpose();
        }
      }
    }
  }
}

TEST(RayCrossing, PointsAndSegmentsAreCrossedNowhereButHoldTheOrigin) {
  const RayCrossing ray({0, 0, 0}, {0, 0, 1}, 1);
  EXPECT_EQ(ray.cross({Point<double>{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}), Crossing::kNone);
  EXPECT_EQ(ray.cross({Point<double>{-1, 0, 1}, {1, 0, 1}, {0, 0, 1}}), Crossing::kNone);
  EXPECT_EQ(ray.cross({Point<double>{-1, 0, 0}, {1, 0, 0}, {2, 0, 0}}), Crossing::kOrigin);
  EXPECT_EQ(ray.cross({Point<double>{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), Crossing::kOrigin);
  EXPECT_EQ(ray.cross({Point<double>{-1, 0, 1}, {1, -1, 1}, {1, 1, 1}}), Crossing::kForward);
  EXPECT_EQ(ray.cross({Point<double>{-1, 0, 1}, {1, 1, 1}, {1, -1, 1}}), Crossing::kBackward);
  EXPECT_EQ(ray.cross({Point<double>{-1, 0, -1}, {1, 1, -1}, {1, -1, -1}}), Crossing::kNone);
}

}  // namespace
}  // namespace kios
