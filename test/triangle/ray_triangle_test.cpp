// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A ray and a triangle against exact rational arithmetic: verdicts, parameters to half an ulp,
// sides and weights, on random and on hard cases of every kind.

#include "triangle/ray_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/random.h"
#include "scenes/ray_oracle.h"

namespace kios::testing {
namespace {

using scenes::Random;
using Vector = Eigen::Vector3d;
using Corners = TriangleVertices<double>;

constexpr double kMax = std::numeric_limits<double>::max();

/// Allows half an ulp, but for the oracle's own last bits.
bool isNearest(double t, long double exact) {
  const double next = std::nextafter(std::abs(t), kMax);
  const auto half = 0.5L * (static_cast<long double>(next) - std::abs(t));
  return std::abs(static_cast<long double>(t) - exact) <= half * (1 + 0x1p-10L);
}

class RayTriangle : public ::testing::Test {
 protected:
  void expectRight(bool hit, const TriangleHit& found,
                   const std::optional<scenes::RationalRayHit>& exact) {
    ASSERT_EQ(hit, exact.has_value());
    if (!hit) return;
    EXPECT_TRUE(isNearest(found.t, exact->t)) << found.t << " is not " << exact->t;
    EXPECT_EQ(found.side, exact->crosses ? (exact->along_normal ? 1 : -1) : 0);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(found.weights[i], 0);
      sum += found.weights[i];
      if (!exact->crosses) continue;
      EXPECT_NEAR(found.weights[i], exact->weights[i], 0x1p-51);
    }
    EXPECT_NEAR(sum, 1, 0x1p-50);
  }

  /// One case, in every order of the corners, by both routes.
  void judge(const Vector& origin, const Vector& direction, const Corners& t, double t_min = 0,
             double t_max = kMax) {
    SCOPED_TRACE(::testing::Message()
                 << std::hexfloat << "origin " << origin.transpose() << " direction "
                 << direction.transpose() << " triangle " << t[0].transpose() << ", "
                 << t[1].transpose() << ", " << t[2].transpose() << " t " << t_min << " " << t_max);
    const GivenRay ray = {origin, direction, 0, t_min, t_max};
    double largest = 0;
    for (const Vector& p : t) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    const ExactRay exact_ray(ray, largest);
    const auto exact = scenes::rationalRayHit({origin, direction, t_min, t_max}, t);
    ++(exact ? hits_ : misses_);
    if (exact && !exact->crosses) ++edge_on_;
    TriangleHit hit = {}, by_integers = {};
    expectRight(exact_ray.hits(t, hit), hit, exact);
    expectRight(hitInIntegers(ray, t, by_integers), by_integers, exact);
    for (const auto& order : {std::array{1, 2, 0}, std::array{0, 2, 1}, std::array{2, 1, 0}}) {
      TriangleHit other = {};
      const bool same = exact_ray.hits({t[order[0]], t[order[1]], t[order[2]]}, other);
      ASSERT_EQ(same, exact.has_value());
      EXPECT_TRUE(!same || other.t == hit.t);
    }
    // A power of two in the direction is one in t, in the exponent nothing.
    if (!exact || direction.cwiseAbs().maxCoeff() > 0x1p500) return;
    TriangleHit turned = {};
    const ExactRay shorter({origin, direction * 0x1p100, -100, t_min, t_max}, largest);
    ASSERT_TRUE(shorter.hits(t, turned));
    EXPECT_EQ(turned.t, hit.t);
  }

  Vector vector(double size) {
    const double x = random_.uniform(-size, size), y = random_.uniform(-size, size);
    return {x, y, random_.uniform(-size, size)};
  }
  /// Returns coordinates -n to n.
  Vector lattice(int n) {
    const auto coordinate = [&] { return std::floor(random_.uniform(-n, n + 1)); };
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
  }
  /// Exponents of the whole range.
  Vector wild() {
    Vector v = vector(1);
    for (int c = 0; c < 3; ++c) {
      v[c] = random_.unit() < 0.2 ? 0
                                  : std::ldexp(v[c], static_cast<int>(random_.uniform(-1060, 990)));
    }
    return v;
  }

  Random random_{11};
  int hits_ = 0, misses_ = 0, edge_on_ = 0;
};

TEST_F(RayTriangle, Random) {
  for (int i = 0; i < 4000; ++i) {
    const Corners t = {vector(1), vector(1), vector(1)};
    const Vector origin = vector(2), target = (t[0] + t[1] + t[2]) / 3 + vector(0.4);
    judge(origin, target - origin, t);
  }
  EXPECT_GT(hits_, 1000);
  EXPECT_GT(misses_, 1000);
}

// Through vertices, edges, in planes, from points of the triangle, degenerate: all at once.
TEST_F(RayTriangle, Lattice) {
  for (int i = 0; i < 30000; ++i) {
    const int n = 1 + i % 3;
    const Vector direction = lattice(n);
    if (direction.isZero(0)) continue;
    const double t_min = std::floor(random_.uniform(-1, 2)) / 2;
    judge(lattice(n), direction, {lattice(n), lattice(n), lattice(n)}, t_min,
          i % 2 == 0 ? kMax : t_min + std::floor(random_.uniform(0, 3)) / 2);
  }
  EXPECT_GT(hits_, 2000);
  EXPECT_GT(edge_on_, 300);
}

// Aimed at vertices and at points of edges, which rounding may miss by an ulp.
TEST_F(RayTriangle, AimedAtEdges) {
  for (int i = 0; i < 4000; ++i) {
    const Corners t = {vector(1), vector(1), vector(1)};
    const double s = i % 3 == 0 ? 0 : (i % 3 == 1 ? 0.5 : random_.unit());
    const Vector origin = vector(3), target = t[0] + s * (t[1] - t[0]);
    judge(origin, target - origin, t);
    judge(origin, target - origin, t, 1);
    judge(origin, target - origin, t, 0, 1);
    judge(target, vector(1), t);
  }
  EXPECT_GT(hits_, 1000);
}

// In the plane to rounding, and in the plane.
TEST_F(RayTriangle, Grazing) {
  for (int i = 0; i < 3000; ++i) {
    Corners t = {vector(1), vector(1), vector(1)};
    const auto inside = [&] {
      const double u = random_.uniform(-0.5, 1), v = random_.uniform(-0.5, 1);
      return Vector(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
    };
    const Vector origin = inside();
    judge(origin, inside() - origin, t);
    for (Vector& p : t) p[2] = 0.25;
    const Vector flat = inside();
    judge(flat, inside() - flat, t, i % 2 == 0 ? 0 : random_.uniform(-1, 1));
  }
  EXPECT_GT(edge_on_, 1000);
}

TEST_F(RayTriangle, SegmentsAndPoints) {
  for (int i = 0; i < 3000; ++i) {
    const Vector p = lattice(4), q = lattice(4),
                 direction = i % 4 == 0 ? Vector(q - p) : lattice(3);
    if (direction.isZero(0)) continue;
    const Vector middle = 0.5 * (p + q), origin = middle - random_.uniform(0, 3) * direction;
    judge(origin, direction, {p, q, middle});
    judge(middle - 2 * direction, direction, {p, middle, q});
    judge(middle - 0.75 * direction, direction, {middle, middle, middle});
    judge(middle, direction, {p, p, q}, -2);
  }
  EXPECT_GT(edge_on_, 3000);
}

TEST_F(RayTriangle, ScalesAndOffsets) {
  for (const double scale : {1e-300, 1e-150, 1e-30, 1.0, 1e30, 1e150, 1e300}) {
    for (const double offset : {0.0, 1.0, 1e9, 1e30}) {
      if (scale * offset > 1e300) continue;
      for (int i = 0; i < 40; ++i) {
        const Vector away = offset * vector(1);
        const Corners t = {scale * (away + vector(1)), scale * (away + vector(1)),
                           scale * (away + vector(1))};
        const Vector target = t[0] / 3 + t[1] / 3 + t[2] / 3 + scale * vector(0.2);
        const Vector origin = target + scale * (i % 2 == 0 ? offset : 2) * vector(1);
        if (origin == target) continue;
        judge(origin, target - origin, t);
        judge(origin, 0x1p-50 * (t[1] - origin), t);
      }
    }
  }
  EXPECT_GT(hits_, 400);
}

TEST_F(RayTriangle, WholeRangeOfExponents) {
  for (int i = 0; i < 1500; ++i) {
    Vector direction = wild();
    if (direction.isZero(0)) direction = Vector::UnitX();
    Corners t = {wild(), wild(), wild()};
    if (i % 2 == 0) t[2] = t[0] + (t[1] - t[0]) * random_.unit();
    judge(i % 3 == 0 ? t[0] : wild(), direction, t, i % 5 == 0 ? -kMax : 0);
    judge(wild(), Vector::UnitZ() * 0x1p-1070, t);
  }
  const double tiny = 0x1p-1074;
  judge({0, 0, -tiny}, {0, 0, tiny}, {Vector(0, 0, 0), Vector(tiny, 0, 0), Vector(0, tiny, 0)});
  judge({0, 0, -1}, {0, 0, 0x1p999}, {Vector(0, 0, 0), Vector(tiny, 0, 0), Vector(0, tiny, 0)});
  judge({tiny, 0, -1}, {0, 0, 0x1p-1022}, {Vector(0, 0, 1), Vector(1, 0, 1), Vector(0, 1, 1)});
  EXPECT_GT(hits_, 100);
}

// The first t outside, the last one inside.
TEST_F(RayTriangle, EndsOfTheRayAreExact) {
  const Corners t = {Vector(0, 0, 1), Vector(1, 0, 1), Vector(0, 1, 1)};
  for (const double z : {3.0, 7.0, 10.0, 0.1}) {  // t = 1 / z is rounded, but for none of these
    const Vector direction(0.1 * z, 0.1 * z, z);
    TriangleHit hit;
    ASSERT_TRUE(ExactRay({Vector::Zero(), direction, 0, 0, kMax}, 1).hits(t, hit));
    for (const double end : {std::nextafter(hit.t, 0.0), hit.t, std::nextafter(hit.t, 2 * hit.t)}) {
      judge(Vector::Zero(), direction, t, 0, end);
      judge(Vector::Zero(), direction, t, end, kMax);
      judge(Vector::Zero(), direction, t, end, end);
    }
  }
  EXPECT_GE(hits_, 12);
  EXPECT_GE(misses_, 12);
}

}  // namespace
}  // namespace kios::testing
