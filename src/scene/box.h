// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace kios::scene {

/// Axis-aligned box in the world.
struct Box {
  double lower[3], upper[3];

  void grow(const Box& o) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], o.lower[i]);
      upper[i] = std::max(upper[i], o.upper[i]);
    }
  }
};

/// Distance of two boxes, up to 8 roundings; infinite boxes touch.
inline double gap(const Box& a, const Box& b) {
  double g[3];
  for (int i = 0; i < 3; ++i) {
    g[i] = std::max(0.0, std::max(a.lower[i] - b.upper[i], b.lower[i] - a.upper[i]));
  }
  const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  if (square < 0x1p1000) return std::sqrt(square);  // squares that underflow make it smaller
  return std::max({g[0], g[1], g[2]});
}

}  // namespace kios::scene
