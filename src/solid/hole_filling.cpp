// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/hole_filling.h"

#include <Eigen/Geometry>
#include <utility>

#include "volume/rounding.h"

namespace kios {

double perimeterOf(const std::vector<fcl::Vector3d>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += (corners[(i + 1) % corners.size()] - corners[i]).stableNorm();
  }
  return sum;
}

std::vector<std::array<int, 3>> fillHole(const std::vector<fcl::Vector3d>& corners,
                                         const std::function<bool(int, int)>& avoid) {
  const std::size_t n = corners.size();
  // Areas are in parts of the perimeter's square, so that they are below 1 and don't vanish.
  const double perimeter = perimeterOf(corners);
  const double unit = perimeter > 0 ? 1 / perimeter : 0;
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
    const fcl::Vector3d u = (corners[j] - corners[i]) * unit, v = (corners[k] - corners[i]) * unit;
    return u.cross(v).norm();
  };
  constexpr double kAvoided = 1e6;
  // least[i n + j]: of the part that the diagonal from i to j cuts off, by way of the corner
  // middle.
  std::vector<double> least(n * n, 0);
  std::vector<std::size_t> middle(n * n, 0);
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      double best = kInfinity;
      for (std::size_t m = i + 1; m < j; ++m) {
        const double sum = least[i * n + m] + least[m * n + j] + area(i, m, j);
        if (!(sum < best)) continue;
        best = sum;
        middle[i * n + j] = m;
      }
      const bool diagonal = span + 1 < n;
      if (diagonal && avoid(static_cast<int>(i), static_cast<int>(j))) best += kAvoided;
      least[i * n + j] = best;
    }
  }
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t m = middle[i * n + j];
    triangles.push_back({static_cast<int>(i), static_cast<int>(m), static_cast<int>(j)});
    open.emplace_back(m, j);
    open.emplace_back(i, m);
  }
  return triangles;
}

}  // namespace kios
