// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

namespace kios {

/// An integer of any size, and vectors of such.
using Integer = boost::multiprecision::cpp_int;
using IntegerVector = std::array<Integer, 3>;

/// v 2^1074, an integer for every finite double.
Integer integer(double v);
template <typename Vector>
IntegerVector integers(const Vector& p) {
  return {integer(p[0]), integer(p[1]), integer(p[2])};
}

IntegerVector operator-(const IntegerVector& a, const IntegerVector& b);
IntegerVector cross(const IntegerVector& a, const IntegerVector& b);
Integer dot(const IntegerVector& a, const IntegerVector& b);

}  // namespace kios
