// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

// Numbers in two doubles (Dekker, "A floating-point technique for extending the available
// precision", 1971), which decide nearly all determinants that a filter leaves open.

namespace kios {

/// a + b = sum + error, exactly.
inline void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bb = sum - a;
  error = (a - (sum - bb)) + (b - bb);
}

/// a b = product + error, exactly (Dekker).
inline void twoProduct(double a, double b, double& product, double& error) {
  constexpr double kSplit = 0x1p27 + 1;
  const double ca = kSplit * a, cb = kSplit * b;
  const double a1 = ca - (ca - a), a0 = a - a1, b1 = cb - (cb - b), b0 = b - b1;
  product = a * b;
  error = a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0);
}

/// high + low, not normalised: |low| is a few u (2^-53) times the numbers it was made from. Twice
/// the digits of a double for a few times the cost.
struct Twofold {
  double high, low;
};

/// a - b, exactly.
inline Twofold twofoldDifference(double a, double b) {
  Twofold d;
  twoSum(a, -b, d.high, d.low);
  return d;
}

inline Twofold operator+(const Twofold& a, const Twofold& b) {
  Twofold s;
  twoSum(a.high, b.high, s.high, s.low);
  s.low += a.low + b.low;
  return s;
}

inline Twofold operator-(const Twofold& a, const Twofold& b) {
  return a + Twofold{-b.high, -b.low};
}

inline Twofold operator*(const Twofold& a, const Twofold& b) {
  Twofold p;
  twoProduct(a.high, b.high, p.high, p.low);
  p.low += a.high * b.low + a.low * b.high;
  return p;
}

/// a d - b c with nearly all its digits, however much cancels.
inline double accurateMinor(const Twofold& a, const Twofold& b, const Twofold& c,
                            const Twofold& d) {
  const Twofold minor = a * d - b * c;
  return minor.high + minor.low;
}

}  // namespace kios
