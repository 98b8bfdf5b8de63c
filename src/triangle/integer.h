// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

namespace kios {

/// An integer of any size, and vectors of such.
using Integer = boost::multiprecision::cpp_int;
using IntegerVector = std::array<Integer, 3>;

/// v 2^-unit, which must be an integer, as it is for every finite double by default.
Integer integer(double v, int unit = -1074);
template <typename Vector>
IntegerVector integers(const Vector& p, int unit = -1074) {
  return {integer(p[0], unit), integer(p[1], unit), integer(p[2], unit)};
}
/// The exponent of the lowest bit that is set in v, which is not 0.
int lowestBit(double v);

IntegerVector operator-(const IntegerVector& a, const IntegerVector& b);
IntegerVector cross(const IntegerVector& a, const IntegerVector& b);
Integer dot(const IntegerVector& a, const IntegerVector& b);

}  // namespace kios
