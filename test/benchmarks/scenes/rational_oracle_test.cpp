// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenes/rational_oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "scenes/triangle_classes.h"

namespace kios::scenes {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using RationalVector = std::array<Rational, 3>;
using Corners = std::array<Eigen::Vector3d, 3>;

RationalVector exact(const Eigen::Vector3d& p) {
  return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
}

Rational dot(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalVector difference(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// Solution of M x = r by elimination, or nothing if M is singular.
std::optional<std::vector<Rational>> solved(std::vector<std::vector<Rational>> m,
                                            std::vector<Rational> r) {
  const std::size_t n = r.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    while (pivot < n && m[pivot][i] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(m[pivot], m[i]);
    std::swap(r[pivot], r[i]);
    for (std::size_t row = 0; row < n; ++row) {
      if (row == i) continue;
      const Rational f = m[row][i] / m[i][i];
      for (std::size_t c = i; c < n; ++c) m[row][c] -= f * m[i][c];
      r[row] -= f * r[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i) r[i] /= m[i][i];
  return r;
}

// The convex quadratic program min |a(s) - b(t)|^2 by enumeration of its active sets: for every
// pair of a vertex, edge or face of each, the stationary point of the free barycentric coordinates.
// Sets with a singular system are skipped: along its null space the minimum reaches a smaller set.
Rational squaredDistanceByActiveSets(const TrianglePair& pair) {
  const std::vector<std::vector<int>> features = {{0}, {1}, {2}, {0, 1}, {1, 2}, {2, 0}, {0, 1, 2}};
  std::optional<Rational> best;
  for (const auto& of_a : features) {
    for (const auto& of_b : features) {
      const RationalVector origin = difference(exact(pair.b[of_b[0]]), exact(pair.a[of_a[0]]));
      std::vector<RationalVector> columns;  // the difference is origin + sum x_i columns_i
      for (std::size_t i = 1; i < of_a.size(); ++i) {
        columns.push_back(difference(exact(pair.a[of_a[0]]), exact(pair.a[of_a[i]])));
      }
      for (std::size_t i = 1; i < of_b.size(); ++i) {
        columns.push_back(difference(exact(pair.b[of_b[i]]), exact(pair.b[of_b[0]])));
      }
      std::vector<std::vector<Rational>> m;
      std::vector<Rational> r;
      for (const RationalVector& row : columns) {
        m.emplace_back();
        for (const RationalVector& column : columns) m.back().push_back(dot(row, column));
        r.push_back(-dot(row, origin));
      }
      const auto x = solved(m, r);
      if (!x) continue;
      RationalVector residual = origin;
      Rational sum_a = 0, sum_b = 0;
      bool feasible = true;
      for (std::size_t i = 0; i < x->size(); ++i) {
        feasible &= (*x)[i] >= 0;
        (i + 1 < of_a.size() ? sum_a : sum_b) += (*x)[i];
        for (int c = 0; c < 3; ++c) residual[c] += (*x)[i] * columns[i][c];
      }
      if (!feasible || sum_a > 1 || sum_b > 1) continue;
      const Rational squared = dot(residual, residual);
      if (!best || squared < *best) best = squared;
    }
  }
  return *best;
}

void expectAgrees(const TrianglePair& pair, const char* name) {
  const RationalDistance answer = rationalDistance(pair);
  const Rational squared = squaredDistanceByActiveSets(pair);
  ASSERT_EQ(answer.intersect, squared == 0) << name;
  ASSERT_EQ(answer.intersect, answer.distance == 0) << name;
  if (answer.distance < 1e-280L) return;  // no sum of two doubles
  const auto high = static_cast<double>(answer.distance);
  const auto low = static_cast<double>(answer.distance - static_cast<long double>(high));
  const Rational distance = Rational(high) + Rational(low);
  const Rational error = distance * distance - squared;
  ASSERT_LE(boost::multiprecision::abs(error), squared * Rational(0x1p-62)) << name;
}

bool moderate(const TrianglePair& pair) {
  return extent(pair) > 1e-100L && extent(pair) < 1e100L && magnitude(pair) < 1e100;
}

TEST(RationalOracle, AgreesWithActiveSets) {
  constexpr std::size_t kPairs = 12;
  for (std::size_t c = 0; c < triangleClasses().size(); ++c) {
    for (const TrianglePair& pair : trianglePairs(c, kPairs, 11)) {
      if (!moderate(pair)) continue;
      expectAgrees(pair, triangleClasses()[c].name);
      if (HasFatalFailure()) return;
    }
  }
}

// All pairs of segments of a 3 x 3 grid beside one fixed triangle, and thousands of tiny lattices:
// every degenerate configuration occurs.
TEST(RationalOracle, AgreesWithActiveSetsOnTinyLattices) {
  Random random(5);
  for (int i = 0; i < 1500; ++i) {
    TrianglePair pair;
    for (Corners* corners : {&pair.a, &pair.b}) {
      for (Eigen::Vector3d& p : *corners) {
        for (int c = 0; c < 3; ++c) p[c] = std::floor(random.uniform(0, 2.5));
      }
    }
    expectAgrees(pair, "tiny lattice");
    if (HasFatalFailure()) return;
  }
}

const Corners kFloorCorners = {Eigen::Vector3d(0, 0, 0), {4, 0, 0}, {0, 4, 0}};

TEST(RationalOracle, KnownDistances) {
  const auto expectDistance = [](const Corners& b, long double distance) {
    EXPECT_EQ(rationalDistance({kFloorCorners, b}).distance, distance);
    EXPECT_EQ(rationalDistance({b, kFloorCorners}).distance, distance);
    EXPECT_EQ(rationalDistance({kFloorCorners, b}).intersect, distance == 0);
  };
  expectDistance({{{1, 1, 2}, {1, 2, 5}, {2, 1, 5}}}, 2);         // vertex over face
  expectDistance({{{-3, -4, 0}, {-5, -9, 1}, {-5, -9, -1}}}, 5);  // vertex to vertex
  expectDistance({{{2, -1, -1}, {2, -1, 1}, {2, -4, 0}}}, 1);     // edge to edge
  expectDistance({{{1, 1, 3}, {2, 1, 3}, {1, 2, 3}}}, 3);         // parallel faces
  expectDistance({{{4, 4, 0}, {5, 5, 1}, {5, 5, -1}}}, std::sqrt(8.0L));
  expectDistance({{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}, 0);  // edge through face
  expectDistance({{{2, 2, 0}, {3, 3, 1}, {3, 3, -1}}}, 0);  // vertex on edge
  expectDistance({{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}, 0);   // nested
  expectDistance({{{4, 0, 0}, {5, 0, 1}, {5, 1, 0}}}, 0);   // shared vertex
  expectDistance({{{1, 1, 2}, {1, 1, 2}, {1, 1, 2}}}, 2);   // point
  expectDistance({{{1, 1, -2}, {1, 1, 5}, {1, 1, 3}}}, 0);  // segment
}

TEST(RationalOracle, AllScales) {
  for (const double unit : {0x1p-1074, 0x1p-1000, 0x1p-500, 1.0, 0x1p500, 0x1p1000}) {
    TrianglePair pair = {kFloorCorners, {{{1, 1, 2}, {1, 2, 5}, {2, 1, 5}}}};
    for (Corners* corners : {&pair.a, &pair.b}) {
      for (Eigen::Vector3d& p : *corners) p *= unit;
    }
    EXPECT_EQ(rationalDistance(pair).distance, 2 * static_cast<long double>(unit));
    EXPECT_EQ(rationalDistance(pair.b[0], pair.a), 2 * static_cast<long double>(unit));
  }
  // A gap of the least double over a face of size 1.
  const double least = 0x1p-1074;
  const Corners above = {{{1, 1, least}, {1, 2, 1}, {2, 1, 1}}};
  EXPECT_EQ(rationalDistance({kFloorCorners, above}).distance, least);
  EXPECT_FALSE(rationalDistance({kFloorCorners, above}).intersect);
}

}  // namespace
}  // namespace kios::scenes
