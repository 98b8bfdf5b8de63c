// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The gradient of the exact distance: against convexity, and continuous along paths (paper, III-D).
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fcl_kios/clearance.h"
#include "fcl_kios/fcl_kios.h"
#include "scenes/mesh.h"
#include "scenes/shapes.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

/// Holds a pair of fitted volumes of size about 1, apart.
struct OrdinaryPair {
  explicit OrdinaryPair(Random& random) {
    const auto draw = [&random] {
      const auto shape = static_cast<PointShape>(below(random, kPointShapes));
      return fitted(place<double>(random, shapePoints(random, shape, 3 + below(random, 8)), 0, 1));
    };
    a = draw();
    b = draw();
    R = randomRotation(random);
    T = random.uniform(0.2, 4) * randomDirection(random);
  }
  ExactDistance at(const fcl::Matrix3d& rotation, const fcl::Vector3d& translation) const {
    return exactDistance(a, b, RelativePose<double>(rotation, translation));
  }
  kIOSd a, b;
  fcl::Matrix3d R;
  fcl::Vector3d T;
};

// The distance is a convex function of the translation: its gradient is a lower bound of every
// difference, however long the step. No rounding hides in that.
TEST(ExactGradient, SupportsTheConvexDistance) {
  Random random(32);
  for (int i = 0; i < 5'000; ++i) {
    const OrdinaryPair pair(random);
    const ExactDistance exact = pair.at(pair.R, pair.T);
    if (!exact.apart()) continue;
    for (int k = 0; k < 4; ++k) {
      const fcl::Vector3d h = std::pow(10.0, -random.uniform(-1, 9)) * randomDirection(random);
      const ExactDistance moved = pair.at(pair.R, pair.T + h);
      const double bound = exact.distance + exact.normal.dot(h);
      ASSERT_GE(moved.distance + moved.error, bound - 1e-12) << i;
      ASSERT_LE(std::abs(moved.distance - exact.distance), h.norm() + 1e-12) << i;
    }
  }
}

// B slides past A: their nearest points run over sphere, circle and vertex, and never jump.
TEST(ExactGradient, IsContinuousAcrossTheFeatures) {
  Random random(34);
  for (int i = 0; i < 40; ++i) {
    const kIOSd a = fitted(shapePoints(random, PointShape::kTriangle, 3)),
                b = fitted(shapePoints(random, PointShape::kSliver, 6));
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d e = randomDirection(random), f = randomDirection(random).cross(e);
    if (!(f.norm() > 0.1)) continue;
    constexpr int kSteps = 4'000;
    ExactDistance before;
    fcl::Vector3d T_before = fcl::Vector3d::Zero();
    for (int s = 0; s <= kSteps; ++s) {
      const double angle = 2 * fcl::constants<double>::pi() * s / kSteps;
      const fcl::Vector3d T =
          4.5 * (std::cos(angle) * e + std::sin(angle) * f.normalized()) + a.center0;
      const ExactDistance now = exactDistance(a, b, RelativePose<double>(R, T));
      ASSERT_TRUE(now.apart());
      ASSERT_LE(now.error, 1e-12);
      if (s > 0) {
        // A step is 0.0071 long; the bodies are at least 1 apart and of radius at most 2.
        ASSERT_LE((now.normal - before.normal).norm(), 0.03) << i << " at step " << s;
        ASSERT_LE((now.p - before.p).norm() + (now.q - before.q).norm(), 0.1) << i;
        // Convex: the change lies between what the gradients at both ends foresee.
        const double change = now.distance - before.distance;
        ASSERT_GE(change, before.normal.dot(T - T_before) - 1e-12) << i << " at step " << s;
        ASSERT_LE(change, now.normal.dot(T - T_before) + 1e-12) << i << " at step " << s;
      }
      before = now;
      T_before = T;
    }
  }
}

}  // namespace
}  // namespace kios::testing
