// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "triangle/ray_triangle.h"

#include <algorithm>

#include "triangle/determinant.h"
#include "volume/rounding.h"

namespace kios {
namespace {

constexpr int kNext[3] = {1, 2, 0};
constexpr double kUlp = 0x1p-53;

void widen(double v, double& least, double& largest) {
  if (v == 0) return;
  least = std::min(least, std::abs(v));
  largest = std::max(largest, std::abs(v));
}

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

/// A triangle in the ray's units.
struct ExactRay::Scaled {
  double corner[3][3];
  double from_origin[3][3];  ///< rounded
};

ExactRay::ExactRay(const GivenRay& ray, double largest) : given_(ray) {
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(ray.origin[c]));
  const bool ordinary = largest >= 0x1p-200 && largest <= 0x1p200;
  const int unit = ordinary || !(largest > 0) ? 0 : std::clamp(-std::ilogb(largest), -1000, 1000);
  const int turn = std::clamp(-std::ilogb(ray.direction.cwiseAbs().maxCoeff()), -1000, 1000);
  const double scale = std::ldexp(1.0, turn);
  unit_ = std::ldexp(1.0, unit);
  shift_ = turn - ray.exponent - unit;
  least_ = kInfinity;
  largest_ = 0;
  for (int c = 0; c < 3; ++c) {
    origin_[c] = ray.origin[c] * unit_;
    direction_[c] = ray.direction[c] * scale;
    exact_ &= origin_[c] / unit_ == ray.origin[c] && direction_[c] / scale == ray.direction[c];
    widen(origin_[c], least_, largest_);
    widen(direction_[c], least_, largest_);
  }
}

// Four products of rounded differences, of which none but the first two factors' are: (1 + u)^7, so
// 7 u of the permanent as it is, 8 u as it is computed. What underflows adds less than 2^-800.
ExactRay::Sign ExactRay::filteredSide(const Scaled& t, int i, int j) const {
  const double* const p = t.from_origin[i];
  const double x = t.corner[j][0] - t.corner[i][0], y = t.corner[j][1] - t.corner[i][1],
               z = t.corner[j][2] - t.corner[i][2];
  const double yz = p[1] * z, zy = p[2] * y, zx = p[2] * x, xz = p[0] * z, xy = p[0] * y,
               yx = p[1] * x;
  const double* const d = direction_;
  const double side = d[0] * (yz - zy) + d[1] * (zx - xz) + d[2] * (xy - yx);
  const double permanent = std::abs(d[0]) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(d[1]) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(d[2]) * (std::abs(xy) + std::abs(yx));
  const double error = 8 * kUlp * permanent + 0x1p-800;
  return side > error ? kPlus : (side < -error ? kMinus : kUnknown);
}

ExactRay::Sign ExactRay::exactSide(const Scaled& t, int i, int j) const {
  Twofold twofold[3][3];
  for (int c = 0; c < 3; ++c) {
    twofold[0][c] = {direction_[c], 0};
    twofold[1][c] = twofoldDifference(t.corner[i][c], origin_[c]);
    twofold[2][c] = twofoldDifference(t.corner[j][c], t.corner[i][c]);
  }
  const TwofoldDeterminant det = determinant(twofold);
  if (det.rounded() > det.error()) return kPlus;
  if (det.rounded() < -det.error()) return kMinus;
  double least = least_, largest = largest_;
  for (int c = 0; c < 3; ++c) {
    widen(t.corner[i][c], least, largest);
    widen(t.corner[j][c], least, largest);
  }
  // Bits lie above 2^-324, those of triple products above 2^-972.
  if (!(least >= 0x1p-270 && largest <= 0x1p201)) return kUnknown;
  Expansion<2> exact[3][3];
  for (int c = 0; c < 3; ++c) {
    exact[0][c].append(direction_[c]);
    exact[1][c] = difference(t.corner[i][c], origin_[c]);
    exact[2][c] = difference(t.corner[j][c], t.corner[i][c]);
  }
  const Expansion<192> sum = determinant(exact);
  if (sum.size == 0) return kZero;
  return sum.terms[sum.size - 1] > 0 ? kPlus : kMinus;
}

bool ExactRay::hits(const TriangleVertices<double>& corners, TriangleHit& hit) const {
  Scaled t;
  bool exact = exact_;
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) {
      t.corner[i][c] = corners[i][c] * unit_;
      exact &= unit_ == 1 || t.corner[i][c] / unit_ == corners[i][c];
      t.from_origin[i][c] = t.corner[i][c] - origin_[c];
    }
  }
  if (!exact) return hitInIntegers(given_, corners, hit);
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
    sides[i] = exactSide(t, i, kNext[i]);
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
bool ExactRay::cross(const Scaled& t, TriangleHit& hit, bool& in_range) const {
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
