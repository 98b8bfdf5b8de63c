// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "scenes/triangle_oracle.h"

// The least values of convex functions, for the oracles of shapes and solids.

namespace kios::testing {

using Real = long double;
using scenes::ExactPoint;
using scenes::ExactTriangle;

/// Golden section for the least value of a convex function on [0, 1]; returns where.
template <typename F>
Real leastAt(const F& f, int steps) {
  const Real phi = (std::sqrt(Real(5)) - 1) / 2;
  Real low = 0, high = 1, a = high - phi, b = low + phi, fa = f(a), fb = f(b);
  Real at = fa <= fb ? a : b, least = std::min(fa, fb);
  const auto note = [&](Real x, Real value) {
    if (value < least) {
      least = value;
      at = x;
    }
  };
  note(0, f(0));
  note(1, f(1));
  for (int i = 0; i < steps; ++i) {
    if (fa <= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - phi * (high - low);
      fa = f(a);
      note(a, fa);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + phi * (high - low);
      fb = f(b);
      note(b, fb);
    }
  }
  return at;
}

/// Returns the least value of a convex function of points over a triangle.
template <typename F>
Real leastOver(const ExactTriangle& t, const F& f) {
  constexpr int kSteps = 64;
  const auto inner = [&](Real u) {
    const ExactPoint from = t[0] + u * (t[1] - t[0]), to = t[0] + u * (t[2] - t[0]);
    const auto at = [&](Real w) { return f(ExactPoint(from + w * (to - from))); };
    return at(leastAt(at, kSteps));
  };
  return inner(leastAt(inner, kSteps));
}

}  // namespace kios::testing
