// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_pair.h"

#include <algorithm>

namespace kios::scenes {

long double extent(const TrianglePair& pair) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  Vector lower = pair.a[0].cast<long double>(), upper = lower;
  for (const auto& corners : {pair.a, pair.b}) {
    for (const Eigen::Vector3d& p : corners) {
      lower = lower.cwiseMin(p.cast<long double>());
      upper = upper.cwiseMax(p.cast<long double>());
    }
  }
  return (upper - lower).norm();
}

double magnitude(const TrianglePair& pair) {
  double largest = 0;
  for (const auto& corners : {pair.a, pair.b}) {
    for (const Eigen::Vector3d& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace kios::scenes
