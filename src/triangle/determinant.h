// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "triangle/expansion.h"

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

/// Exactly, if nothing underflows.
inline Expansion<192> determinant(const Expansion<2> (&m)[3][3]) {
  const auto minor = [&m](int r, int s) {
    return sum(product(m[r][0], m[s][1]), negated(product(m[s][0], m[r][1])));
  };
  return sum(sum(product(minor(1, 2), m[0][2]), product(minor(2, 0), m[1][2])),
             product(minor(0, 1), m[2][2]));
}

}  // namespace kios
