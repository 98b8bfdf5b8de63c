// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace kios::scene {

/// Holds an axis-aligned box in the world.
struct Box {
  double lower[3], upper[3];

  void grow(const Box& o) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], o.lower[i]);
      upper[i] = std::max(upper[i], o.upper[i]);
    }
  }
};

/// Returns the squared distance of two boxes, up to 6 roundings; infinite boxes touch.
inline double squaredGap(const Box& a, const Box& b) {
  const auto larger = [](double x, double y) { return x > y ? x : y; };  // without a branch
  const auto side = [&](int i) {
    return larger(0.0, larger(a.lower[i] - b.upper[i], b.lower[i] - a.upper[i]));
  };
  const double x = side(0), y = side(1), z = side(2);
  return x * x + y * y + z * z;
}

/// Returns a bound of how much nearer `to` lies to any other box than `from`.
inline double shift(const Box& from, const Box& to) {
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const double down = from.lower[i] > to.lower[i] ? from.lower[i] - to.lower[i] : 0,
                 up = to.upper[i] > from.upper[i] ? to.upper[i] - from.upper[i] : 0;
    square += std::max(down, up) * std::max(down, up);
  }
  return std::sqrt(square) * (1 + 0x1p-50) + 1e-150;
}

/// Returns a number that squaredGap() exceeds only if the distance exceeds `limit`: it covers
/// rounding, and what underflows.
inline double squaredLimit(double limit) {
  if (limit < 0) limit = 0;  // bodies of FCL that overlap have negative distances
  return limit * limit * (1 + 0x1p-40) + 1e-300;
}

}  // namespace kios::scene
