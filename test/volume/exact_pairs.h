// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "fcl_kios/paper.h"
#include "volume/exact_spheres.h"

namespace kios::testing {

/// Two hard point sets, their volumes, a hard pose x_A = R x_B + T and the truth about them.
template <typename S>
class HardPair {
 public:
  explicit HardPair(Random& random);

  Points<S> points_a, points_b;
  kIOS<S> a, b;
  fcl::Matrix3<S> R = fcl::Matrix3<S>::Identity();
  fcl::Vector3<S> T = fcl::Vector3<S>::Zero();

  /// Returns true if all pairs of points are at least `bound` apart, R and T taken as exact.
  bool distanceIsAtLeast(double bound) const {
    return allPairs([&](const auto& p, const auto& q) {
      long double y[3], error = 0;
      moveBy(q, T, y, &error);
      if (apart<long double>(p, y, error, bound)) return true;
      Exact exact[3], exact_error = 0;
      moveBy(q, T, exact, &exact_error);
      return apart<Exact>(p, exact, 0, bound);
    });
  }

  /// Tells it for b's points as a leaf computes them in S, in two orders of summation.
  bool roundedDistanceIsAtLeast(double bound) const {
    return allPairs([&](const auto& p, const auto& q) {
      const fcl::Vector3<S> moved[2] = {R * q + T, T + R * q};
      for (const fcl::Vector3<S>& m : moved) {
        const long double y[3] = {m[0], m[1], m[2]};
        if (apart<long double>(p, y, y[0] * 0 + m.template lpNorm<1>(), bound)) continue;
        const Exact exact[3] = {m[0], m[1], m[2]};
        if (!apart<Exact>(p, exact, 0, bound)) return false;
      }
      return true;
    });
  }

  bool distanceIsZero() const {
    return !distanceIsAtLeast(std::numeric_limits<double>::denorm_min());
  }

  /// Returns the largest |c_a - (R c_b + T)| - r_a - r_b of the spheres as stored, to 64 bits.
  long double sphereSeparation() const {
    long double best = -std::numeric_limits<long double>::infinity();
    for (int j = 0; j < b.k(); ++j) {
      const StoredSphere<long double> sb(b, j);
      // R c_b + T - c_a first, then the offsets, as exactly as 64 bits can.
      long double c[3], error = 0;
      Exact center[3], exact_error = 0;
      moveBy(sb.center0, T, center, &exact_error);
      moveBy(sb.offset, fcl::Vector3<S>(fcl::Vector3<S>::Zero()), c, &error);
      for (int i = 0; i < a.k(); ++i) {
        const StoredSphere<long double> sa(a, i);
        long double sum = 0;
        for (int x = 0; x < 3; ++x) {
          const auto d0 = static_cast<long double>(Exact(center[x] - sa.center0[x]));
          const long double d = d0 + c[x] - sa.offset[x];
          sum += d * d;
        }
        best = std::max(best, std::sqrt(sum) - sa.radius - sb.radius);
      }
    }
    return best;
  }

  /// Returns the length that roundings of a test are relative to.
  long double magnitude() const {
    return 2 * (norm1(a.center0) + norm1(b.center0) + norm1(T)) + reaches();
  }
  /// Returns the distance of the central spheres and the reaches: the size of the float lanes'
  /// numbers.
  long double reaches() const {
    const fcl::Vector3<long double> d =
        R.template cast<long double>() * b.center0.template cast<long double>() +
        (T.template cast<long double>() - a.center0.template cast<long double>());
    return d.template lpNorm<1>() + std::ldexp(static_cast<long double>(a.reach), a.exponent) +
           std::ldexp(static_cast<long double>(b.reach), b.exponent);
  }
  long double rounding() const { return std::numeric_limits<S>::epsilon(); }
  /// Returns |R^T R - I|.
  long double shear() const {
    const fcl::Matrix3<long double> M = R.template cast<long double>();
    return (M.transpose() * M - fcl::Matrix3<long double>::Identity()).norm() + 1e-14L;
  }

 private:
  template <typename V>
  static long double norm1(const V& v) {
    return v.template cast<long double>().template lpNorm<1>();
  }
  template <typename Test>
  bool allPairs(Test&& test) const {
    for (const auto& p : points_a) {
      for (const auto& q : points_b) {
        if (!test(p, q)) return false;
      }
    }
    return true;
  }

  /// y = R q + t in N, and the sum of the magnitudes of what was added.
  template <typename Q, typename N>
  void moveBy(const Q& q, const fcl::Vector3<S>& t, N y[3], N* magnitude) const {
    for (int c = 0; c < 3; ++c) {
      y[c] = t[c];
      *magnitude += std::abs(t[c]);
      for (int j = 0; j < 3; ++j) {
        const N term = N(R(c, j)) * N(q[j]);
        y[c] += term;
        *magnitude += term < 0 ? N(-term) : term;
      }
    }
  }

  /// Returns true if |p - y| >= bound for certain, y having been summed from `magnitude` in N.
  template <typename N>
  static bool apart(const fcl::Vector3<S>& p, const N y[3], const N& magnitude, double bound) {
    if (!(bound > 0)) return true;
    N sum = 0, total = magnitude;
    for (int c = 0; c < 3; ++c) {
      const N d = y[c] - N(p[c]);
      sum += d * d;
      total += std::abs(p[c]);
    }
    using std::sqrt;
    if constexpr (std::is_same_v<N, Exact>) return N(sqrt(sum)) >= bound;
    return N(sqrt(sum)) - N(32 * kFilterUlp) * total >= bound;
  }
};

template <typename S>
HardPair<S>::HardPair(Random& random) {
  const bool ordinary = random.unit() < 0.7;
  const double scale = ordinary ? std::pow(10.0, random.uniform(-2, 2)) : randomScale<S>(random);
  const double offset = random.unit() < 0.7 ? 0 : randomOffset(random);
  const auto draw = [&](double factor) {
    const int n = random.unit() < 0.3 ? 1 + below(random, 2) : 3 + below(random, 6);
    return place<S>(random,
                    shapePoints(random, static_cast<PointShape>(below(random, kPointShapes)), n),
                    offset, scale * factor);
  };
  points_a = draw(1);
  points_b = draw(random.unit() < 0.7 ? 1 : std::pow(10.0, -random.uniform(0, 6)));
  const int kind = below(random, 9);
  if (kind == 0) points_b = points_a;  // identical
  a = fitted(points_a);
  b = fitted(points_b, random.unit() < 0.8 ? FitMethod::kTuned : FitMethod::kMethodII);
  if (kind == 0 || kind == 1) return;  // identity

  fcl::Matrix3d rotation = randomRotation(random);
  if (random.unit() < 0.3) {  // as far from rigid as a pose may be: |R^T R - I| just below 1e-4
    const double shear = 2.8e-5 * (random.unit() < 0.5 ? 1 : std::pow(10.0, -random.uniform(0, 8)));
    if (random.unit() < 0.5) {
      rotation *= 1 + shear;
    } else {
      for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) += shear / 2 * random.uniform(-1, 1);
    }
  }
  R = rotation.cast<S>();
  const fcl::Vector3d direction = randomDirection(random);
  const double size = std::max(double{a.radius0}, double{b.radius0});
  if (kind == 2) {  // coincident centres
    T = a.center0 - R * b.center0;
    return;
  }
  // B's lowest point on A's highest one along `direction`, or a gap away.
  const auto lower = [&](const fcl::Vector3<S>& p, const fcl::Vector3<S>& q) {
    return direction.dot(p.template cast<double>()) < direction.dot(q.template cast<double>());
  };
  const auto& highest = *std::max_element(points_a.begin(), points_a.end(), lower);
  const auto& lowest =
      *std::min_element(points_b.begin(), points_b.end(),
                        [&](const auto& p, const auto& q) { return lower(R * p, R * q); });
  double gap = 0;
  if (kind == 4) gap = size * std::pow(10.0, -random.uniform(3, 17));
  if (kind == 5) gap = size * random.uniform(-1, 1);
  if (kind == 6) gap = size * random.uniform(0, 10);
  if (kind == 7) gap = size * 1e12;
  if (kind == 8 && ordinary) gap = random.uniform(0.1, 1) * 0x1p30;
  T = highest - R * lowest + (direction * gap).template cast<S>();
}

}  // namespace kios::testing
