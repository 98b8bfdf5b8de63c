// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance where floats can't serve: pairs are searched in double.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

/// Returns the distance, and that it was searched where it should be.
double distanceOf(const Modeld& a, const Frame& frame, const Modeld& b, long long tree_searches,
                  const fcl::DistanceRequestd& request = fcl::DistanceRequestd()) {
  fcl::DistanceResultd result;
  SearchCounts counts;
  const double d = distanceMeshes(a, frame.X_WA, b, frame.X_WB, request, result, &counts);
  EXPECT_EQ(counts.tree_searches, tree_searches);
  EXPECT_GT(counts.expansions + counts.leaf_pairs, 0);
  return d;
}

TEST(EngineQueries, ScalesBeyondFloatsAreSearchedInDouble) {
  const Mesh one = scenes::bumpyTorus(140), other = scenes::icosphere(0.6, 1);
  const auto scaled = [](Mesh mesh, double scale) {
    for (Vector3d& p : mesh.vertices) p *= scale;
    return mesh;
  };
  for (const double scale : {1e-20, 1e-13, 1e-3, 1.0, 1e8, 1e15}) {
    const Mesh mesh_a = scaled(one, scale), mesh_b = scaled(other, scale);
    const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);
    const bool beyond = scale < 1e-10 || scale > 1e12;
    for (Frame frame : randomFrames(8, 1.5, 23)) {
      frame.X_WA.translation() *= scale;
      frame.X_WB.translation() *= scale;
      const double exact = leafDistance(mesh_a, mesh_b, frame);
      EXPECT_NEAR(distanceOf(*a, frame, *b, beyond), exact, 1e-14 * scale);
      EXPECT_EQ(distanceOf(*a, frame, *b, beyond) == 0, exact == 0);
      fcl::CollisionResultd contacts;
      fcl::collide(a.get(), frame.X_WA, b.get(), frame.X_WB, fcl::CollisionRequestd(kAllContacts),
                   contacts);
      EXPECT_EQ(contactPairs(contacts), leafPairs(mesh_a, mesh_b, frame));
    }
  }
}

TEST(EngineQueries, FarApartInDoubleAndOfVeryDifferentSize) {
  const Mesh mesh = scenes::icosphere(1, 1);
  Mesh small = mesh;
  for (Vector3d& p : small.vertices) p *= 1e-7;
  const auto a = kiosModel(mesh), b = kiosModel(small);
  for (const Frame& frame : randomFrames(5, 1, 25)) {
    const Frame far = {frame.X_WA, Eigen::Translation3d(1e7, 0, -3) * frame.X_WB};
    const double exact = leafDistance(mesh, mesh, far);
    EXPECT_NEAR(distanceOf(*a, far, *a, 1), exact, 1e-15 * exact);
    EXPECT_NEAR(distanceOf(*a, frame, *b, 0), leafDistance(mesh, small, frame), 1e-14);
  }
}

}  // namespace
}  // namespace kios::testing
