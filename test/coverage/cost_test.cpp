// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Cost sources of a mesh and each shape: FCL.md 3, 10 and 23. Contacts need both occupied, sources
// neither free; sources lie where mesh and shape do, in the world.

#include <gtest/gtest.h>

#include "coverage/shape_distance.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

constexpr double kDensities[] = {0.125, 0.5, 2};  // free, uncertain, occupied

void setDensity(fcl::CollisionGeometryd& geometry, double density) {
  geometry.threshold_free = 0.25;
  geometry.threshold_occupied = 0.75;
  geometry.cost_density = density;
}

TEST(ShapeCosts, OccupancyDecidesBetweenContactsAndSources) {
  const auto model = scenes::buildModel<kIOSd>(scenes::icosphere(0.5, 1));
  const fcl::Transform3d X_WA(Eigen::Translation3d(100, 0, 0));
  const fcl::Transform3d X_WB = X_WA * Eigen::Translation3d(0.3, 0.1, 0.1);
  for (const auto& [name, shape] : shapeCases<double>()) {
    for (const double of_mesh : kDensities) {
      for (const double of_shape : kDensities) {
        for (const bool mesh_first : {true, false}) {
          for (const bool approximate : {true, false}) {
            SCOPED_TRACE(name + " " + std::to_string(of_mesh) + " " + std::to_string(of_shape) +
                         (approximate ? " approximate" : ""));
            setDensity(*model, of_mesh);
            setDensity(*shape.geometry, of_shape);
            const fcl::CollisionGeometryd *a = model.get(), *b = shape.geometry.get();
            const fcl::CollisionRequestd request(testing::kAllContacts, false, 100, true,
                                                 approximate);
            fcl::CollisionResultd result;
            if (mesh_first) fcl::collide(a, X_WA, b, X_WB, request, result);
            if (!mesh_first) fcl::collide(b, X_WB, a, X_WA, request, result);
            EXPECT_EQ(result.numContacts() > 0, of_mesh == 2 && of_shape == 2);
            std::vector<fcl::CostSourced> sources;
            result.getCostSources(sources);
            EXPECT_EQ(!sources.empty(), of_mesh > 0.25 && of_shape > 0.25);
            for (const fcl::CostSourced& source : sources) {
              EXPECT_DOUBLE_EQ(source.cost_density, of_mesh * of_shape);
              for (int i = 0; i < 3; ++i) {  // within the mesh's box, with room for approximation
                EXPECT_GE(source.aabb_min[i], X_WA.translation()[i] - 1);
                EXPECT_LE(source.aabb_max[i], X_WA.translation()[i] + 1);
                EXPECT_LE(source.aabb_min[i], source.aabb_max[i]);
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace kios::coverage
