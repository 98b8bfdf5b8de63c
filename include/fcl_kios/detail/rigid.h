// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <fcl/common/types.h>

namespace kios {

/// A pose that lies in memory alike whatever a program's flags are, as fcl::Transform3d doesn't.
/// Each converts to the other.
using UnalignedPose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

namespace detail {

// Products whose sums have one order on every machine. Eigen's order depends on the machine's
// vectors, and where it can, as on ARM, Eigen fuses products with sums: answers would differ in
// their last bits.

/// Returns a . b.
template <typename S>
S dot(const fcl::Vector3<S>& a, const fcl::Vector3<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns R x.
template <typename S>
fcl::Vector3<S> rotate(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& x) {
  return {R(0, 0) * x[0] + R(0, 1) * x[1] + R(0, 2) * x[2],
          R(1, 0) * x[0] + R(1, 1) * x[1] + R(1, 2) * x[2],
          R(2, 0) * x[0] + R(2, 1) * x[1] + R(2, 2) * x[2]};
}

/// Returns X x.
template <typename S>
fcl::Vector3<S> transform(const fcl::Transform3<S>& X, const fcl::Vector3<S>& x) {
  return rotate<S>(X.linear(), x) + X.translation();
}

}  // namespace detail
}  // namespace kios
