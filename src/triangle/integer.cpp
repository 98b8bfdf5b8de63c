// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/integer.h"

#include <cmath>

namespace kios {

boost::multiprecision::cpp_int integer(double v) {
  int e;
  const double mantissa = std::frexp(v, &e);  // v = mantissa 2^e, |mantissa| in [1/2, 1)
  const int shift = e - 53 + 1074;
  if (shift < 0) return static_cast<long long>(std::ldexp(v, 1074));  // subnormal: below 2^52
  // A shift would do, but g++ 14 warns of what it makes of Boost's.
  boost::multiprecision::cpp_int power = 0;
  bit_set(power, static_cast<unsigned>(shift));
  return power * static_cast<long long>(std::ldexp(mantissa, 53));
}

}  // namespace kios
