// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Asks the addon fcl_kios::clearance for the distance of two points as volumes.
#include <fcl_kios/clearance.h>
#include <fcl_kios/fcl_kios.h>

#include <cmath>

int main() {
  kios::kIOSd a, b;
  a += fcl::Vector3d(0, 0, 0);
  b += fcl::Vector3d(3, 4, 0);
  const bool right =
      std::abs(kios::exactDistance(a, b).distance - 5) <= 1e-10 &&
      std::abs(kios::minimumClearance(
                   kios::Coverd({a}), kios::Coverd({b}),
                   kios::RelativePose<double>(fcl::Matrix3d::Identity(), fcl::Vector3d::Zero()))
                   .value -
               5) <= 1e-10;
  return right ? 0 : 1;
}
