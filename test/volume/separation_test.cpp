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
  constexpr long double kUnderflow =
      0x1p-499L + 64 * static_cast<long double>(std::numeric_limits<S>::denorm_min());
  Random random(1);
  int apart = 0, clear = 0, stopped = 0;
  for (int i = 0; i < 60'000; ++i) {
    SCOPED_TRACE(i);
    const HardPair<S> pair(random);
    const RelativePose<S> X(pair.R, pair.T);
    const double bound = separation(pair.a, pair.b, X, kInfinity);
    ASSERT_TRUE(std::isfinite(bound));
    ASSERT_TRUE(pair.distanceIsAtLeast(bound)) << bound;
    ASSERT_TRUE(pair.roundedDistanceIsAtLeast(bound)) << bound;
    const S value = distance(pair.R, pair.T, pair.a, pair.b);
    ASSERT_TRUE(pair.distanceIsAtLeast(value)) << value;
    ASSERT_GE(value, 0);
    ASSERT_LE(value, std::max(0.0, bound));
    ASSERT_EQ(overlap(pair.R, pair.T, pair.a, pair.b), !(bound > 0));
    apart += bound > 0;
    // It is the largest of the sphere pairs. Above: by nothing that 64 bits can tell. Below: by the
    // pads that the sources derive.
    const long double best = pair.sphereSeparation();
    clear += bound > 0.5 * static_cast<double>(best);
    ASSERT_LE(bound, best + 64 * kFilterUlp * pair.magnitude());
    const long double pads = 1e-5L * pair.reaches() + 40 * pair.rounding() * pair.magnitude() +
                             1.5L * pair.shear() * pair.reaches();
    ASSERT_GE(bound, best - pads - kUnderflow);
    for (const double enough : {-kInfinity, 0.0, bound * random.uniform(0.5, 1.5)}) {
      const double early = separation(pair.a, pair.b, X, enough);
      ASSERT_LE(early, bound);
      ASSERT_EQ(early > enough, bound > enough);
      ASSERT_TRUE(early > enough || early == bound);
      stopped += early < bound;
    }
    fcl::Transform3<S> both = fcl::Transform3<S>::Identity();
    both.linear() = pair.R;
    both.translation() = pair.T;
    ASSERT_EQ(overlap(both, pair.a, pair.b), !(bound > 0));
    ASSERT_EQ(distance(both, pair.a, pair.b), value);
  }
  EXPECT_GT(apart, 15'000);  // the poses are not all trivial
  EXPECT_GT(clear, 10'000);
  EXPECT_GT(stopped, 100);
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

}  // namespace
}  // namespace kios::testing
