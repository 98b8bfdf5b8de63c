// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <fcl/common/types.h>
#include "volume/lanes.h"

namespace kios {

/// Square of the Frobenius norm of R^T R - I, R by its entries in any floating type or several in
/// lanes.
template <typename Entry>
[[gnu::always_inline]] inline auto squaredRotationError(const Entry& r) {
  const auto dot = [&r](int i, int j) {
    return r(0, i) * r(0, j) + r(1, i) * r(1, j) + r(2, i) * r(2, j);
  };
  const auto xx = dot(0, 0) - 1, yy = dot(1, 1) - 1, zz = dot(2, 2) - 1;
  const auto xy = dot(0, 1), xz = dot(0, 2), yz = dot(1, 2);
  return xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz);
}

/// Returns true if each row of R^T R - I, R a rotation in S, is at most 7 u long. Products of the
/// leading 26 bits of entries are exact, and so are their sums, which are below 2.
template <typename S>
bool isRoundedRotation(const fcl::Matrix3<S>& R) {
  constexpr double kSplit = 0x1.8p26, kUlp = 0.5 * double{std::numeric_limits<S>::epsilon()};
  double high[3][3], low[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double r = R(i, j);
      high[j][i] = (r + kSplit) - kSplit;
      low[j][i] = r - high[j][i];
    }
  }
  double squares[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const auto dot = [](const double(&a)[3], const double(&b)[3]) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      };
      const double error = (dot(high[i], high[j]) - (i == j ? 1 : 0)) +
                           (dot(high[i], low[j]) + dot(low[i], high[j]) + dot(low[i], low[j]));
      squares[i] += error * error;
      if (i != j) squares[j] += error * error;
    }
  }
  constexpr double kMost = 7 * kUlp * (7 * kUlp);
  return squares[0] <= kMost && squares[1] <= kMost && squares[2] <= kMost;
}

/// Returns the determinant. Where the norm above is small, it is near 1, or near -1 for a
/// reflection.
template <typename Entry>
[[gnu::always_inline]] inline auto determinant(const Entry& r) {
  return r(0, 0) * (r(1, 1) * r(2, 2) - r(1, 2) * r(2, 1)) +
         r(0, 1) * (r(1, 2) * r(2, 0) - r(1, 0) * r(2, 2)) +
         r(0, 2) * (r(1, 0) * r(2, 1) - r(1, 1) * r(2, 0));
}

/// Turns a frame about a vector of its own of length 1: R becomes R T. Its own axes, which most
/// joints have, take a quarter of the work.
inline void turnAbout(const fcl::Vector3d& axis, double angle, fcl::Matrix3d& R) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    if (axis[j] != 0 || axis[k] != 0) continue;
    const double c = std::cos(angle), s = axis[i] < 0 ? -std::sin(angle) : std::sin(angle);
    const fcl::Vector3d y = R.col(j), z = R.col(k);
    R.col(j) = c * y + s * z;
    R.col(k) = c * z - s * y;
    return;
  }
  R = (R * fcl::AngleAxisd(angle, axis).toRotationMatrix()).eval();
}

/// The largest norm that is allowed.
template <typename S>
inline constexpr double kRotationError = sizeof(S) == sizeof(double) ? 1e-4 : 1e-3;

/// Throws std::invalid_argument: `what` is not rigid, for the one reason or the other.
[[noreturn]] void refuseRotation(const char* what, double error, double allowed);

/// Throws std::invalid_argument if that is too much for a rotation, or NaN, or a reflection. Faces
/// would turn inside out under one, and with them normals, depths and the sides that rays meet.
template <typename S>
void requireRotation(double squared_error, double determinant, const char* what) {
  constexpr double kMost = kRotationError<S>;
  if (!(squared_error <= kMost * kMost && determinant > 0)) {
    refuseRotation(what, std::sqrt(squared_error), kMost);
  }
}

/// Throws std::invalid_argument if either rotation isn't one: for squaredRotationErrors(), which
/// has found that something may be wrong.
template <typename S>
void requireRotations(const fcl::Transform3<S>& X_WA, const fcl::Transform3<S>& X_WB,
                      const lanes::Double2& squares);

/// The sum of the squares of both rotations' errors, |R^T R - I| each (Frobenius). Throws
/// std::invalid_argument if either is too large, NaN, or a reflection.
template <typename S>
[[gnu::always_inline]] inline double squaredRotationErrors(const fcl::Transform3<S>& X_WA,
                                                           const fcl::Transform3<S>& X_WB) {
  constexpr double kMost = kRotationError<S> * kRotationError<S>;
  const auto &m_a = X_WA.matrix(), &m_b = X_WB.matrix();
  const auto entries = [&](int i, int j) {
    return lanes::Double2{double{m_a(i, j)}, double{m_b(i, j)}};
  };
  const lanes::Double2 squares = squaredRotationError(entries);
  if (!lanes::bothLess(squares, lanes::Double2{kMost, kMost}, lanes::Double2{},
                       determinant(entries))) {
    requireRotations<S>(X_WA, X_WB, squares);
  }
  return squares[0] + squares[1];
}

/// Throws std::invalid_argument: |R_A^T (t_B - t_A)|_1 is NaN or beyond kMaxCoordinate. The pose to
/// blame is the one that is wrong by itself.
template <typename S>
[[noreturn]] void refuseTranslations(const fcl::Transform3<S>& X_WA,
                                     const fcl::Transform3<S>& X_WB);

}  // namespace kios
