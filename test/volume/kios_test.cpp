// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The volume by itself: its size in memory, its empty state and what it computes of its spheres.
#include "fcl_kios/volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <new>

#include <fcl/geometry/bvh/BV_node.h>
#include <fcl/math/bv/kIOS.h>
#include "scalars.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

static_assert(sizeof(fcl::BVNode<kIOSd>) <= 128, "two nodes in four cache lines");
static_assert(sizeof(fcl::BVNode<kIOSf>) <= sizeof(fcl::BVNode<kIOSd>), "smaller in float");
static_assert(sizeof(fcl::BVNode<kIOSd>) < sizeof(fcl::BVNode<fcl::kIOSd>) / 2, "defect 9 of FCL");

KIOS_SCALAR_SUITE(Kios);

// Whatever the memory held before: FCL's kIOS reads its uninitialised count here.
TYPED_TEST(Kios, DefaultIsEmptyInAnyMemory) {
  using S = TypeParam;
  alignas(kIOS<S>) unsigned char memory[sizeof(kIOS<S>)];
  for (const int fill : {0x00, 0xff, 0x7f, 0xa5}) {
    std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(fill));
    auto* const v = new (memory) kIOS<S>;
    EXPECT_EQ(v->k(), 0);
    EXPECT_FALSE(v->contain(fcl::Vector3<S>::Zero()));
    EXPECT_EQ(v->volume(), 0);
    EXPECT_EQ(v->size(), 0);
    EXPECT_EQ(v->width(), 0);
    EXPECT_EQ(v->height(), 0);
    EXPECT_EQ(v->depth(), 0);
    *v += fcl::Vector3<S>(1, 2, 3);
    EXPECT_EQ(v->k(), 1);
    EXPECT_EQ(v->center0, (fcl::Vector3<S>(1, 2, 3)));
    EXPECT_EQ(v->radius0, 0);
    EXPECT_TRUE(v->contain(fcl::Vector3<S>(1, 2, 3)));
    EXPECT_FALSE(v->contain(fcl::Vector3<S>(1, 2, S(3.0001))));
    v->~kIOS<S>();
  }
}

TYPED_TEST(Kios, EmptyBoundsAreInverted) {
  using S = TypeParam;
  fcl::Vector3<S> lower, upper;
  kIOS<S>().bounds(lower, upper);
  for (int c = 0; c < 3; ++c) EXPECT_GT(lower[c], upper[c]);
}

TYPED_TEST(Kios, MeasuresOfABall) {
  using S = TypeParam;
  kIOS<S> ball = fitted<S>({{-2, 1, 1}, {2, 1, 1}, {0, 3, 1}, {0, -1, 1}, {0, 1, 3}, {0, 1, -1}});
  ASSERT_EQ(ball.k(), 1);
  EXPECT_NEAR(ball.radius0, 2, 1e-5);
  EXPECT_NEAR(ball.width(), 4, 1e-5);
  EXPECT_NEAR(ball.height(), 4, 1e-5);
  EXPECT_NEAR(ball.depth(), 4, 1e-5);
  EXPECT_NEAR(ball.size(), 16, 1e-4);
  EXPECT_GE(ball.volume(), 4.18879020478639 * 8);
  EXPECT_NEAR(ball.volume(), 4.18879020478639 * 8, 1e-3);
  EXPECT_LE((ball.center() - fcl::Vector3<S>(0, 1, 1)).norm(), 1e-5);
}

TYPED_TEST(Kios, CapsCutAFlatPatch) {
  using S = TypeParam;
  Random random(1);
  Points<S> points(60);
  for (auto& p : points) {
    p << random.uniform(-1, 1), random.uniform(-0.6, 0.6), random.uniform(-0.02, 0.02);
  }
  const auto v = fitted(points);
  ASSERT_EQ(v.k(), 5);
  EXPECT_LE(v.depth(), 0.75 * v.width());
  EXPECT_LE(v.volume(), 4.19 * v.radius0 * v.radius0 * v.radius0);
  EXPECT_FALSE(v.contain(v.center0 + fcl::Vector3<S>(0, 0, S(0.9) * v.radius0)));
  for (int i = 1; i < 5; ++i) {
    EXPECT_GT(v.sphereRadius(i), v.radius0);
    EXPECT_GT((v.sphereCenter(i) - v.center0).norm(), 0.1);
  }
}

TYPED_TEST(Kios, SizeSaturates) {
  using S = TypeParam;
  const S huge = static_cast<S>(std::ldexp(1.0, sizeof(S) == sizeof(double) ? 1000 : 120));
  const auto v = fitted<S>({{-huge, 0, 0}, {huge, 0, 0}, {0, huge, huge}});
  EXPECT_EQ(v.size(), std::numeric_limits<S>::max());
  EXPECT_EQ(v.volume(), std::numeric_limits<S>::max());
  EXPECT_TRUE(std::isfinite(v.width()) && v.width() >= huge);
}

TYPED_TEST(Kios, OrdinaryRadiiNeedNoUnits) {
  using S = TypeParam;
  for (int e = -29; e <= 28; ++e) {
    const S size = static_cast<S>(std::ldexp(1.3, e));
    EXPECT_EQ((fitted<S>({{0, 0, 0}, {size, 0, 0}, {0, size, size}}).exponent), 0) << e;
  }
  for (const int e : {-60, -33, 33, 60}) {
    const S size = static_cast<S>(std::ldexp(1.3, e));
    EXPECT_NEAR((fitted<S>({{0, 0, 0}, {size, 0, 0}, {0, size, size}}).exponent), e, 1) << e;
  }
}

// Rounded outwards, and by no more than rounding.
TYPED_TEST(Kios, BoundsEncloseTheIntersection) {
  using S = TypeParam;
  Random random(3);
  for (int set = 0; set < 20'000; ++set) {
    const auto v = fitted(hardPointSet<S>(random, randomCount(random)));
    fcl::Vector3<S> lower, upper;
    v.bounds(lower, upper);
    for (int c = 0; c < 3; ++c) {
      Exact low = -std::numeric_limits<Exact>::max(), high = -low;
      for (int i = 0; i < v.k(); ++i) {
        const StoredSphere<Exact> sphere(v, i);
        low = std::max(low, Exact(sphere.center0[c] + sphere.offset[c] - sphere.radius));
        high = std::min(high, Exact(sphere.center0[c] + sphere.offset[c] + sphere.radius));
      }
      ASSERT_LE(lower[c], low) << "set " << set;
      ASSERT_GE(upper[c], high) << "set " << set;
      const double slack = 4 * std::numeric_limits<S>::epsilon() *
                               (std::abs(double{v.center0[c]}) + 4 * double{v.radius0}) +
                           4 * double{std::numeric_limits<S>::min()};
      ASSERT_GE(lower[c], low - slack) << "set " << set;
      ASSERT_LE(upper[c], high + slack) << "set " << set;
    }
  }
}

// contain() is sharp to a few ulps: FCL's octrees and our refits rely on either side of it.
TYPED_TEST(Kios, ContainExcludesWhatASphereExcludes) {
  using S = TypeParam;
  Random random(2);
  for (int set = 0; set < 5'000; ++set) {
    const auto points = hardPointSet<S>(random, randomCount(random));
    const auto v = fitted(points);
    if (!(v.radius0 > 1e3 * std::numeric_limits<S>::min())) continue;
    for (int i = 0; i < 8; ++i) {
      const fcl::Vector3<S> p =
          v.center0 +
          (randomDirection(random) * v.radius0 * random.uniform(0.5, 1.2)).template cast<S>();
      bool inside = true, clearly_outside = false;
      const long double q[3] = {p[0], p[1], p[2]};
      for (int s = 0; s < v.k(); ++s) {
        const StoredSphere<long double> sphere(v, s);
        long double error;
        const long double distance = sphere.distanceTo(q, &error);
        inside &= distance <= sphere.radius;
        clearly_outside |= distance > sphere.radius * (1 + 1e-14L);
      }
      if (inside) {
        ASSERT_TRUE(v.contain(p)) << "set " << set;
      }
      if (clearly_outside) {
        ASSERT_FALSE(v.contain(p)) << "set " << set;
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
