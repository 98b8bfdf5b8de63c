// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Turns about a frame's own axes, which take a way of their own, are those about any axis.

#include <fcl/common/types.h>
#include <gtest/gtest.h>

#include <vector>

#include "scenes/triangle_families.h"
#include "volume/rotation.h"

namespace kios::testing {
namespace {

using fcl::Matrix3d;
using fcl::Vector3d;

TEST(TurnAbout, IsRodriguesRotation) {
  scenes::Random random(8);
  std::vector<Vector3d> axes = {Vector3d(1, 2, -2) / 3, Vector3d(0, 0.6, -0.8)};
  for (int i = 0; i < 3; ++i) {
    for (const double sign : {1.0, -1.0}) axes.push_back(sign * Vector3d::Unit(i));
  }
  for (const Vector3d& axis : axes) {
    for (const double angle : {0.0, 1e-9, 0.7, -2.0, 3.14159, 1e3 * random.unit()}) {
      const Matrix3d before =
          fcl::AngleAxisd(3 * random.unit(), Vector3d(2, -1, 2) / 3).toRotationMatrix();
      Matrix3d R = before;
      turnAbout(axis, angle, R);
      const Matrix3d expected = before * fcl::AngleAxisd(angle, axis).toRotationMatrix();
      EXPECT_LE((R - expected).norm(), 0x1p-50) << axis.transpose() << ", " << angle;
    }
  }
}

}  // namespace
}  // namespace kios::testing
