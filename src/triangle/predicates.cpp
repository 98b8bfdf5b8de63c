// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/predicates.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "triangle/determinant.h"
#include "triangle/integer.h"

namespace kios {
namespace {

/// Returns the largest power of two that is at most v, which is normal; 0 for 0.
double powerOfTwoBelow(double v) {
  std::uint64_t bits;
  std::memcpy(&bits, &v, sizeof v);
  bits &= 0x7FF0000000000000;
  std::memcpy(&v, &bits, sizeof v);
  return v;
}

/// n 2^exponent, rounded to 53 bits.
template <typename Rounded>
Rounded roundedInteger(const Integer& n, long exponent) {
  if (n == 0) return {0, 0};
  const Integer magnitude = abs(n);
  const long bits = static_cast<long>(msb(magnitude)) + 1, drop = std::max(0L, bits - 62);
  const double mantissa = static_cast<double>(static_cast<long long>(magnitude >> drop));
  return {n < 0 ? -mantissa : mantissa, exponent + drop};
}

}  // namespace

PairPredicates::PairPredicates(const Coordinates& points) : given_(points), scaled_(points) {
  using All = Eigen::Map<const Eigen::Array<double, 18, 1>>;
  double largest = All(points[0].data()).abs().maxCoeff();
  if (!(largest >= 0x1p-200 && largest <= 0x1p200) && largest > 0) {
    scale_ = -std::ilogb(largest);
    const double half = std::ldexp(1.0, scale_ / 2), rest = std::ldexp(1.0, scale_ - scale_ / 2);
    for (auto& p : scaled_) {
      for (double& v : p) v = v * half * rest;
    }
    largest = largest * half * rest;
  }
  // Multiples of one unit by factors of at most 15 bits: no result of a determinant has more
  // than 53.
  const double rounder = 0x1.8p38 * powerOfTwoBelow(largest);
  const All v(scaled_[0].data());
  plain_exact_ = ((v + rounder) - rounder - v).abs().maxCoeff() == 0;
  double least = v.abs().minCoeff();
  if (least == 0) {
    least = 1;
    for (int i = 0; i < 6; ++i) {
      for (int c = 0; c < 3; ++c) {
        if (points[i][c] != 0) least = std::min(least, std::abs(scaled_[i][c]));
      }
    }
    plain_exact_ &= least > 0;  // else one has underflowed
  }
  // Bits of coordinates lie above 2^-324, those of triple products above 2^-972.
  none_underflows_ = least >= 0x1p-270;
}

PairPredicates::Plane PairPredicates::planeOf(int j, int k, int l) const {
  const auto &b = scaled_[j], &c = scaled_[k], &d = scaled_[l];
  Plane plane;
  plane.origin = l;
  for (int u = 0; u < 3; ++u) {
    const int v = u == 2 ? 0 : u + 1, w = u == 0 ? 2 : u - 1;
    const double left = (b[v] - d[v]) * (c[w] - d[w]), right = (b[w] - d[w]) * (c[v] - d[v]);
    plane.minors[u] = left - right;
    plane.sizes[u] = std::abs(left) + std::abs(right);
  }
  return plane;
}

// The filter: |det - exact| <= (7 + 56 u) u permanent with rounded differences (Shewchuk); products
// that underflow add less than 2^-800 at this scale.
PairPredicates::Filtered PairPredicates::orient3d(int i, const Plane& plane) const {
  const auto &a = scaled_[i], &d = scaled_[plane.origin];
  double det = 0, permanent = 0;
  for (int u = 0; u < 3; ++u) {
    const double from_origin = a[u] - d[u];
    det += from_origin * plane.minors[u];
    permanent += std::abs(from_origin) * plane.sizes[u];
  }
  return {det, 8 * 0x1p-53 * permanent + 0x1p-800, permanent == 0};
}

int PairPredicates::orient3d(int i, int j, int k, int l) const {
  const Filtered det = orient3d(i, planeOf(j, k, l));
  return std::abs(det.value) > det.error ? signOf(det.value) : signOf(det, i, j, k, l);
}

std::array<int, 3> PairPredicates::sides(const int (&points)[3], int j, int k, int l) const {
  const Plane plane = planeOf(j, k, l);
  std::array<int, 3> sides;
  for (int p = 0; p < 3; ++p) {
    const Filtered det = orient3d(points[p], plane);
    sides[p] =
        std::abs(det.value) > det.error ? signOf(det.value) : signOf(det, points[p], j, k, l);
  }
  return sides;
}

int PairPredicates::signOf(const Filtered& orient3d, int i, int j, int k, int l) const {
  if (plain_exact_ || (orient3d.vanishes && none_underflows_)) return signOf(orient3d.value);
  if (same(i, j) || same(i, k) || same(i, l) || same(j, k) || same(j, l) || same(k, l)) return 0;
  return signOf(exactOrient3d(i, j, k, l, 1).mantissa);
}

int PairPredicates::signOf(const Filtered& cross2d, int i, int j, int k, int l, int axis) const {
  if (plain_exact_ || (cross2d.vanishes && none_underflows_)) return signOf(cross2d.value);
  if (same(i, j) || same(k, l) || (same(i, k) && same(j, l)) || (same(i, l) && same(j, k)))
    return 0;
  return signOf(exactCross2d(i, j, k, l, axis, 1).mantissa);
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
  // Mantissas lie within 2^-800 to 2^700, so that a ratio of more is 0 or 1.
  const double relative_b = std::ldexp(size_b, static_cast<int>(std::clamp(shift, -3000L, 3000L)));
  return std::isfinite(relative_b) ? size_a / (size_a + relative_b) : 0;
}

// The filters' bounds are far above their errors: 2^-46 of a bound is a few eps in fact.
constexpr double kAccurate = 0x1p-46;
constexpr double kMargin = 1 / kAccurate;

double PairPredicates::crossing3d(int i, int j, int k, int l, int m) const {
  const Plane plane = planeOf(k, l, m);
  const Filtered fi = orient3d(i, plane), fj = orient3d(j, plane);
  const double size = std::abs(fi.value) + std::abs(fj.value);
  if (fi.error + fj.error <= kAccurate * size) return std::abs(fi.value) / size;
  return share(exactOrient3d(i, k, l, m, kMargin), exactOrient3d(j, k, l, m, kMargin));
}

double PairPredicates::crossing2d(int i, int j, int k, int l, int axis) const {
  const Filtered fi = filteredCross2d(k, l, k, i, axis), fj = filteredCross2d(k, l, k, j, axis);
  const double size = std::abs(fi.value) + std::abs(fj.value);
  if (fi.error + fj.error <= kAccurate * size) return std::abs(fi.value) / size;
  return share(exactCross2d(k, l, k, i, axis, kMargin), exactCross2d(k, l, k, j, axis, kMargin));
}

PairPredicates::Rounded PairPredicates::exactOrient3d(int i, int j, int k, int l,
                                                      double margin) const {
  // In twofold numbers; if they don't tell, exactly.
  const int rows[3] = {i, j, k};
  Twofold d[3][3];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) d[r][c] = twofoldDifference(scaled_[rows[r]][c], scaled_[l][c]);
  }
  const TwofoldDeterminant det = determinant(d);
  if (std::abs(det.rounded()) > margin * det.error()) return {det.rounded(), 0};

  IntegerVector m[3];
  for (int r = 0; r < 3; ++r) m[r] = integers(given_[rows[r]]) - integers(given_[l]);
  return roundedInteger<Rounded>(dot(m[0], cross(m[1], m[2])), 3 * (scale_ - 1074));
}

PairPredicates::Rounded PairPredicates::exactCross2d(int i, int j, int k, int l, int axis,
                                                     double margin) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  // The stages are those above: the first is off by at most 15 u^2 (|left| + |right|).
  const auto twofold = [this](int to, int from, int c) {
    return twofoldDifference(scaled_[to][c], scaled_[from][c]);
  };
  const Twofold left = twofold(j, i, u) * twofold(l, k, v);
  const Twofold right = twofold(j, i, v) * twofold(l, k, u);
  const Twofold det = left - right;
  const double value = det.high + det.low;
  constexpr double kUlp = 0x1p-53;
  const double size = std::abs(left.high) + std::abs(right.high);
  if (std::abs(value) > margin * (20 * kUlp * kUlp * size + 0x1p-800)) return {value, 0};

  const auto d = [this](int to, int from, int c) {
    return Integer(integer(given_[to][c]) - integer(given_[from][c]));
  };
  return roundedInteger<Rounded>(d(j, i, u) * d(l, k, v) - d(j, i, v) * d(l, k, u),
                                 2 * (scale_ - 1074));
}

}  // namespace kios
