// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

namespace kios {

/// Unit roundoffs.
constexpr double kUlpDouble = 0x1p-53;
constexpr double kUlpFloat = 0x1p-24;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kInfinityFloat = std::numeric_limits<float>::infinity();

// Outward rounding by arithmetic alone: a comparison of a double with its float round trip may be
// folded away by g++ 12's vectoriser, a product can't.

/// A float >= v >= 0 (v below 2^127): (1 + 2^-23)(1 - 2^-24) > 1, and 2^-126 covers subnormals.
inline float roundUpFloat(double v) {
  return v == 0 ? 0.0F : static_cast<float>(v * (1 + 0x1p-23) + 0x1p-126);
}

/// v >= 0 rounded up to S.
template <typename S>
S roundUp(double v);
template <>
inline double roundUp<double>(double v) {
  return v;
}
template <>
inline float roundUp<float>(double v) {
  constexpr float kMax = std::numeric_limits<float>::max();
  return v < 0x1p127 ? roundUpFloat(v) : (v < double{kMax} ? kMax : HUGE_VALF);
}

/// v >= 0 rounded down to S, at least 0.
template <typename S>
S roundDown(double v);
template <>
inline double roundDown<double>(double v) {
  return v;
}
template <>
inline float roundDown<float>(double v) {
  constexpr float kMax = std::numeric_limits<float>::max();
  if (v > double{kMax}) return kMax;
  const double down = v * (1 - 0x1p-23) - 0x1p-126;
  return down > 0 ? static_cast<float>(down) : 0.0F;
}

/// Largest coordinate whose differences and sums of a few stay finite in S.
template <typename S>
constexpr double kMaxCoordinate = sizeof(S) == sizeof(double) ? 0x1p1000 : 0x1p120;
/// For messages.
template <typename S>
constexpr const char* kCoordinateRange = sizeof(S) == sizeof(double) ? "finite, and at most 2^1000"
                                                                     : "finite, and at most 2^120";

}  // namespace kios
