// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace kios {

/// v 2^1074, an integer for every finite double.
inline boost::multiprecision::cpp_int integer(double v) {
  using boost::multiprecision::cpp_int;
  int e;
  const double mantissa = std::frexp(v, &e);  // v = mantissa 2^e, |mantissa| in [1/2, 1)
  cpp_int n = static_cast<long long>(std::ldexp(mantissa, 53));
  const int shift = e - 53 + 1074;
  // Subnormals have zeros below bit 0.
  return shift >= 0 ? cpp_int(n << shift) : cpp_int(n / (cpp_int(1) << -shift));
}

}  // namespace kios
