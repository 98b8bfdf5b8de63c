// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/support.h"

#include <algorithm>
#include <cmath>

#include "volume/rounding.h"

namespace kios::articulated {
namespace {

using Eigen::Vector3d;

// Points by coordinate, so that the loop over them runs in SIMD registers.
double farthest(const std::vector<double> (&p)[3], const Vector3d& n) {
  const std::size_t count = p[0].size();
  const double *x = p[0].data(), *y = p[1].data(), *z = p[2].data();
  constexpr std::size_t kLanes = 8;
  double most[kLanes];
  std::fill_n(most, kLanes, -kInfinity);
  for (std::size_t i = 0; i < count; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double height = n.x() * x[i + k] + n.y() * y[i + k] + n.z() * z[i + k];
      most[k] = most[k] > height ? most[k] : height;
    }
  }
  return *std::max_element(most, most + kLanes);
}

}  // namespace

// Heights are rounded up by more than the three products and sums lose, of points and directions as
// they are stored: 4 u |n|_1 |x|, u = 2^-53.
SupportTable::SupportTable(const std::vector<Vector3d>& points, double margin) {
  std::vector<double> p[3];
  double size = margin;
  for (int c = 0; c < 3; ++c) {
    for (const Vector3d& x : points) p[c].push_back(x[c]);
    while (p[c].size() % 8 != 0) p[c].push_back(p[c].back());
    for (const double x : p[c]) size = std::max(size, std::abs(x));
  }
  heights_.assign(8 * kSide * kSide, 0);
  for (int i = 0; i <= kCuts; ++i) {
    for (int j = 0; i + j <= kCuts; ++j) {
      const Vector3d g = Vector3d(i, j, kCuts - i - j) / kCuts;
      for (int octant = 0; octant < 8; ++octant) {
        Vector3d n = g;
        int first = octant;  // the octant that holds it first, as borders are shared
        for (int c = 0; c < 3; ++c) {
          if (g[c] == 0) first &= ~(1 << c);
          if ((octant & (1 << c)) != 0) n[c] = -n[c];
        }
        double& height = heights_[indexOf(octant, i, j)];
        if (first != octant) {
          height = heights_[indexOf(first, i, j)];
        } else {
          height = farthest(p, n) + margin * n.norm() + 0x1p-49 * size;
        }
      }
    }
  }
}

// The barycentric coordinates of n in its triangle sum to |n|_1 but for 8 u, which times heights is
// far below the margin of 2^-48 |n|_1 size that the sum of three heights gets here.
double SupportTable::along(const Vector3d& n, Vector3d* point) const {
  const double length = n.lpNorm<1>();
  if (!(length > 0)) {
    if (point) point->setZero();
    return 0;
  }
  int octant = 0;
  for (int c = 0; c < 3; ++c) octant |= n[c] < 0 ? 1 << c : 0;
  const double x = std::abs(n[0]) / length * kCuts, y = std::abs(n[1]) / length * kCuts;
  const int i = std::min(static_cast<int>(x), kCuts - 1);
  const int j = std::min(static_cast<int>(y), kCuts - 1 - i);
  const double u = x - i, v = y - j;
  const double b = heights_[indexOf(octant, i + 1, j)], c = heights_[indexOf(octant, i, j + 1)];
  double a, by_x, by_y, height;
  if (u + v <= 1 || i + j == kCuts - 1) {
    a = heights_[indexOf(octant, i, j)];
    by_x = b - a;
    by_y = c - a;
    height = a + u * by_x + v * by_y;
  } else {  // the triangle on the other side
    a = heights_[indexOf(octant, i + 1, j + 1)];
    by_x = a - c;
    by_y = a - b;
    height = a + (u - 1) * by_x + (v - 1) * by_y;
  }
  if (point) {
    // Along the triangle by_x is 1 / kCuts of p_x - p_z, by_y of p_y - p_z, in the octant's signs.
    const double z = height - x * by_x - y * by_y;
    const Vector3d p(z + kCuts * by_x, z + kCuts * by_y, z);
    for (int k = 0; k < 3; ++k) (*point)[k] = (octant & (1 << k)) != 0 ? -p[k] : p[k];
  }
  return (height + 0x1p-48 * (std::abs(a) + std::abs(b) + std::abs(c))) * length;
}

}  // namespace kios::articulated
