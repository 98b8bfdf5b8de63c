// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "triangle/scaled_origin.h"
#include "triangle/twofold.h"

// Determinants of 3x3 matrices of differences, in the stages that exact predicates take.

namespace kios {

/// In twofold numbers. Off by at most 63 u^2 permanent (a minor by 15, its product with the third
/// difference by 20 more, their sum by 28), u = 2^-53, if nothing underflows.
struct TwofoldDeterminant {
  Twofold value;
  double permanent;

  double rounded() const { return value.high + value.low; }
  /// With what may underflow where coordinates are below 2^201.
  double error() const { return 80 * 0x1p-53 * 0x1p-53 * permanent + 0x1p-800; }
};

inline TwofoldDeterminant determinant(const Twofold (&m)[3][3]) {
  TwofoldDeterminant det = {{0, 0}, 0};
  for (int r = 0; r < 3; ++r) {
    const Twofold &x = m[(r + 1) % 3][0], &y = m[(r + 1) % 3][1];
    const Twofold &u = m[(r + 2) % 3][0], &v = m[(r + 2) % 3][1];
    const Twofold left = x * v, right = u * y;
    det.value = det.value + (left - right) * m[r][2];
    det.permanent += (std::abs(left.high) + std::abs(right.high)) * std::abs(m[r][2].high);
  }
  return det;
}

inline Sign signBeyond(double value, double error) {
  return value > error ? kPlus : (value < -error ? kMinus : kUnknown);
}

/// The sign of x . (y x z) by plain arithmetic, each coordinate of y and z a rounded difference and
/// of x one or given: (1 + u)^7, so 7 u of the permanent as it is, 8 u as it is computed. Underflow
/// adds less than 2^-800.
inline Sign filteredSign(const double* x, const double* y, const double* z) {
  const double a = y[1] * z[2], b = y[2] * z[1], c = y[2] * z[0], d = y[0] * z[2], e = y[0] * z[1],
               f = y[1] * z[0];
  const double value = x[0] * (a - b) + x[1] * (c - d) + x[2] * (e - f);
  const double permanent = std::abs(x[0]) * (std::abs(a) + std::abs(b)) +
                           std::abs(x[1]) * (std::abs(c) + std::abs(d)) +
                           std::abs(x[2]) * (std::abs(e) + std::abs(f));
  return signBeyond(value, 8 * 0x1p-53 * permanent + 0x1p-800);
}

}  // namespace kios
