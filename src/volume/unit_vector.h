// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace kios {

/// Returns v / |v| for every v, however small or large; v itself if it is zero or not finite.
/// Eigen's stableNormalized() divides zero by zero, for programs that trap invalid operations.
template <typename Expression>
typename Expression::PlainObject unitVector(const Eigen::MatrixBase<Expression>& expression) {
  using Vector = typename Expression::PlainObject;
  const Vector v = expression;
  return v.isZero(0) ? v : Vector(v.stableNormalized());
}

}  // namespace kios
