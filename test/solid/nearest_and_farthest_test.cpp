// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What solids ask of a mesh, nearest points and farthest vertices, against all triangles.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle.h"
#include "model/prepared.h"
#include "query/nearest_on_mesh.h"
#include "query/shape_search.h"
#include "scenes/random.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using Vec = fcl::Vector3d;

double distanceByAll(const kios::Mesh& mesh, const Vec& p) {
  double least = kInfinity;
  for (std::size_t t = 0; t < mesh.numTriangles(); ++t) {
    least = std::min(least, triangleDistance<double>({p, p, p}, mesh.triangle(t)).distance);
  }
  return least;
}

/// Points on the surface, all but on it, about it and far away.
Vec pointAbout(const kios::Mesh& mesh, scenes::Random& random) {
  const auto t = static_cast<std::size_t>(random.uniform(0, 1) * 0.999 *
                                          static_cast<double>(mesh.numTriangles()));
  const Vec on_it = random.uniform(0, 1) < 0.5
                        ? mesh.corner(t, 0)
                        : Vec(mesh.triangle(t)[1] * 0.5 + mesh.corner(t, 2) * 0.5);
  const double lengths[] = {0, 1e-15, 1e-7, 0.1, 1, 100};
  const double length = lengths[static_cast<int>(random.uniform(0, 5.999))] * mesh.radius();
  return on_it + length * Vec(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

template <typename S>
void checkSearches(const Mesh& given, double scale, const Vec& shift) {
  Mesh moved = given;
  for (Vec& p : moved.vertices) p = scale * (p + shift);
  const auto model = modelOf<S>(moved);
  const kios::Mesh mesh = meshOf(*model);
  scenes::Random random(7);
  const int cases = casesOr(60);
  for (int i = 0; i < cases; ++i) {
    const Vec p = pointAbout(mesh, random);
    const double distance = distanceByAll(mesh, p), error = nearestError(mesh, distance);
    const NearestOnMesh near = nearestOnMesh(mesh, p, kInfinity);
    EXPECT_LE(near.lower, distance);
    EXPECT_GE(near.lower, distance - 2 * error);
    EXPECT_NEAR(near.distance, distance, error);
    // The point has coordinates of the model's frame, which round by themselves.
    const double rounding = 0x1p-46 * (p.lpNorm<1>() + mesh.largest());
    EXPECT_NEAR((near.point - p).stableNorm(), near.distance, error + rounding);
    // What is farther than asked is proven to be.
    const double within = 0.7 * distance - 2 * error;
    if (within > 0) {
      const NearestOnMesh none = nearestOnMesh(mesh, p, within);
      EXPECT_EQ(none.triangle, -1);
      EXPECT_LE(none.lower, within);
      EXPECT_GE(none.lower, within - 2 * error);
    }

    const Vec n(random.uniform(-1, 1), i % 3 == 0 ? 0 : random.uniform(-1, 1), i % 5 == 0 ? 0 : 1);
    const double height = n.dot(farthestVertex(mesh, n));
    for (std::size_t t = 0; t < mesh.numTriangles(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_LE(n.dot(mesh.corner(t, k)), height + 0x1p-47 * n.norm() * mesh.largest());
      }
    }
  }
}

}  // namespace

TEST(NearestAndFarthest, BoundsHoldAgainstAllTriangles) {
  for (const NamedMesh& mesh : solidMeshes()) {
    SCOPED_TRACE(mesh.name);
    checkSearches<double>(mesh.mesh, 1, Vec::Zero());
    checkSearches<double>(mesh.mesh, 1, {1000, -300, 0});
    checkSearches<float>(mesh.mesh, 1, {10, 0, 0});
    checkSearches<double>(mesh.mesh, 0x1p200, Vec::Zero());  // beyond the range of floats
    checkSearches<double>(mesh.mesh, 0x1p-200, {3, 0, 0});
    checkSearches<float>(mesh.mesh, 0x1p60, Vec::Zero());
  }
}

}  // namespace kios::testing
