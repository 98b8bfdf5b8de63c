// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <fcl/common/types.h>

namespace kios::scene {

/// Holds a sphere around a content, in its body's frame.
struct Sphere {
  double center[3] = {0, 0, 0};
  double radius = 0;

  /// Returns a bound >= |y| of every y in it.
  double reach() const;
};

/// Upper bound of |(R1 y + T1) - (R0 y + T0)| over all y in the sphere, in exact arithmetic, for
/// any matrices: they need not be rotations. 0 if the two maps are equal; +infinity if it can't be
/// bounded.
template <typename S>
double displacement(const fcl::Matrix3<S>& R0, const fcl::Vector3<S>& T0, const fcl::Matrix3<S>& R1,
                    const fcl::Vector3<S>& T1, const Sphere& sphere);

/// Returns a number >= a + b, which is not NaN; above a if b = 0.
inline double addUp(double a, double b) {
  const double sum = a + b;
  return sum + (std::abs(sum) * 0x1p-52 + std::numeric_limits<double>::denorm_min());
}

}  // namespace kios::scene
