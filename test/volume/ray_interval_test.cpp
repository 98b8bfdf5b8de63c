// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A ray and a k-IOS: the interval never cuts off content, and is as tight as spheres can be.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fcl/expect_refused.h"
#include "fcl_kios/rays.h"
#include "scalars.h"
#include "scenes/ray_oracle.h"
#include "volume/exact_spheres.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(RayIntervalTest);

template <typename S>
kIOS<S> ball(const fcl::Vector3<S>& center, S radius) {
  kIOS<S> bv;
  bv.center0 = center;
  bv.radius0 = radius;
  bv.num_spheres = 1;
  bv.reach = static_cast<float>(radius);
  return bv;
}

template <typename S>
scenes::RationalRay asRational(const Ray<S>& ray) {
  return {ray.origin.template cast<double>(), ray.direction.template cast<double>(), ray.t_min,
          std::min<double>(ray.t_max, std::numeric_limits<S>::max())};
}

// Rays through points of triangles of the content, exactly where those are: the oracle says.
TYPED_TEST(RayIntervalTest, NeverCutsOffContent) {
  using S = TypeParam;
  Random random(3);
  int inside = 0;
  for (int i = 0; i < 6000; ++i) {
    const int n = randomCount(random);
    const Points<S> points = hardPointSet<S>(random, n);
    const kIOS<S> bv = fitted(points, i % 2 == 0 ? FitMethod::kTuned : FitMethod::kMethodII);
    const auto any = [&]() -> const fcl::Vector3<S>& { return points[below(random, n)]; };
    const fcl::Vector3<S> p = any(), q = any(), r = any();
    const S w = static_cast<S>(random.unit()), size = bv.radius0;
    const fcl::Vector3<S> target = p + w * (q - p);
    const S away = static_cast<S>(std::pow(10.0, random.uniform(-2, i % 3 == 0 ? 9 : 1)));
    Ray<S> ray;
    ray.origin = target + away * size * randomDirection(random).cast<S>();
    ray.direction = i % 4 == 0 ? (r - p).eval() : (target - ray.origin).eval();
    if (i % 5 == 0) ray.origin = target;  // starts in the content
    if (i % 7 == 0) ray.t_min = S(-10);
    if (i % 11 == 0) ray.t_max = S(1);
    if (ray.direction.isZero(0) || !ray.origin.allFinite() || !ray.direction.allFinite()) continue;
    const auto interval = rayInterval(bv, ray);
    EXPECT_EQ(overlap(ray, bv), interval.has_value());
    for (const auto& t : {std::array{p, p, p}, std::array{p, q, q}, std::array{p, q, r}}) {
      const auto hit = scenes::rationalRayHit(
          asRational(ray), {t[0].template cast<double>(), t[1].template cast<double>(),
                            t[2].template cast<double>()});
      if (!hit) continue;
      ++inside;
      ASSERT_TRUE(interval) << "case " << i;
      EXPECT_LE(interval->enter, hit->t) << "case " << i;
      EXPECT_GE(interval->exit, hit->t) << "case " << i;
    }
    if (!interval) continue;
    EXPECT_GE(interval->enter, ray.t_min);
    EXPECT_LE(interval->exit, ray.t_max);
    EXPECT_LE(interval->enter, interval->exit);
  }
  EXPECT_GT(inside, 2000);
}

// Rays that only touch a sphere, at a point of the content, from which they start both ways.
TYPED_TEST(RayIntervalTest, TangentAtContent) {
  using S = TypeParam;
  Random random(8);
  for (int i = 0; i < 20000; ++i) {
    const int n = randomCount(random);
    const Points<S> points = hardPointSet<S>(random, n);
    const kIOS<S> bv = fitted(points);
    Ray<S> ray;
    ray.origin = points[below(random, n)];
    const int sphere = below(random, bv.k());
    const fcl::Vector3d radius = (ray.origin - bv.sphereCenter(sphere)).template cast<double>();
    ray.direction = radius.normalized().cross(randomDirection(random)).template cast<S>();
    ray.t_min = -std::numeric_limits<S>::max();
    if (ray.direction.isZero(0)) continue;
    const auto interval = rayInterval(bv, ray);
    ASSERT_TRUE(interval) << "case " << i;
    EXPECT_LE(interval->enter, 0) << "case " << i;
    EXPECT_GE(interval->exit, 0) << "case " << i;
  }
}

// It holds from afar, on grids where that is exact: most digits of the origin cancel.
TYPED_TEST(RayIntervalTest, TangentFromAfar) {
  using S = TypeParam;
  Random random(18);
  const bool is_double = sizeof(S) == sizeof(double);
  const double grid = is_double ? 0x1p20 : 0x1p8, turn = is_double ? 0x1p10 : 0x1p6;
  const auto on = [](const fcl::Vector3d& v, double per_unit) {
    return fcl::Vector3d((v * per_unit).array().round() / per_unit);
  };
  for (int i = 0; i < 20000; ++i) {
    const int n = 3 + below(random, 6);
    Points<S> points;
    for (const auto& p : shapePoints(random, PointShape::kRandom, n)) {
      points.push_back(on(p, grid).template cast<S>());
    }
    const kIOS<S> bv = fitted(points);
    const fcl::Vector3d p = points[below(random, n)].template cast<double>();
    const fcl::Vector3d center = bv.sphereCenter(below(random, bv.k())).template cast<double>();
    const fcl::Vector3d direction =
        on((p - center).normalized().cross(randomDirection(random)), turn);
    if (direction.isZero(0)) continue;
    Ray<S> ray;
    ray.origin = (p - grid * direction).template cast<S>();
    ray.direction = direction.template cast<S>();
    ASSERT_EQ((ray.origin.template cast<double>() + grid * direction), p);
    const auto interval = rayInterval(bv, ray);
    ASSERT_TRUE(interval) << "case " << i;
    EXPECT_LE(interval->enter, grid) << "case " << i;
    EXPECT_GE(interval->exit, grid) << "case " << i;
  }
}

TYPED_TEST(RayIntervalTest, EmptyAndPoint) {
  using S = TypeParam;
  Ray<S> ray;
  EXPECT_FALSE(overlap(ray, kIOS<S>()));
  const kIOS<S> point = ball<S>({3, 0, 0}, 0);
  const auto there = rayInterval(point, ray);
  ASSERT_TRUE(there);
  EXPECT_LE(there->enter, 3);
  EXPECT_GE(there->exit, 3);
  ray.direction = {1, S(0.125), 0};
  EXPECT_FALSE(overlap(ray, point));
}

TYPED_TEST(RayIntervalTest, BadRaysAreRefused) {
  using S = TypeParam;
  const kIOS<S> bv = ball<S>({0, 0, 0}, 1);
  const S nan = std::numeric_limits<S>::quiet_NaN(), inf = std::numeric_limits<S>::infinity();
  const auto refused = [&](const char* what, Ray<S> ray) {
    expectRefused([&] { rayInterval(bv, ray); }, what);
    EXPECT_THROW(overlap(ray, bv), std::invalid_argument);
  };
  const fcl::Vector3<S> x = fcl::Vector3<S>::UnitX();
  refused("origin", {nan * x, x});
  refused("origin", {inf * x, x});
  refused("origin", {std::numeric_limits<S>::max() * x, x});
  refused("direction", {x, nan * x});
  refused("direction", {x, fcl::Vector3<S>(inf, 0, 0)});
  refused("direction is zero", {x, S(0) * x});
  refused("t_min", {x, x, nan});
  refused("t_min", {x, x, -inf});
  refused("t_max", {x, x, 0, nan});
  refused("t_max", {x, x, 1, S(0.5)});
}

}  // namespace
}  // namespace kios::testing
