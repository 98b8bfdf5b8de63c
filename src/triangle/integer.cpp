// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/integer.h"

#include <cmath>

namespace kios {

int lowestBit(double v) {
  int e;
  const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(v, &e), 53));
  return e - 53 + std::ilogb(static_cast<double>(mantissa & -mantissa));
}

Integer integer(double v, int unit) {
  if (v == 0) return 0;
  const int e = lowestBit(v);
  // A shift would do, but g++ 14 warns of what it makes of Boost's.
  Integer power = 0;
  bit_set(power, static_cast<unsigned>(e - unit));
  return power * static_cast<long long>(std::ldexp(v, -e));
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
