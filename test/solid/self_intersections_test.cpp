// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fcl_kios/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <boost/rational.hpp>

#include "scalars.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using Rational = boost::rational<long long>;
using Vector = std::array<Rational, 3>;
using Corners = std::array<Vector, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector along(const Vector& a, const Vector& b, Rational t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool isZero(const Vector& v) { return dot(v, v) == 0; }
Vector normalOf(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// 1 in the inside of a triangle, 0 on its border, -1 elsewhere.
int placeOf(const Vector& p, const Corners& t) {
  const Vector n = normalOf(t);
  if (dot(n, p - t[0]) != 0) return -1;
  int place = 1;
  for (int k = 0; k < 3; ++k) {
    const Rational side = dot(n, cross(t[(k + 1) % 3] - t[k], p - t[k]));
    place = std::min(place, side > 0 ? 1 : side == 0 ? 0 : -1);
  }
  return place;
}

/// The corners of what two triangles have in common, and more points of it.
std::set<Vector> commonPoints(const Corners& a, const Corners& b) {
  std::set<Vector> points;
  const auto offer = [&](const Vector& p) {
    if (placeOf(p, a) >= 0 && placeOf(p, b) >= 0) points.insert(p);
  };
  for (const auto& [t, other] : {std::pair(a, b), std::pair(b, a)}) {
    const Vector n = normalOf(other);
    for (int k = 0; k < 3; ++k) {
      const Vector &p = t[k], &q = t[(k + 1) % 3], d = q - p;
      offer(p);
      if (dot(n, d) != 0) offer(along(p, q, dot(n, other[0] - p) / dot(n, d)));
      for (int j = 0; j < 3; ++j) {
        const Vector e = other[(j + 1) % 3] - other[j], w = cross(d, e);
        if (!isZero(w)) offer(along(p, q, dot(cross(other[j] - p, e), w) / dot(w, w)));
      }
    }
  }
  return points;
}

Meeting expectedMeeting(const Corners& a, const Corners& b) {
  if (isZero(normalOf(a)) || isZero(normalOf(b))) return Meeting::kNone;
  std::vector<Vector> shared;
  for (const Vector& p : a) {
    if (std::find(b.begin(), b.end(), p) != b.end()) shared.push_back(p);
  }
  const std::set<Vector> found = commonPoints(a, b);
  const std::vector<Vector> points(found.begin(), found.end());
  const bool all_shared = std::all_of(points.begin(), points.end(), [&](const Vector& p) {
    return (!shared.empty() && p == shared[0]) ||
           (shared.size() == 2 && isZero(cross(p - shared[0], p - shared[1])));
  });
  if (shared.size() < 3 && all_shared) return Meeting::kNone;
  for (const Vector& p : points) {
    if (!isZero(cross(p - points.front(), p - points.back()))) return Meeting::kOverlap;
  }
  const Vector middle = along(points.front(), points.back(), Rational(1, 2));
  const bool within = points.size() > 1 && placeOf(middle, a) == 1 && placeOf(middle, b) == 1;
  return within ? Meeting::kCross : Meeting::kTouch;
}

TriangleVerticesd asDoubles(const Corners& t, double scale) {
  TriangleVerticesd result;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      result[k][static_cast<Eigen::Index>(c)] = scale * boost::rational_cast<double>(t[k][c]);
    }
  }
  return result;
}

TEST(SelfIntersections, EveryPairOfALatticeMeetsAsInRationals) {
  std::mt19937 random(11);
  std::map<std::pair<std::size_t, Meeting>, int> met;
  for (int i = 0; i < 24000; ++i) {
    const long long size = 1 + i % 4;
    std::uniform_int_distribution<long long> coordinate(0, size);
    Corners a, b;
    for (Corners* const t : {&a, &b}) {
      for (Vector& p : *t) {
        for (Rational& x : p) x = coordinate(random);
      }
    }
    for (int k = 0; k < i % 3; ++k) b[static_cast<std::size_t>(k)] = a[static_cast<std::size_t>(k)];
    if (i % 6 >= 3) std::rotate(b.begin(), b.begin() + 1, b.end());
    const Meeting expected = expectedMeeting(a, b);
    const double scale = i % 5 == 0 ? 0x1p-1060 : i % 5 == 1 ? 0x1p900 : 1;
    ASSERT_EQ(meetingOf(asDoubles(a, scale), asDoubles(b, scale)), expected) << i;
    ASSERT_EQ(meetingOf(asDoubles(b, scale), asDoubles(a, scale)), expected) << i;
    ++met[{static_cast<std::size_t>(i % 3), expected}];
  }
  for (const std::size_t shared : {0U, 1U, 2U}) {
    for (const Meeting kind :
         {Meeting::kNone, Meeting::kTouch, Meeting::kCross, Meeting::kOverlap}) {
      const bool can = shared < 2 || kind == Meeting::kNone || kind == Meeting::kOverlap;
      if (!can) continue;
      EXPECT_GT((met[{shared, kind}]), 20) << shared << " " << static_cast<int>(kind);
    }
  }
}

/// Two equal corners are shared with one of the other triangle, so that no third is left to name.
TEST(SelfIntersections, TrianglesWithEqualCornersMeetNone) {
  const Pointd p(0, 0, 0), q(1, 0, 0), r(0, 1, 0), s(0, 0, 1);
  const std::vector<TriangleVerticesd> thin = {{p, p, q}, {q, p, p}, {p, q, p}, {p, p, p}};
  for (const TriangleVerticesd& a : thin) {
    for (const TriangleVerticesd& b : std::vector<TriangleVerticesd>{
             {r, s, p}, {p, r, s}, {r, p, s}, {p, q, r}, {r, p, p}, {p, p, q}}) {
      EXPECT_EQ(meetingOf(a, b), Meeting::kNone);
      EXPECT_EQ(meetingOf(b, a), Meeting::kNone);
    }
  }
}

KIOS_SCALAR_SUITE(SelfIntersectionsOf);

/// A soup that cuts itself a lot, with vertices of a lattice: some far away, some tiny.
TYPED_TEST(SelfIntersectionsOf, AreAllPairsOnceInOrder) {
  using S = TypeParam;
  for (const S scale : {S(1), S(1e-30), S(1e12)}) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coordinate(0, 12), step(0, 3);
    std::vector<fcl::Vector3<S>> vertices;
    std::vector<fcl::Triangle> triangles;
    for (std::size_t t = 0; t < 400; ++t) {
      const fcl::Vector3<S> at(S(coordinate(random)), S(coordinate(random)), S(coordinate(random)));
      for (int k = 0; k < 3; ++k) {
        vertices.push_back(
            scale * (at + fcl::Vector3<S>(S(step(random)), S(step(random)), S(step(random)))));
      }
      triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
    }
    std::vector<std::tuple<int, int, Meeting>> expected, found;
    const auto corners = [&](int t) {
      TriangleVerticesd result;
      for (std::size_t k = 0; k < 3; ++k) {
        result[k] = vertices[3 * static_cast<std::size_t>(t) + k].template cast<double>();
      }
      return result;
    };
    for (int a = 0; a < 400; ++a) {
      for (int b = a + 1; b < 400; ++b) {
        const Meeting meeting = meetingOf(corners(a), corners(b));
        if (meeting != Meeting::kNone) expected.emplace_back(a, b, meeting);
      }
    }
    ASSERT_GT(expected.size(), 100U);
    const auto model = makeModel<S>(vertices, triangles);
    for (const auto& pair : selfIntersections(*model)) {
      found.emplace_back(pair.triangle_a, pair.triangle_b, pair.kind);
    }
    EXPECT_EQ(found, expected) << scale;
    expected.resize(10);
    found.clear();
    for (const auto& pair : selfIntersections(*model, 10)) {
      found.emplace_back(pair.triangle_a, pair.triangle_b, pair.kind);
    }
    EXPECT_EQ(found, expected) << scale;
  }
}

TEST(SelfIntersections, AMeshThatOnlySharesEdgesHasNone) {
  const scenes::Mesh torus = scenes::bumpyTorus(2000);
  EXPECT_TRUE(selfIntersections(*makeModel(torus.vertices, torus.triangles)).empty());
  // A strip whose last row is pushed through the first.
  scenes::Mesh pushed = torus;
  pushed.vertices[0] = fcl::Vector3d::Zero();
  EXPECT_FALSE(selfIntersections(*makeModel(pushed.vertices, pushed.triangles)).empty());
}

TEST(SelfIntersections, UnfinishedModelsAreRefused) {
  const Modeld model;
  EXPECT_THROW(selfIntersections(model), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
