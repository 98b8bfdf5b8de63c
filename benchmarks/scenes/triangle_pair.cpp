// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "triangle_pair.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace kios::scenes {

long double extent(const TrianglePair& pair) {
  Eigen::AlignedBox<long double, 3> box;
  for (const auto& corners : {pair.a, pair.b}) {
    for (const Eigen::Vector3d& p : corners) box.extend(p.cast<long double>());
  }
  return box.sizes().norm();
}

double magnitude(const TrianglePair& pair) {
  double largest = 0;
  for (const auto& corners : {pair.a, pair.b}) {
    for (const Eigen::Vector3d& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace kios::scenes
