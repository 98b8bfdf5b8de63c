// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A point and a triangle, by the nearest point and by the solid angle, against integers and numbers
// of 100 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "scenes/rational_oracle.h"
#include "scenes/triangle_classes.h"
#include "scenes/triangle_families.h"
#include "scenes/triangle_pair.h"
#include "triangle/point_distance.h"
#include "triangle/solid_angle.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Number = boost::multiprecision::cpp_bin_float_100;
using scenes::Random;

void expectNearest(const Pointd& p, const TriangleVerticesd& t, const char* name) {
  const NearestOnTriangle near = nearestOnTriangle(p, t);
  const long double exact = scenes::rationalDistance(p, t);
  const long double L = scenes::extent({{p, p, p}, t});
  const long double bound = 16 * 0x1p-52L * L + std::numeric_limits<double>::denorm_min();
  ASSERT_LE(std::abs(near.distance - exact), bound)
      << name << ": " << near.distance << " at " << p.transpose();
  ASSERT_EQ(near.distance == 0, exact == 0) << name;
  ASSERT_LE(scenes::rationalDistance(near.point, t),
            bound + 16 * 0x1p-52L * scenes::magnitude({t, t}))
      << name;
}

TEST(PointDistance, EveryClassOfTriangles) {
  const auto& classes = scenes::triangleClasses();
  for (std::size_t i = 0; i < classes.size(); ++i) {
    for (const auto& pair : scenes::trianglePairs(i, 300, 5)) {
      for (const Pointd& p : pair.a) expectNearest(p, pair.b, classes[i].name);
      for (const Pointd& p : pair.b) expectNearest(p, pair.b, classes[i].name);
    }
  }
}

/// Returns a point of any kind about a triangle: over its parts, at any distance from them.
Pointd pointAbout(const TriangleVerticesd& t, Random& random) {
  const double s = random.unit(), r = random.unit();
  const int k = scenes::integer(random, 0, 4);
  Pointd p = t[0];
  if (k == 1) p = t[1] + s * (t[2] - t[1]);
  if (k == 2) p = (t[0] + t[1] + t[2]) / 3;
  if (k == 3) p += s * (t[1] - t[0]) + r * (1 - s) * (t[2] - t[0]);
  if (k == 4) p += 3 * (s - 0.5) * (t[1] - t[0]) + 3 * (r - 0.5) * (t[2] - t[0]);
  const double size = std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
  if (scenes::integer(random, 0, 5) > 0) {
    p += size * scenes::displacement(random, -60, 30);
  } else {  // straight above
    p += size * std::ldexp(1.0, scenes::integer(random, -60, 10)) *
         (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  }
  return p;
}

TriangleVerticesd anyTriangle(Random& random) {
  const Pointd a = scenes::point(random), e = scenes::displacement(random, -4, 0);
  const double thin = std::ldexp(1.0, scenes::integer(random, -52, 0));
  const Pointd b = a + e, c = a + random.uniform(-0.5, 1.5) * e + thin * scenes::point(random);
  return {a, b, c};
}

/// Where products of coordinates, but not the coordinates, leave the range of doubles.
TEST(PointDistance, AnySize) {
  Random random(6);
  for (int exponent = -1000; exponent <= 960; exponent += 4) {
    const double scale = std::ldexp(1.0, exponent);
    for (int i = 0; i < 12; ++i) {
      const TriangleVerticesd unit = anyTriangle(random);
      const Pointd p = scale * pointAbout(unit, random);
      expectNearest(p, {scale * unit[0], scale * unit[1], scale * unit[2]}, "scaled");
    }
    // Over the triangle, near it in its own size, and over one that is thin in p's.
    const double thin = std::max(std::ldexp(1.3, -exponent / 2 - 537), 0x1p-1000);
    const double low = 0x1p-18 * scale, high = 0x1p-28 * scale;
    expectNearest({low, low, high}, {Pointd(0, 0, 0), {scale, 0, 0}, {0, scale, 0}}, "flat");
    for (const double z : {1.0, 2.0, 3.0}) {
      expectNearest(scale * Pointd(0.4, 0.3 * thin, z),
                    {Pointd(0, 0, 0), {scale, 0, 0}, {0, scale * thin, 0}}, "sliver");
    }
  }
}

TEST(PointDistance, PointsOverEveryPartOfAnyTriangle) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const TriangleVerticesd t = anyTriangle(random);
    expectNearest(pointAbout(t, random), t, "any");
  }
}

/// The part of all directions, by the same formula in more digits.
double accurateAngle(const Pointd& p, const TriangleVerticesd& t) {
  Number v[3][3], length[3];
  for (std::size_t k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) v[k][c] = Number(t[k][c]) - Number(p[c]);
    length[k] = sqrt(v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2]);
  }
  const auto dot = [&](int i, int j) {
    return Number(v[i][0] * v[j][0] + v[i][1] * v[j][1] + v[i][2] * v[j][2]);
  };
  Number y = 0;
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    y += v[0][c] * (v[1][d] * v[2][e] - v[1][e] * v[2][d]);
  }
  const Number x = length[0] * length[1] * length[2] + dot(0, 1) * length[2] +
                   dot(1, 2) * length[0] + dot(2, 0) * length[1];
  return static_cast<double>(Number(atan2(y, x) / (2 * boost::math::constants::pi<Number>())));
}

TEST(SolidAngle, RightNearEdgesAndPlanes) {
  Random random(9);
  int on = 0, large = 0, near_edges = 0;
  for (int i = 0; i < 20000; ++i) {
    const TriangleVerticesd t = anyTriangle(random);
    const Pointd p = pointAbout(t, random);
    if (scenes::rationalDistance(p, t) == 0) {
      ++on;
      ASSERT_EQ(solidAngle(p, t), 0);
      continue;
    }
    const double exact = accurateAngle(p, t);
    large += std::abs(exact) > 0.1;
    long double edges[3], size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Pointd &a = t[k], &b = t[(k + 1) % 3];
      edges[k] = scenes::rationalDistance(p, {a, b, b});
      size = std::max<long double>(size, (a - b).norm());
    }
    std::sort(edges, edges + 3);
    near_edges += edges[0] < 0x1p-40L * size;
    const long double product = edges[0] / size * (edges[1] / size);
    const double bound = static_cast<double>(std::max(0x1p-46L, 0x1p-102L / product));
    ASSERT_NEAR(solidAngle(p, t), exact, bound) << i << ": " << p.transpose();
    ASSERT_NEAR(solidAngle(p, {t[0], t[2], t[1]}), -exact, bound);
  }
  EXPECT_GT(on, 10);
  EXPECT_GT(large, 500);
  EXPECT_GT(near_edges, 500);
}

TEST(SolidAngle, AnySize) {
  for (const double scale : {1e-300, 1e-120, 1e-30, 1e30, 1e120, 1e300}) {
    const TriangleVerticesd t = {Pointd(scale, 0, 0), Pointd(0, scale, 0), Pointd(0, 0, scale)};
    EXPECT_NEAR(solidAngle({0, 0, 0}, t), 0.125, 1e-15) << scale;
  }
}

}  // namespace
}  // namespace kios
