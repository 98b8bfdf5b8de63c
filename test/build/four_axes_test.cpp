// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "build/four_axes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "scenes/random.h"

namespace kios::testing {
namespace {

/// By the first lane of four.
Eigen::Matrix3d axesOf(float xx, float xy, float xz, float yy, float yz, float zz) {
  using lanes::broadcast;
  const FourAxes four = principalAxes(Scatter<lanes::Float4>{{},
                                                             {},
                                                             {},
                                                             broadcast(xx),
                                                             broadcast(xy),
                                                             broadcast(xz),
                                                             broadcast(yy),
                                                             broadcast(yz),
                                                             broadcast(zz)});
  Eigen::Matrix3d axes;
  for (int k = 0; k < 3; ++k) {
    for (int r = 0; r < 3; ++r) axes(r, k) = four.column[k][r][0];
  }
  return axes;
}

double orthonormalError(const Eigen::Matrix3d& axes) {
  return (axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm();
}

TEST(FourAxes, AxesAreOrthonormalAndDiagonaliseTheMatrix) {
  scenes::Random random(4);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto spread = [&] { return std::exp(random.uniform(-6, 6)); };
    Eigen::Vector3d values(spread(), spread(), spread());
    if (i % 3 == 1) values[2] = values[1];
    if (i % 5 == 1) values[0] = 0;
    if (i % 7 == 1) values[1] = values[0];
    const Eigen::Quaterniond turn = Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1),
                                                       random.uniform(-1, 1), random.uniform(-1, 1))
                                        .normalized();
    const Eigen::Matrix3d matrix =
        turn.toRotationMatrix() * values.asDiagonal() * turn.toRotationMatrix().transpose();
    const Eigen::Matrix3f f = matrix.cast<float>();
    const Eigen::Matrix3d axes = axesOf(f(0, 0), f(0, 1), f(0, 2), f(1, 1), f(1, 2), f(2, 2));
    ASSERT_LT(orthonormalError(axes), 2e-6);
    const Eigen::Matrix3d diagonal = axes.transpose() * matrix * axes;
    worst = std::max(worst, std::max({std::abs(diagonal(0, 1)), std::abs(diagonal(0, 2)),
                                      std::abs(diagonal(1, 2))}) /
                                matrix.trace());
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(FourAxes, AnyMatrixGivesOrthonormalAxes) {
  const float none = std::numeric_limits<float>::quiet_NaN(),
              huge = std::numeric_limits<float>::infinity();
  for (const float v : {0.0F, 1e-40F, 1e-20F, 1.0F, 1e20F, 1e38F, none, huge, -1.0F}) {
    for (const float w : {0.0F, 1e-38F, 1.0F, 1e38F, none, -huge}) {
      for (const auto& axes : {axesOf(v, 0, 0, w, 0, 0), axesOf(v, w, w, v, w, v),
                               axesOf(v, 0, w, v, 0, v), axesOf(w, v, v, w, v, w)}) {
        EXPECT_LT(orthonormalError(axes), 2e-6) << v << " " << w;
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
