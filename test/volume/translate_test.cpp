// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A moved volume contains the moved points, as they are exactly and as they are rounded to S.
#include <gtest/gtest.h>

#include "fcl_kios/volume.h"
#include "scalars.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(Translate);

template <typename S>
fcl::Vector3<S> randomShift(Random& random, const kIOS<S>& v) {
  const double size = v.radius0 > 0 ? double{v.radius0} : 1.0;
  return (randomDirection(random) * size * std::pow(10.0, random.uniform(-9, 12)))
      .template cast<S>();
}

TYPED_TEST(Translate, ContainsTheMovedPointsExactly) {
  using S = TypeParam;
  Random random(1);
  for (int set = 0; set < 5'000; ++set) {
    const auto points = hardPointSet<S>(random, 1 + below(random, 12));
    const auto v = fitted(points);
    const fcl::Vector3<S> t = randomShift(random, v);
    ASSERT_EQ(violation(translate(v, t), points, t), "") << "set " << set;
  }
}

// FCL moves a model's vertices in S. Their rounding is not the volume's to know, yet it is at most
// half an ulp of the moved point a coordinate, and so must be the loss.
TYPED_TEST(Translate, LosesAtMostTheRoundingOfThePoints) {
  using S = TypeParam;
  Random random(2);
  for (int set = 0; set < 5'000; ++set) {
    const auto points = hardPointSet<S>(random, 1 + below(random, 12));
    const auto v = fitted(points);
    const fcl::Vector3<S> t = randomShift(random, v);
    kIOS<S> moved = translate(v, t);
    for (const auto& p : points) {
      const fcl::Vector3<S> rounded = p + t;
      const long double q[3] = {rounded[0], rounded[1], rounded[2]};
      const long double half_ulp = std::numeric_limits<S>::epsilon() / 2 *
                                   rounded.template cast<long double>().template lpNorm<1>();
      for (int i = 0; i <= 4; ++i) {
        const StoredSphere<long double> sphere(moved, i);
        long double error;
        const long double distance = sphere.distanceTo(q, &error);
        ASSERT_LE(distance, sphere.radius + half_ulp + 16 * kFilterUlp * error) << "set " << set;
      }
    }
  }
}

TYPED_TEST(Translate, GrowsByTheRoundingOfTheCentreOnly) {
  using S = TypeParam;
  Random random(3);
  for (int set = 0; set < 5'000; ++set) {
    const auto v = fitted(place<S>(random, shapePoints(random, PointShape::kRandom, 12), 0, 1));
    const fcl::Vector3<S> t = randomShift(random, v);
    const auto moved = translate(v, t);
    const double ulp = std::numeric_limits<S>::epsilon() * moved.center0.template lpNorm<1>();
    EXPECT_LE(moved.radius0, v.radius0 * (1 + 4 * std::numeric_limits<S>::epsilon()) + ulp);
    if (ulp < 1e-3) {
      ASSERT_EQ(moved.k(), v.k());
    }
    for (int i = 0; i < 4 && moved.k() == v.k(); ++i) {
      EXPECT_LE(moved.cap_r[i], v.cap_r[i] * (1 + 1e-6) + ulp);
    }
  }
}

TYPED_TEST(Translate, EmptyStaysEmpty) {
  using S = TypeParam;
  EXPECT_EQ(translate(kIOS<S>(), fcl::Vector3<S>(1, 2, 3)).k(), 0);
}

// Just below and above the radii at which caps change their units.
TYPED_TEST(Translate, KeepsContainingWhereUnitsChange) {
  using S = TypeParam;
  Random random(5);
  for (int set = 0; set < 2'000; ++set) {
    const double boundary = set % 2 ? 0x1p-30 : 0x1p30;
    auto points = place<S>(random, shapePoints(random, PointShape::kCoplanar, 9), 0, boundary);
    const auto first = fitted(points);
    const S to_boundary = static_cast<S>(boundary / first.radius0 * (1 - set * 1e-9 + 2e-6));
    for (auto& p : points) p *= to_boundary;
    const auto v = fitted(points);
    const fcl::Vector3<S> t = randomShift(random, v);
    ASSERT_EQ(violation(translate(v, t), points, t), "") << "set " << set;
  }
}

}  // namespace
}  // namespace kios::testing
