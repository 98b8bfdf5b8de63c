// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles so small that squares and fourth powers of their edges vanish, in meshes of ordinary
// size: they have distances, contacts and rays like all others.

#include <gtest/gtest.h>

#include <cmath>

#include "fcl/mesh_cases.h"
#include "fcl_kios/fcl_kios.h"
#include "shapes.h"

namespace kios::testing {
namespace {

constexpr double kSizes[] = {1e-30, 1e-60,  1e-75,  1e-77,  1e-79,  1e-81,
                             1e-90, 1e-120, 1e-150, 1e-155, 1e-162, 1e-200};

/// Returns triangles far off in two corners, which give a mesh its size.
Mesh withCorners(double z) {
  Mesh mesh;
  addTriangle(mesh, {1, 1, 1}, {1, 0.9, 1}, {0.9, 1, 1});
  addTriangle(mesh, {-1, -1, -1}, {-1, -0.9, -1}, {-0.9, -1, -1});
  for (Vector3d& p : mesh.vertices) p.z() += z;
  return mesh;
}

TEST(TinyTriangles, MeetAPlane) {
  const Frame frame = {Transform3d::Identity(), Transform3d::Identity()};
  for (const double s : kSizes) {
    SCOPED_TRACE(s);
    Mesh tiny = withCorners(0), plane = withCorners(3);
    addTriangle(tiny, {-s, -s, -s}, {s, -s, s}, {0, s, s});
    addTriangle(plane, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    ASSERT_EQ(leafPairs(tiny, plane, frame), Pairs({{2, 2}}));
    const auto a = kiosModel(tiny), b = kiosModel(plane);
    for (const std::size_t limit : {std::size_t{1}, std::size_t{100}}) {
      fcl::CollisionResultd result;
      fcl::collide(a.get(), frame.X_WA, b.get(), frame.X_WB, {limit, true}, result);
      EXPECT_EQ(contactPairs(result), Pairs({{2, 2}})) << limit;
    }
    fcl::DistanceResultd distance;
    fcl::distance(a.get(), frame.X_WA, b.get(), frame.X_WB, fcl::DistanceRequestd(), distance);
    EXPECT_EQ(distance.min_distance, 0);
    Rayd ray;
    ray.origin = {0, 0, 5};
    ray.direction = {0, 0, -1};
    const auto hit = firstHit(*a, Transform3d::Identity(), ray);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->triangle, 2);
  }
}

}  // namespace
}  // namespace kios::testing
