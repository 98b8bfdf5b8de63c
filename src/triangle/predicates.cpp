// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/predicates.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "triangle/expansion.h"

namespace kios {
namespace {

using boost::multiprecision::cpp_int;

int signOf(double v) { return (v > 0) - (v < 0); }

/// v 2^1074, an integer for every finite double.
cpp_int integer(double v) {
  int e;
  const double mantissa = std::frexp(v, &e);  // v = mantissa 2^e, |mantissa| in [1/2, 1)
  cpp_int n = static_cast<long long>(std::ldexp(mantissa, 53));
  const int shift = e - 53 + 1074;
  // Subnormals have zeros below bit 0.
  return shift >= 0 ? cpp_int(n << shift) : cpp_int(n / (cpp_int(1) << -shift));
}

/// An integer, rounded to 53 bits and split into mantissa and exponent.
template <typename Rounded>
Rounded roundedInteger(const cpp_int& n) {
  if (n == 0) return {0, 0};
  const cpp_int magnitude = abs(n);
  const long bits = static_cast<long>(msb(magnitude)) + 1, drop = std::max(0L, bits - 62);
  const double mantissa = static_cast<double>(static_cast<long long>(magnitude >> drop));
  return {n < 0 ? -mantissa : mantissa, drop};
}

template <typename Rounded, int N>
Rounded roundedExpansion(const Expansion<N>& e) {
  double sum = 0;
  for (int i = 0; i < e.size; ++i) sum += e.terms[i];
  return {sum, 0};
}

}  // namespace

PairPredicates::PairPredicates(const Coordinates& points) : given_(points), scaled_(points) {
  double largest = 0, least = 1;
  for (const auto& p : points) {
    for (const double v : p) largest = std::max(largest, std::abs(v));
  }
  if (!(largest >= 0x1p-200 && largest <= 0x1p200) && largest > 0) {
    const int e = std::ilogb(largest);
    for (auto& p : scaled_) {
      for (double& v : p) v = std::ldexp(v, -e);
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int c = 0; c < 3; ++c) {
      if (points[i][c] != 0) least = std::min(least, std::abs(scaled_[i][c]));
    }
  }
  // Bits of coordinates lie above 2^-324, those of triple products above 2^-972.
  expansions_exact_ = least >= 0x1p-270;
}

// Filters: |det - exact| <= (7 + 56 u) u permanent for orient3d with rounded differences, (3 + 16
// u) u for the 2x2 (Shewchuk); products that underflow add less than 2^-800 at this scale.
PairPredicates::Filtered PairPredicates::filteredOrient3d(int i, int j, int k, int l) const {
  const auto &a = scaled_[i], &b = scaled_[j], &c = scaled_[k], &d = scaled_[l];
  const double adx = a[0] - d[0], ady = a[1] - d[1], adz = a[2] - d[2];
  const double bdx = b[0] - d[0], bdy = b[1] - d[1], bdz = b[2] - d[2];
  const double cdx = c[0] - d[0], cdy = c[1] - d[1], cdz = c[2] - d[2];
  const double bxcy = bdx * cdy, cxby = cdx * bdy, cxay = cdx * ady, axcy = adx * cdy,
               axby = adx * bdy, bxay = bdx * ady;
  const double det = adz * (bxcy - cxby) + bdz * (cxay - axcy) + cdz * (axby - bxay);
  const double permanent = (std::abs(bxcy) + std::abs(cxby)) * std::abs(adz) +
                           (std::abs(cxay) + std::abs(axcy)) * std::abs(bdz) +
                           (std::abs(axby) + std::abs(bxay)) * std::abs(cdz);
  constexpr double kBound = 8 * 0x1p-53;
  return {det, kBound * permanent + 0x1p-800, permanent == 0};
}

int PairPredicates::orient3d(int i, int j, int k, int l) const {
  const Filtered det = filteredOrient3d(i, j, k, l);
  if (std::abs(det.value) > det.error) return signOf(det.value);
  if (det.vanishes && expansions_exact_) return 0;
  return signOf(exactOrient3d(i, j, k, l, 1).mantissa);
}

PairPredicates::Filtered PairPredicates::filteredCross2d(int i, int j, int k, int l,
                                                         int axis) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double left = (scaled_[j][u] - scaled_[i][u]) * (scaled_[l][v] - scaled_[k][v]);
  const double right = (scaled_[j][v] - scaled_[i][v]) * (scaled_[l][u] - scaled_[k][u]);
  constexpr double kBound = 4 * 0x1p-53;
  return {left - right, kBound * (std::abs(left) + std::abs(right)) + 0x1p-800,
          left == 0 && right == 0};
}

int PairPredicates::cross2d(int i, int j, int k, int l, int axis) const {
  const Filtered det = filteredCross2d(i, j, k, l, axis);
  if (std::abs(det.value) > det.error) return signOf(det.value);
  if (det.vanishes && expansions_exact_) return 0;
  return signOf(exactCross2d(i, j, k, l, axis).mantissa);
}

int PairPredicates::projectionAxis(int i, int j, int k) const {
  int best = -1;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Filtered area = filteredCross2d(i, j, i, k, axis);
    if (std::abs(area.value) <= std::max(area.error, largest)) continue;
    largest = std::abs(area.value);
    best = axis;
  }
  for (int axis = 0; axis < 3 && best < 0; ++axis) {
    if (orient2d(i, j, k, axis) != 0) best = axis;
  }
  return best;
}

/// |a| / (|a| + |b|)
double PairPredicates::share(const Rounded& a, const Rounded& b) {
  const long shift = b.exponent - a.exponent;
  const double size_a = std::abs(a.mantissa), size_b = std::abs(b.mantissa);
  if (size_a == 0) return 0;
  // Mantissas are below 2^63 and a ratio beyond 2^+-200 is 0 or 1.
  const double relative_b = std::ldexp(size_b, static_cast<int>(std::clamp(shift, -2000L, 900L)));
  return std::isfinite(relative_b) ? size_a / (size_a + relative_b) : 0;
}

// The filters' bounds are far above their errors: 2^-46 of a bound is a few eps in fact.
constexpr double kAccurate = 0x1p-46;
constexpr double kExact = 0x1p50;

double PairPredicates::crossing3d(int i, int j, int k, int l, int m) const {
  const Filtered fi = filteredOrient3d(k, l, m, i), fj = filteredOrient3d(k, l, m, j);
  const double size = std::abs(fi.value) + std::abs(fj.value);
  if (fi.error + fj.error <= kAccurate * size) return std::abs(fi.value) / size;
  return share(exactOrient3d(k, l, m, i, kExact), exactOrient3d(k, l, m, j, kExact));
}

double PairPredicates::crossing2d(int i, int j, int k, int l, int axis) const {
  const Filtered fi = filteredCross2d(k, l, k, i, axis), fj = filteredCross2d(k, l, k, j, axis);
  const double size = std::abs(fi.value) + std::abs(fj.value);
  if (fi.error + fj.error <= kAccurate * size) return std::abs(fi.value) / size;
  return share(exactCross2d(k, l, k, i, axis), exactCross2d(k, l, k, j, axis));
}

PairPredicates::Rounded PairPredicates::exactOrient3d(int i, int j, int k, int l,
                                                      double margin) const {
  if (!expansions_exact_) {
    cpp_int m[3][3];
    const int rows[3] = {i, j, k};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) m[r][c] = integer(given_[rows[r]][c]) - integer(given_[l][c]);
    }
    const cpp_int det = m[0][2] * (m[1][0] * m[2][1] - m[2][0] * m[1][1]) +
                        m[1][2] * (m[2][0] * m[0][1] - m[0][0] * m[2][1]) +
                        m[2][2] * (m[0][0] * m[1][1] - m[1][0] * m[0][1]);
    return roundedInteger<Rounded>(det);
  }
  // In stages (Shewchuk, 4.3): exactly for the rounded differences, which is all if they are exact;
  // with their roundings to first order, off by at most 32 u^2 permanent (3 dropped, 14 and 6 for
  // computing and adding the corrections, 9 of the first stage); exactly.
  double d[3][3], t[3][3];
  const int rows[3] = {i, j, k};
  bool tails = false;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      twoSum(scaled_[rows[r]][c], -scaled_[l][c], d[r][c], t[r][c]);
      tails |= t[r][c] != 0;
    }
  }
  const auto minor = [&d](int r, int s) {
    return sum(product(d[r][0], d[s][1]), negated(product(d[s][0], d[r][1])));
  };
  Rounded det =
      roundedExpansion<Rounded>(sum(sum(scaled(minor(1, 2), d[0][2]), scaled(minor(2, 0), d[1][2])),
                                    scaled(minor(0, 1), d[2][2])));
  if (!tails) return det;

  double permanent = 0;
  for (int r = 0; r < 3; ++r) {
    const int p = (r + 1) % 3, q = (r + 2) % 3;
    const double left = d[p][0] * d[q][1], right = d[q][0] * d[p][1];
    permanent += (std::abs(left) + std::abs(right)) * std::abs(d[r][2]);
    det.mantissa += d[r][2] * ((d[p][0] * t[q][1] + d[q][1] * t[p][0]) -
                               (d[q][0] * t[p][1] + d[p][1] * t[q][0])) +
                    t[r][2] * (left - right);
  }
  constexpr double kUlp = 0x1p-53;
  const double error = 27 * kUlp * kUlp * permanent + 4 * kUlp * std::abs(det.mantissa) + 0x1p-800;
  if (std::abs(det.mantissa) > margin * error) return det;

  Expansion<2> m[3][3];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[r][c] = difference(scaled_[rows[r]][c], scaled_[l][c]);
  }
  const auto exact_minor = [&m](int r, int s) {
    return sum(product(m[r][0], m[s][1]), negated(product(m[s][0], m[r][1])));
  };
  return roundedExpansion<Rounded>(
      sum(sum(product(exact_minor(1, 2), m[0][2]), product(exact_minor(2, 0), m[1][2])),
          product(exact_minor(0, 1), m[2][2])));
}

PairPredicates::Rounded PairPredicates::exactCross2d(int i, int j, int k, int l, int axis) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (!expansions_exact_) {
    const auto d = [this](int to, int from, int c) {
      return cpp_int(integer(given_[to][c]) - integer(given_[from][c]));
    };
    return roundedInteger<Rounded>(d(j, i, u) * d(l, k, v) - d(j, i, v) * d(l, k, u));
  }
  const auto d = [this](int to, int from, int c) {
    return difference(scaled_[to][c], scaled_[from][c]);
  };
  return roundedExpansion<Rounded>(
      sum(product(d(j, i, u), d(l, k, v)), negated(product(d(j, i, v), d(l, k, u)))));
}

}  // namespace kios
