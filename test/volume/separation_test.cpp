// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No bound exceeds the distance of the contents, decided in higher precision, for hard sets at hard
// poses: touching, nested, coincident, far, slightly sheared, at any scale.
#include "fcl_kios/volume.h"

#include <gtest/gtest.h>

#include "not_finite.h"
#include "scalars.h"
#include "volume/exact_pairs.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(Separation);

TYPED_TEST(Separation, NeverExceedsTheDistanceOfThePoints) {
  using S = TypeParam;
  Random random(1);
  int apart = 0, clear = 0;
  for (int i = 0; i < 60'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const double bound = separation(pair.a, pair.b, X, kInfinity);
    ASSERT_TRUE(std::isfinite(bound)) << "pair " << i;
    ASSERT_TRUE(pair.distanceIsAtLeast(bound)) << "pair " << i << ": " << bound;
    ASSERT_TRUE(pair.roundedDistanceIsAtLeast(bound)) << "pair " << i << ": " << bound;
    const S value = distance(pair.R, pair.T, pair.a, pair.b);
    ASSERT_TRUE(pair.distanceIsAtLeast(value)) << "pair " << i << ": " << value;
    ASSERT_GE(value, 0);
    ASSERT_LE(value, std::max(0.0, bound));
    ASSERT_EQ(overlap(pair.R, pair.T, pair.a, pair.b), !(bound > 0)) << "pair " << i;
    apart += bound > 0;
    clear += bound > 0.5 * static_cast<double>(pair.sphereSeparation());
  }
  EXPECT_GT(apart, 15'000);  // the poses are not all trivial
  EXPECT_GT(clear, 10'000);
}

TYPED_TEST(Separation, IsTheLargestBoundOfTheSpherePairs) {
  using S = TypeParam;
  Random random(2);
  for (int i = 0; i < 60'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const double bound = separation(pair.a, pair.b, X, kInfinity);
    const long double best = pair.sphereSeparation();
    // Above: by nothing that 64 bits can tell. Below: by the pads that the sources derive.
    ASSERT_LE(bound, best + 64 * kFilterUlp * pair.magnitude()) << "pair " << i;
    constexpr long double kUnderflow =
        0x1p-499L + 64 * static_cast<long double>(std::numeric_limits<S>::denorm_min());
    const long double pads = 1e-5L * pair.reaches() + 40 * pair.rounding() * pair.magnitude() +
                             1.5L * pair.shear() * pair.reaches();
    ASSERT_GE(bound, best - pads - kUnderflow) << "pair " << i;
  }
}

TYPED_TEST(Separation, MembersTakeBothInOneFrame) {
  using S = TypeParam;
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    HardPair<S> pair(random);
    pair.R.setIdentity();
    pair.T.setZero();
    const S value = pair.a.distance(pair.b);
    ASSERT_TRUE(pair.distanceIsAtLeast(value)) << "pair " << i;
    kIOS<S> part;
    ASSERT_EQ(pair.a.overlap(pair.b, part), pair.a.overlap(pair.b)) << "pair " << i;
    if (!pair.a.overlap(pair.b) || !pair.b.overlap(pair.a)) {
      ASSERT_FALSE(pair.distanceIsZero()) << "pair " << i;
    }
    ASSERT_TRUE(pair.a.overlap(pair.a)) << "pair " << i;
    ASSERT_EQ(pair.a.distance(pair.a), 0) << "pair " << i;
  }
}

TYPED_TEST(Separation, StopsOnceTheBoundIsEnough) {
  using S = TypeParam;
  Random random(4);
  int stopped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const double full = separation(pair.a, pair.b, X, kInfinity);
    for (const double enough : {-kInfinity, 0.0, full * random.uniform(0.5, 1.5)}) {
      const double bound = separation(pair.a, pair.b, X, enough);
      ASSERT_LE(bound, full) << "pair " << i;
      ASSERT_EQ(bound > enough, full > enough) << "pair " << i;
      if (!(bound > enough)) {
        ASSERT_EQ(bound, full) << "pair " << i;
      }
      stopped += bound < full;
    }
  }
  EXPECT_GT(stopped, 100);
}

TYPED_TEST(Separation, TransformFormsAreTheMatrixForms) {
  using S = TypeParam;
  Random random(5);
  for (int i = 0; i < 2'000; ++i) {
    const HardPair<S> pair(random);
    fcl::Transform3<S> X = fcl::Transform3<S>::Identity();
    X.linear() = pair.R;
    X.translation() = pair.T;
    EXPECT_EQ(overlap(X, pair.a, pair.b), overlap(pair.R, pair.T, pair.a, pair.b));
    EXPECT_EQ(distance(X, pair.a, pair.b), distance(pair.R, pair.T, pair.a, pair.b));
  }
}

}  // namespace
}  // namespace kios::testing
