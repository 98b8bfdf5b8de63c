// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The exact distance of two k-IOS against convex optimisation in long double, and between the
// conservative bound and the distance of the contents in 100 digits.
#include "fcl_kios/clearance.h"

#include <gtest/gtest.h>

#include "clearance/interior_point.h"
#include "not_finite.h"
#include "scalars.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(ExactPair);

/// Returns the mean of the points around v's S0: inside all spheres.
template <typename S>
Real3 middleOf(const Points<S>& points, const kIOS<S>& v) {
  Real3 sum = Real3::Zero();
  for (const auto& p : points) {
    sum += p.template cast<Real>() - v.center0.template cast<Real>();
  }
  return sum / static_cast<Real>(points.size());
}

/// Absolute errors where even S can't express better.
template <typename S>
constexpr double kUnderflow = 256.0 * std::numeric_limits<S>::denorm_min();

/// Returns the length that errors are relative to: the size of the pair, and the rounding of
/// translations.
template <typename S>
Real scaleOf(const HardPair<S>& pair) {
  return pair.reaches() + 1e14L * pair.rounding() * pair.magnitude();
}

TYPED_TEST(ExactPair, AgreesWithInteriorPointMethod) {
  using S = TypeParam;
  Random random(11);
  int checked = 0, apart = 0, beyond_separation = 0, witnesses = 0;
  for (int i = 0; i < 6'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    StoredBalls a(pair.a), b(pair.b);
    const Real33 R = pair.R.template cast<Real>();
    const Real3 d = R * b.center0 + pair.T.template cast<Real>() - a.center0;
    const Real3 x = middleOf(pair.points_a, pair.a), w = middleOf(pair.points_b, pair.b);
    const Real size = pair.reaches();
    if (size < 1e10L * kUnderflow<S>) continue;
    // A barrier needs an inside: points and slivers of rounding's thickness have none.
    if (!(a.outside(x) < -1e-15L * size) || !(b.outside(w) < -1e-15L * size)) continue;
    const Bracket truth = interiorPointDistance(a, b, R, d, x, w);
    const ExactDistance exact = exactDistance(pair.a, pair.b, X);
    const Real scale = scaleOf(pair);
    ASSERT_LE(exact.distance, truth.upper) << "pair " << i;
    ASSERT_GE(exact.distance, truth.lower - 1e-12L * scale - kUnderflow<S>) << "pair " << i;
    ASSERT_GE(exact.distance + exact.error, truth.lower * (1 - 1e-15L)) << "pair " << i;
    ASSERT_LE(exact.error, 1e-12L * scale + kUnderflow<S>) << "pair " << i;
    ++checked;
    apart += exact.apart();
    beyond_separation += exact.distance > separation(pair.a, pair.b, X, kInfinity) + 1e-3L * size;
    // The nearest points are unique; a gap of g moves them by sqrt(2 r g), r the largest radius.
    if (!(truth.lower > 1e-3L * size)) continue;
    const Real gap = truth.upper - truth.lower + exact.error;
    const Real allowed =
        std::sqrt(32 * size * gap) + 1e-6L * size + pair.rounding() * scaleOf(pair);
    if (allowed > 1e-5L * scaleOf(pair)) continue;
    const Real3 p = exact.p.template cast<Real>() - a.center0;
    const Real3 q = exact.q.template cast<Real>() - a.center0;
    ASSERT_LE((p - truth.x).norm(), allowed) << "pair " << i;
    ASSERT_LE((q - truth.y).norm(), allowed) << "pair " << i;
    ++witnesses;
  }
  EXPECT_GT(checked, 3'000);
  EXPECT_GT(apart, 1'000);
  EXPECT_GT(beyond_separation, 200);
  EXPECT_GT(witnesses, 500);
}

TYPED_TEST(ExactPair, LiesBetweenTheBoundAndTheContents) {
  using S = TypeParam;
  Random random(12);
  int apart = 0;
  for (int i = 0; i < 20'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const ExactDistance exact = exactDistance(pair.a, pair.b, X);
    ASSERT_GE(exact.distance, separation(pair.a, pair.b, X, kInfinity)) << "pair " << i;
    ASSERT_TRUE(pair.distanceIsAtLeast(exact.distance)) << "pair " << i;
    ASSERT_TRUE(pair.roundedDistanceIsAtLeast(exact.distance)) << "pair " << i;
    ASSERT_LE(exact.error, 1e-12L * scaleOf(pair) + kUnderflow<S>) << "pair " << i;
    apart += exact.apart();
  }
  EXPECT_GT(apart, 5'000);
}

TYPED_TEST(ExactPair, WitnessesLieOnTheVolumesAlongTheNormal) {
  using S = TypeParam;
  Random random(13);
  for (int i = 0; i < 10'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const ExactDistance exact = exactDistance(pair.a, pair.b, X);
    const Real rounding = 1e-15L * pair.magnitude() + kUnderflow<S>;
    const StoredBalls a(pair.a), b(pair.b);
    const Real33 R = pair.R.template cast<Real>();
    const Real3 in_a = exact.p.template cast<Real>() - a.center0;
    const Real3 in_b =
        R.inverse() * (exact.q - X.T().template cast<double>()).template cast<Real>() - b.center0;
    ASSERT_LE(a.outside(in_a), rounding) << "pair " << i;
    ASSERT_LE(b.outside(in_b), 8 * rounding) << "pair " << i;
    const Real3 between = (exact.q - exact.p).template cast<Real>();
    ASSERT_LE(std::abs(between.norm() - exact.distance), exact.error + 8 * rounding);
    if (!exact.apart()) {
      ASSERT_EQ(exact.normal.norm() + exact.moment.norm(), 0);
      continue;
    }
    ASSERT_NEAR(exact.normal.norm(), 1, 1e-15);
    const Real3 along = exact.normal.template cast<Real>() * between.norm();
    if (exact.distance > 1e-6L * scaleOf(pair)) {
      ASSERT_LE((along - between).norm(), 1e-5L * between.norm() + kUnderflow<S>) << "pair " << i;
    }
    const fcl::Vector3d moment =
        (exact.q - X.T().template cast<double>()).cross(exact.normal) - exact.moment;
    ASSERT_LE(moment.norm(), 8 * rounding) << "pair " << i;
  }
}

// A hair's breadth apart, where the nearest points run along circles and vertices: B is moved along
// the normal until the gap is 1 to 1e-17 of the size.
TEST(ExactDistance, HoldsItsErrorDownToContact) {
  Random random(14);
  int gaps = 0;
  for (int i = 0; i < 4'000; ++i) {
    const HardPair<double> pair(random);
    const double size = static_cast<double>(pair.reaches());
    if (size < 1e-250) continue;
    fcl::Vector3d T = pair.T;
    ExactDistance exact = exactDistance(pair.a, pair.b, RelativePose<double>(pair.R, T));
    for (int k = 0; k < 6 && exact.apart(); ++k) {
      const double gap = k == 5 ? 0 : size * std::pow(10.0, -random.uniform(0, 17));
      const double before = exact.distance;
      T -= (before - gap) * exact.normal;
      exact = exactDistance(pair.a, pair.b, RelativePose<double>(pair.R, T));
      const Real scale = scaleOf(pair) + 32 * 1e14L * pair.rounding() * T.lpNorm<1>();
      ASSERT_LE(exact.error, 1e-12L * scale) << "pair " << i << ", gap " << gap;
      ASSERT_LE(exact.distance, gap + 1e-12L * scale) << "pair " << i << ", gap " << gap;
      ++gaps;
    }
  }
  EXPECT_GT(gaps, 5'000);
}

TYPED_TEST(ExactPair, OneFrameAndEmpty) {
  using S = TypeParam;
  Random random(16);
  const RelativePose<S> identity(fcl::Matrix3<S>::Identity(), fcl::Vector3<S>::Zero());
  const kIOS<S> none;
  for (int i = 0; i < 2'000; ++i) {
    const HardPair<S> pair(random);
    const ExactDistance ab = exactDistance(pair.a, pair.b), ba = exactDistance(pair.b, pair.a);
    ASSERT_EQ(ab.distance, exactDistance(pair.a, pair.b, identity).distance);
    ASSERT_LE(std::abs(ab.distance - ba.distance), ab.error + ba.error) << "pair " << i;
    ASSERT_EQ(exactDistance(pair.a, pair.a).distance, 0) << "pair " << i;
    ASSERT_EQ(exactDistance(pair.a, none).distance, kInfinity);
    ASSERT_EQ(exactDistance(none, pair.a).distance, kInfinity);
    ASSERT_EQ(exactDistance(none, pair.a, RelativePose<S>(pair.R, pair.T)).error, 0);
  }
  ASSERT_EQ(nearestPoint(none, fcl::Vector3<S>(1, 2, 3)).distance, kInfinity);
}

}  // namespace
}  // namespace kios::testing
