// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kios {

/// Unit roundoffs.
constexpr double kUlpDouble = 0x1p-53;
constexpr double kUlpFloat = 0x1p-24;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kInfinityFloat = std::numeric_limits<float>::infinity();

/// x rounded to the nearest S. The only way from a double to a float here: g++ 12 drops such a
/// rounding and the way back where it packs pairs of scalars, which the empty assembly prevents.
template <typename S>
S roundedTo(double x) {
  auto rounded = static_cast<S>(x);
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
  if (sizeof(S) == sizeof(float)) asm("" : "+x"(rounded));
#elif defined(__GNUC__) && !defined(__clang__)
  if (sizeof(S) == sizeof(float)) asm("" : "+m"(rounded));
#endif
  return rounded;
}
template <typename S, typename Derived>
Eigen::Matrix<S, Derived::RowsAtCompileTime, Derived::ColsAtCompileTime> roundedTo(
    const Eigen::MatrixBase<Derived>& x) {
  return x.unaryExpr([](double v) { return roundedTo<S>(v); });
}

// Outward rounding by arithmetic alone, which asks for no comparison of a double with its float.

/// A float >= v >= 0 (v below 2^127): (1 + 2^-23)(1 - 2^-24) > 1, and 2^-126 covers subnormals.
inline float roundUpFloat(double v) {
  return v == 0 ? 0.0F : roundedTo<float>(v * (1 + 0x1p-23) + 0x1p-126);
}

/// v >= 0 rounded up to S.
template <typename S>
S roundUp(double v) {
  if constexpr (sizeof(S) == sizeof(double)) return v;
  constexpr float kMax = std::numeric_limits<float>::max();
  return v < 0x1p127 ? roundUpFloat(v) : (v < double{kMax} ? kMax : HUGE_VALF);
}

/// v >= 0 rounded down to S, at least 0.
template <typename S>
S roundDown(double v) {
  if constexpr (sizeof(S) == sizeof(double)) return v;
  constexpr float kMax = std::numeric_limits<float>::max();
  if (v > double{kMax}) return kMax;
  const double down = v * (1 - 0x1p-23) - 0x1p-126;
  return down > 0 ? roundedTo<float>(down) : 0.0F;
}

/// A length rounded to the nearest S, as an answer: never to 0 from above.
template <typename S>
S roundedLength(double length) {
  return length > 0 ? std::max(roundedTo<S>(length), std::numeric_limits<S>::denorm_min()) : S(0);
}
/// A length whose roundDown() is at least v, by little more.
template <typename S>
double roundsDownTo(double v) {
  return sizeof(S) == sizeof(double) || !(v > 0) ? v : v * (1 + 0x1p-21) + 0x1p-124;
}

/// Largest coordinate whose differences and sums of a few stay finite in S.
template <typename S>
constexpr double kMaxCoordinate = sizeof(S) == sizeof(double) ? 0x1p1000 : 0x1p120;
/// For messages.
template <typename S>
constexpr const char* kCoordinateRange = sizeof(S) == sizeof(double) ? "finite, and at most 2^1000"
                                                                     : "finite, and at most 2^120";

}  // namespace kios
