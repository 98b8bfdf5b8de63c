// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/integer.h"

#include <cmath>

namespace kios {

Integer integer(double v) {
  int e;
  const double mantissa = std::frexp(v, &e);  // v = mantissa 2^e, |mantissa| in [1/2, 1)
  const int shift = e - 53 + 1074;
  if (shift < 0) return static_cast<long long>(std::ldexp(v, 1074));  // subnormal: below 2^52
  // A shift would do, but g++ 14 warns of what it makes of Boost's.
  Integer power = 0;
  bit_set(power, static_cast<unsigned>(shift));
  return power * static_cast<long long>(std::ldexp(mantissa, 53));
}

IntegerVector operator-(const IntegerVector& a, const IntegerVector& b) {
  return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}

IntegerVector cross(const IntegerVector& a, const IntegerVector& b) {
  return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]),
          Integer(a[0] * b[1] - a[1] * b[0])};
}

Integer dot(const IntegerVector& a, const IntegerVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace kios
