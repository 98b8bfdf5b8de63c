// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies a hair above shapes with a flat top, and a hair below it, in worlds turned at random: the
// verdict is that of the gap, and where it is wide enough for double no triangle is looked at.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "fcl_kios/contact.h"
#include "fcl_kios/model.h"
#include "scalars.h"
#include "scenes/cad_shapes.h"
#include "scenes/shape_geometry.h"
#include "shapes.h"

namespace kios::testing {
namespace {

/// Shapes whose top is at z = 0, and so their poses.
template <typename S>
struct FlatTop {
  std::shared_ptr<fcl::CollisionGeometry<S>> shape;
  double top;  ///< its height in its own frame
};

template <typename S>
std::vector<FlatTop<S>> flatTops() {
  const Mesh slab = scenes::subdividedBox({4, 4, 0.1}, 1);
  return {{std::make_shared<fcl::Box<S>>(S(4), S(4), S(0.1)), 0.05},
          {std::make_shared<fcl::Cylinder<S>>(S(2), S(0.1)), 0.05},
          {scenes::convexOf<S>(slab), 0.05}};
}

KIOS_SCALAR_SUITE(HoveringOverShapes);

TYPED_TEST(HoveringOverShapes, TheGapDecidesAndNoTriangleIsLookedAt) {
  using S = TypeParam;
  constexpr bool kDouble = sizeof(S) == sizeof(double);
  const double least = kDouble ? 1e-12 : 1e-5;  // what poses round
  Random random(3);
  long wrong = 0, touching = 0, apart = 0;
  long long kernels = 0, hovering = 0;
  for (const FlatTop<S>& place : flatTops<S>()) {
    for (const Mesh& body :
         {scenes::subdividedBox({0.3, 0.2, 0.15}, 1), scenes::stripCylinder(12, 0.3, 0.05),
          scenes::stripCylinder(60, 0.4, 0.015), scenes::uvSphere(0.2, 10, 12)}) {
      const auto model = makeModel<S>(MeshIn<S>(body).vertices, body.triangles);
      double low = std::numeric_limits<double>::infinity();
      for (const fcl::Vector3d& v : body.vertices) low = std::min(low, v.z());
      for (double gap = least; gap < 0.1; gap *= 3) {
        for (const double sign : {-1.0, 1.0}) {
          fcl::Transform3d X_SM(
              Eigen::AngleAxisd(random.uniform(0, 6), fcl::Vector3d::UnitZ()).toRotationMatrix());
          X_SM.translation() = fcl::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1),
                                             place.top + sign * gap - low);
          fcl::Transform3d X_WS(Eigen::AngleAxisd(random.uniform(0, 6), inCube(random).normalized())
                                    .toRotationMatrix());
          X_WS.translation() = inCube(random);
          fcl::CollisionRequest<S> request(std::numeric_limits<int>::max(), true);
          fcl::CollisionResult<S> result;
          SearchCounts counts;
          const auto found = collideShape<S>(*model, (X_WS * X_SM).template cast<S>(), *place.shape,
                                             X_WS.template cast<S>(), request, result, &counts);
          wrong += (found > 0) != (sign < 0);
          ++(found > 0 ? touching : apart);
          if (sign < 0 || gap < (kDouble ? 4e-6 : 1e-3)) continue;
          ++hovering;
          kernels += counts.leaf_kernels;
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(touching, 80);
  EXPECT_GT(apart, 80);
  EXPECT_GT(hovering, 40);
  EXPECT_EQ(kernels, 0);
}

}  // namespace
}  // namespace kios::testing
