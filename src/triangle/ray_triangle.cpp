// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/ray_triangle.h"

#include <algorithm>

#include "triangle/determinant.h"

namespace kios {
namespace {

constexpr double kUlp = 0x1p-53;

/// numerator / denominator rounded to nearest, if that is sure. The quotient of two twofold numbers
/// in two terms is off by less than 32 u^2 of itself, and by their own errors.
bool roundedQuotient(const TwofoldDeterminant& numerator, const TwofoldDeterminant& denominator,
                     double& quotient) {
  double n, n_low, d, d_low;
  twoSum(numerator.value.high, numerator.value.low, n, n_low);
  twoSum(denominator.value.high, denominator.value.low, d, d_low);
  const double q = n / d;
  double p, p_low;
  twoProduct(q, d, p, p_low);
  const double rest = (((n - p) - p_low) + (n_low - q * d_low)) / d;
  const double error =
      1.01 * (std::abs(q) * (denominator.error() / std::abs(d) + 32 * kUlp * kUlp) +
              numerator.error() / std::abs(d));
  double low;
  twoSum(q, rest, quotient, low);
  return std::abs(quotient) > 0x1p-900 && std::abs(quotient) < 0x1p900 &&
         quotient + (low + error) == quotient && quotient + (low - error) == quotient;
}

}  // namespace

ExactRay::ExactRay(const GivenRay& ray, double largest)
    : given_(ray), origin_(ray.origin, largest) {
  const int turn = std::clamp(-std::ilogb(ray.direction.cwiseAbs().maxCoeff()), -1000, 1000);
  const double scale = std::ldexp(1.0, turn);
  shift_ = turn - ray.exponent - origin_.exponent();
  for (int c = 0; c < 3; ++c) {
    direction_[c] = ray.direction[c] * scale;
    exact_ &= direction_[c] / scale == ray.direction[c];
  }
}

Sign ExactRay::filteredSide(const Corners& t, int i, int j) const {
  double along[3];
  for (int c = 0; c < 3; ++c) along[c] = t.corner[j][c] - t.corner[i][c];
  return filteredSign(direction_, t.from_origin[i], along);
}

Sign ExactRay::twofoldSide(const Corners& t, int i, int j) const {
  Twofold twofold[3][3];
  for (int c = 0; c < 3; ++c) {
    twofold[0][c] = {direction_[c], 0};
    twofold[1][c] = twofoldDifference(t.corner[i][c], origin_[c]);
    twofold[2][c] = twofoldDifference(t.corner[j][c], t.corner[i][c]);
  }
  const TwofoldDeterminant det = determinant(twofold);
  return signBeyond(det.rounded(), det.error());
}

bool ExactRay::hits(const TriangleVertices<double>& corners, TriangleHit& hit) const {
  Corners t;
  if (!origin_.scale(corners, t) || !exact_) return hitInIntegers(given_, corners, hit);
  // The line crosses the closed triangle in a point if it passes all edges on one side, or through;
  // an edge gives both its triangles the same side, so that nothing passes between them.
  Sign sides[3];
  bool left = false, right = false;
  for (int i = 0; i < 3; ++i) {
    sides[i] = filteredSide(t, i, kNext[i]);
    left |= sides[i] == kPlus;
    right |= sides[i] == kMinus;
  }
  if (left && right) return false;
  for (int i = 0; i < 3; ++i) {
    if (sides[i] != kUnknown) continue;
    sides[i] = twofoldSide(t, i, kNext[i]);
    if (sides[i] == kUnknown) return hitInIntegers(given_, corners, hit);
    left |= sides[i] == kPlus;
    right |= sides[i] == kMinus;
    if (left && right) return false;
  }
  bool in_range;
  if (!(left || right) || !cross(t, hit, in_range)) return hitInIntegers(given_, corners, hit);
  for (int i = 0; i < 3; ++i) {
    if (sides[i] == kZero) hit.weights[kNext[kNext[i]]] = 0;
  }
  return in_range;
}

// With n = (p1 - p0) x (p2 - p0): t = (p0 - origin) . n / direction . n, and weights are the sides'
// determinants by direction . n, which is their sum.
bool ExactRay::cross(const Corners& t, TriangleHit& hit, bool& in_range) const {
  Twofold from[3][3], edge[3][3], along[3];
  for (int c = 0; c < 3; ++c) {
    along[c] = {direction_[c], 0};
    for (int i = 0; i < 3; ++i) {
      from[i][c] = twofoldDifference(t.corner[i][c], origin_[c]);
      edge[i][c] = twofoldDifference(t.corner[kNext[i]][c], t.corner[i][c]);
    }
  }
  const auto of = [](const Twofold(&x)[3], const Twofold(&y)[3], const Twofold(&z)[3]) {
    return determinant({{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}});
  };
  const TwofoldDeterminant slope = of(along, edge[0], edge[1]);
  const TwofoldDeterminant height = of(from[0], edge[0], edge[1]);
  const double size = std::abs(slope.rounded());
  if (!(slope.error() <= 0x1p-56 * size) || !roundedQuotient(height, slope, hit.t)) return false;
  const int exponent = std::ilogb(hit.t) + shift_;
  if (exponent < -1000 || exponent > 1000) return false;
  hit.t = std::ldexp(hit.t, shift_);
  if (hit.t == given_.t_min || hit.t == given_.t_max) return false;  // within rounding
  in_range = hit.t > given_.t_min && hit.t < given_.t_max;
  if (!in_range) return true;
  for (int i = 0; i < 3; ++i) {
    const TwofoldDeterminant side = of(along, from[i], edge[i]);
    if (!(side.error() <= 0x1p-56 * size)) return false;
    hit.weights[kNext[kNext[i]]] = std::abs(side.rounded()) / size;
  }
  hit.side = slope.rounded() > 0 ? 1 : -1;
  return true;
}

}  // namespace kios
