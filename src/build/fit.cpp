// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "build/lane_fit.h"
#include "build/measure.h"
#include "volume/balls.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Points relative to the first, in units of 2^exponent, four a row; what is left of the last row
/// repeats the first point.
template <typename S>
int rowsOf(const fcl::Vector3<S>* points, int n, PointQuad* rows) {
  const double x0 = points[0][0], y0 = points[0][1], z0 = points[0][2];
  double largest = 0;
  const auto write = [&](auto scale) {
    for (int i = 0; i < n || i % 4 != 0; ++i) {
      const fcl::Vector3<S>& p = points[i < n ? i : 0];
      const double x = p[0] - x0, y = p[1] - y0, z = p[2] - z0;
      largest = std::max(std::max(largest, std::abs(x)), std::max(std::abs(y), std::abs(z)));
      PointQuad& row = rows[i / 4];
      row.x[i % 4] = roundedTo<float>(scale(x));
      row.y[i % 4] = roundedTo<float>(scale(y));
      row.z[i % 4] = roundedTo<float>(scale(z));
    }
  };
  write([](double v) { return v; });
  const int exponent = capExponent(largest);
  if (exponent != 0) write([&](double v) { return scaled(v, -exponent); });
  return exponent;
}

}  // namespace

template <typename S>
void fit(const fcl::Vector3<S>* points, int n, kIOS<S>& bv) {
  requireUsable(points, n);
  bv = kIOS<S>();
  if (n == 0) return;
  const int num_rows = (n + 3) / 4;
  PointRows rows;
  std::vector<PointQuad> many(num_rows > PointRows::kMost ? static_cast<std::size_t>(num_rows) : 0);
  const int exponent = rowsOf(points, n, many.empty() ? rows.points : many.data());
  SphereSites sites;
  if (n == 3) {
    const PointQuad& t = rows.points[0];
    for (int k = 2; k >= 0; --k) {
      rows.points[k] = {lanes::broadcast(t.x[k]), lanes::broadcast(t.y[k]),
                        lanes::broadcast(t.z[k])};
    }
    sites = placeTriangles(rows);
  } else {
    if (many.empty()) {
      rows.count = num_rows;
      for (int i = 0; i < 4 * num_rows; ++i) rows.weight[i / 4][i % 4] = i < n ? 1 : 0;
    } else {
      const Extremes extremes = extremesOf(many.data(), many.size());
      rows = rowsOf(&extremes, 1);
    }
    sites = placeSpheres(rows, Sets::kOne);
  }
  for (int c = 0; c < 3; ++c) {
    bv.center0[c] =
        roundedTo<S>(double{points[0][c]} + scaled(double{sites.center[c][0]}, exponent));
  }
  for (int i = 0; i < 4; ++i) {
    bv.cap_x[i] = sites.cap[i][0][0];
    bv.cap_y[i] = sites.cap[i][1][0];
    bv.cap_z[i] = sites.cap[i][2][0];
  }
  measure(points, n, exponent, sites.k[0], bv);
}

template void fit(const fcl::Vector3<double>*, int, kIOS<double>&);
template void fit(const fcl::Vector3<float>*, int, kIOS<float>&);

}  // namespace kios
