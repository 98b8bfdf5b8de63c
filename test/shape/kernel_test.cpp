// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangle against solid: distance, verdict, witness points and contacts, against the oracle.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "not_finite.h"
#include "shape/shape_oracle.h"
#include "shape/shape_solid.h"
#include "shape/solid_oracle.h"
#include "shape/triangle_shape.h"

namespace kios::testing {
namespace {

using shape::Triangle;
using shape::Vec;

Vec randomPoint(scenes::Random& random, double half_width) {
  return {random.uniform(-half_width, half_width), random.uniform(-half_width, half_width),
          random.uniform(-half_width, half_width)};
}

/// Returns large, small, thin and degenerate ones, near the origin and away from it.
Triangle randomTriangle(scenes::Random& random) {
  const Vec a = randomPoint(random, random.unit() < 0.8 ? 1.2 : 5);
  const double size = std::pow(10.0, random.uniform(-3, 0.5));
  Triangle t = {a, a + randomPoint(random, size), a + randomPoint(random, size)};
  const double kind = random.unit();
  if (kind < 0.1) t[2] = t[0] + random.unit() * (t[1] - t[0]) + randomPoint(random, 1e-9);
  if (kind < 0.05) t[2] = t[1];
  if (kind < 0.02) t[1] = t[2] = t[0];
  return t;
}

double extent(const Triangle& t, const shape::Solid& solid) {
  return std::max({t[0].norm(), t[1].norm(), t[2].norm()}) + solid.reach();
}

class Kernel : public ::testing::TestWithParam<Shape> {};

TEST_P(Kernel, DistanceIsTheOracles) {
  scenes::Random random(11);
  int apart = 0;
  double worst = 0, worst_gap = 0, worst_witness = 0, band = 0;
  for (int i = 0; i < 200; ++i) {
    const ShapeSpec spec = randomShape(GetParam(), random);
    const auto geometry = makeShape<double>(spec);
    const shape::Solid solid = toSolid(*geometry);
    const Triangle t = randomTriangle(random);
    const double scale = extent(t, solid);
    const double depth = static_cast<double>(leastLevel(spec, exact(t), false));
    const auto d = shape::distance(solid, t, kInfinity);
    EXPECT_EQ(d.distance == 0, shape::intersects(solid, t));
    if (std::abs(depth) > 1e-14 * scale && (d.distance == 0) != (depth <= 0)) {
      band = std::max(band, std::abs(depth) / scale);
    }
    if (depth <= 0) continue;
    ++apart;
    const double expected = static_cast<double>(oracleDistance(spec, exact(t)));
    worst = std::max(worst, std::abs(d.distance - expected) / scale);
    worst_gap = std::max(worst_gap, (d.distance - d.lower) / scale);
    worst_witness =
        std::max({worst_witness, std::abs((d.on_triangle - d.on_shape).norm() - d.distance) / scale,
                  static_cast<double>(level(spec, d.on_shape.cast<Real>(), true)) / scale});
  }
  EXPECT_GT(apart, 60);
  EXPECT_LE(worst, 1e-13);
  EXPECT_LE(worst_witness, 1e-14);
  EXPECT_EQ(band, 0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Kernel, ::testing::ValuesIn(kShapes), NameOfShape());

}  // namespace
}  // namespace kios::testing
