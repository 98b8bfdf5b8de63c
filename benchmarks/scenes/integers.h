// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <boost/multiprecision/cpp_int.hpp>

// Vectors of integers of any size, by which the exact oracles compute.

namespace kios::scenes {

namespace mp = boost::multiprecision;

// 1024 bits on the stack, enough for the usual pairs; any number of bits on the heap.
using Integer = mp::number<mp::cpp_int_backend<1024, 0>, mp::et_off>;
using Vector = std::array<Integer, 3>;
using Triangle = std::array<Vector, 3>;

constexpr int kNext[3] = {1, 2, 0};

inline Vector operator-(const Vector& a, const Vector& b) {
  return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}

inline Integer dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]),
          Integer(a[0] * b[1] - a[1] * b[0])};
}

// The coordinates as integers in units of 2^exponent, the largest common one.
struct IntegerPoints {
  std::vector<Vector> points;
  int exponent = 0;

  explicit IntegerPoints(const std::vector<Eigen::Vector3d>& given) {
    struct Binary {
      long long mantissa;
      int exponent;
    };
    std::vector<Binary> binaries;
    int least = std::numeric_limits<int>::max();
    for (const Eigen::Vector3d& p : given) {
      for (const double v : {p[0], p[1], p[2]}) {
        int e = 0;
        auto mantissa = static_cast<long long>(std::ldexp(std::frexp(v, &e), 53));
        e -= 53;
        for (; mantissa != 0 && mantissa % 2 == 0; ++e) mantissa /= 2;
        binaries.push_back({mantissa, e});
        if (mantissa != 0) least = std::min(least, e);
      }
    }
    for (std::size_t i = 0; i < given.size(); ++i) {
      Vector v;
      for (std::size_t c = 0; c < 3; ++c) {
        const Binary& b = binaries[3 * i + c];
        if (b.mantissa != 0) v[c] = Integer(b.mantissa) << (b.exponent - least);
      }
      points.push_back(std::move(v));
    }
    if (least != std::numeric_limits<int>::max()) exponent = least;
  }
};

}  // namespace kios::scenes
