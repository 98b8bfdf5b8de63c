// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What docs/shapes.md promises of a triangle and a shape that nearly touch: verdicts, distances,
// lower bounds, nearest points and early ends, with gaps from 1e-15 to 0.1 of the shape, for flat
// and thin shapes, and for triangles from 1e-9 to 1e6 of the shape that may degenerate.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shape/solid_cases.h"

namespace kios::testing {
namespace {

using shape::Kind;
using shape::Solid;
using shape::Triangle;
using shape::Vec;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Kind kKinds[] = {Kind::kSphere,    Kind::kCapsule,  Kind::kBox, Kind::kConvex,
                           Kind::kEllipsoid, Kind::kCylinder, Kind::kCone};

const char* nameOf(Kind kind) {
  constexpr const char* kNames[] = {"sphere",   "capsule", "box",   "ellipsoid",
                                    "cylinder", "cone",    "convex"};
  return kNames[static_cast<int>(kind)];
}

bool isRound(Kind kind) {
  return kind == Kind::kEllipsoid || kind == Kind::kCylinder || kind == Kind::kCone;
}

/// How far a point lies from a triangle, or outside of a solid.
Real offTriangle(const Vec& p, const Triangle& t) {
  const ExactPoint x = p.cast<Real>();
  return scenes::triangleDistance({x, x, x}, exact(t));
}

Real outside(const NearPair& pair, const Vec& p) {
  if (pair.round()) return pointLevel(pair.solid, p.cast<Real>());
  if (pair.solid.kind == Kind::kBox) return (p.cwiseAbs() - pair.solid.half).maxCoeff();
  const ExactPoint x = p.cast<Real>();
  Real least = std::numeric_limits<Real>::infinity();
  for (const ExactTriangle& f : pair.faces) {
    least = std::min(least, scenes::triangleDistance({x, x, x}, f) - pair.solid.margin());
  }
  const bool full = pair.solid.kind == Kind::kConvex && pair.solid.num_faces >= 4;
  if (full) least = std::min(least, FaceLevel(pair.solid, pair.faces)(x));
  return least;
}

class NearContact : public ::testing::TestWithParam<Kind> {};

TEST_P(NearContact, PromisesAreKept) {
  const Kind kind = GetParam();
  const Real promised = isRound(kind) ? 0x1p-43L : 0x1p-46L;
  const int count = isRound(kind) ? 150 : 1500;
  SolidCases cases(31 + static_cast<int>(kind));
  for (const Size size : kSizes) {
    int apart = 0, wrong_verdicts = 0, wrong_ends = 0;
    Real worst = 0, below = 0, above = 0, off = 0, split = 0, contact_off = 0;
    for (int i = 0; i < count; ++i) {
      const NearPair pair = nearPair(cases, kind, size);
      const Real L = pair.extent;
      // Ellipsoids are judged in units of their radii.
      Real band = 0x1p-46L * L;
      if (kind == Kind::kEllipsoid) band *= pair.solid.half.maxCoeff();
      if (kind == Kind::kEllipsoid) band /= std::max(1e-40, pair.solid.half.minCoeff());
      const auto d = shape::distance(pair.solid, pair.triangle, kInfinity);
      const bool meets = shape::intersects(pair.solid, pair.triangle);
      EXPECT_EQ(d.distance == 0, meets);
      if (pair.judged) wrong_verdicts += meets ? pair.distance > band : pair.depth > band;
      if (meets) {
        const auto contact = shape::contact(pair.solid, pair.triangle);
        EXPECT_GE(contact.depth, 0);
        EXPECT_NEAR(contact.normal.norm(), 1, 1e-12);
        contact_off = std::max(contact_off, offTriangle(contact.position, pair.triangle) / L);
        contact_off = std::max(contact_off, outside(pair, contact.position) / L);
      }
      off = std::max(off, offTriangle(d.on_triangle, pair.triangle) / L);
      off = std::max(off, outside(pair, d.on_shape) / L);
      if (meets || pair.depth > 0 || !pair.judged) continue;
      ++apart;
      worst = std::max(worst, std::abs(d.distance - pair.distance) / L);
      below = std::max(below, (pair.distance - d.distance) / L);
      above = std::max(above, (d.lower - pair.distance) / L);
      split = std::max(split, std::abs((d.on_triangle - d.on_shape).norm() - d.distance) / L);
      // The same question asked as "nearer than this?"
      const double exact_distance = static_cast<double>(pair.distance);
      const double enough = exact_distance * (1 + (cases.pick(2) ? 1 : -1) * cases.power(-12, -1));
      const auto ended = shape::distance(pair.solid, pair.triangle, enough);
      wrong_ends += ended.distance > enough
                        ? pair.distance < enough - promised * L
                        : std::abs(ended.distance - pair.distance) > promised * L;
    }
    const auto where = [&] {
      return std::string(nameOf(kind)) + ", size " + std::to_string(int(size));
    };
    EXPECT_GT(apart, count / 4) << where();
    EXPECT_EQ(wrong_verdicts, 0) << where();
    EXPECT_EQ(wrong_ends, 0) << where();
    EXPECT_LE(worst, promised) << where();
    EXPECT_LE(below, 0x1p-48L) << where();
    EXPECT_LE(above, 0x1p-46L) << where() << ": lower bound";
    EXPECT_LE(split, 0x1p-46L) << where() << ": witness points' distance";
    EXPECT_LE(off, 0x1p-46L) << where() << ": witness points";
    EXPECT_LE(contact_off, 0x1p-46L) << where() << ": contact point";
  }
}

std::string nameOfCase(const ::testing::TestParamInfo<Kind>& info) { return nameOf(info.param); }
INSTANTIATE_TEST_SUITE_P(Kinds, NearContact, ::testing::ValuesIn(kKinds), nameOfCase);

}  // namespace
}  // namespace kios::testing
