// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "triangle/contract.h"

// The verdict where plain doubles have the sign of a determinant wrong.

namespace kios::testing {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

bool intersects(const TrianglePair& pair) { return trianglesIntersect(pair.a, pair.b); }

void expectExact(const TrianglePair& pair) {
  ASSERT_EQ(intersects(pair), scenes::rationalDistance(pair).intersect) << text(pair);
}

// A vertex moved by single ulps about a plane through (12, 12, 12), (24, 24, 24) and the z axis:
// the grid of Kettner et al., "Classroom examples of robustness problems in geometric
// computations", 2008, on which the naive determinant is wrong in a third of the points.
TEST(Predicates, GridOfUlps) {
  const double step = 0x1p-53;
  const Corners wall = {Eigen::Vector3d(12, 12, -40), {12, 12, 60}, {24, 24, 5}};
  for (int i = 0; i < 48; ++i) {
    for (int j = 0; j < 48; ++j) {
      const Eigen::Vector3d p(0.5 + i * step, 0.5 + j * step, 0.5);
      expectExact({wall, {p, Eigen::Vector3d(30, 30 + 64 * step * (i % 3), 1), {30, 41, 2}}});
      expectExact({{Eigen::Vector3d(0, 0, 0), {12, 12, 60}, {24, 24, 5}}, {p, p, p}});
      if (HasFatalFailure()) return;
    }
  }
}

// One coordinate of a contact moved by a few ulps, for every coordinate.
TEST(Predicates, UlpsAboutContacts) {
  const std::vector<TrianglePair> contacts = {
      {{{{0.1, 0.1, 0.1}, {0.7, 0.1, 0.1}, {0.1, 0.7, 0.1}}},
       {{{0.3, 0.3, 0.1}, {0.3, 0.4, 0.9}, {0.5, 0.3, 0.9}}}},
      {{{{0.1, 0.2, 0.3}, {0.3, 0.6, 0.9}, {0.5, 0.1, 0.1}}},
       {{{0.2, 0.4, 0.6}, {0.2, 0.9, 0.6}, {0.1, 0.9, 0.9}}}},
      {{{{1, 1, 1}, {3, 3, 3}, {0, 0, 9}}}, {{{2, 2, 2}, {4, 4, 4}, {9, 0, 0}}}},
  };
  for (const TrianglePair& contact : contacts) {
    expectExact(contact);
    for (int vertex = 0; vertex < 6; ++vertex) {
      for (int c = 0; c < 3; ++c) {
        for (const double towards : {-1e9, 1e9}) {
          TrianglePair moved = contact;
          double& v = vertex < 3 ? moved.a[vertex][c] : moved.b[vertex - 3][c];
          for (int ulps = 0; ulps < 3; ++ulps) {
            v = std::nextafter(v, towards);
            expectExact(moved);
            if (HasFatalFailure()) return;
          }
        }
      }
    }
  }
}

// Products of these coordinates under- and overflow doubles, with or without scaling.
TEST(Predicates, ExtremeExponents) {
  for (const double tiny : {0x1p-1074, 0x1p-1022, 0x1p-700, 0x1p-300}) {
    for (const double huge : {1.0, 0x1p300, 0x1p700, 0x1p990}) {
      const Corners face = {Eigen::Vector3d(-huge, -huge, 0), {huge, -huge, 0}, {0, huge, 0}};
      const Corners above = {Eigen::Vector3d(0, 0, tiny), {huge, 0, huge}, {0, huge, huge}};
      const Corners touching = {Eigen::Vector3d(tiny, tiny, 0), {huge, 0, huge}, {0, huge, huge}};
      const Corners through = {Eigen::Vector3d(0, 0, -tiny), {tiny, 0, tiny}, {0, tiny, tiny}};
      EXPECT_FALSE(intersects({face, above})) << tiny << " " << huge;
      EXPECT_TRUE(intersects({face, touching})) << tiny << " " << huge;
      EXPECT_TRUE(intersects({face, through})) << tiny << " " << huge;
      // Beside the edge y = -huge: equal but for the part that a sum with huge would lose.
      const Corners beside = {
          Eigen::Vector3d(0, -huge, tiny), {tiny, -huge, 2 * tiny}, {0, -huge, 3 * tiny}};
      EXPECT_FALSE(intersects({face, beside})) << tiny << " " << huge;
    }
  }
}

// Four clustered vertices of six: a determinant far below the filter's bound, yet not 0.
TEST(Predicates, ClusterBelowTheFilter) {
  for (const double t : {0x1p-266, 0x1p-268, 0x1p-269, 0x1p-270, 0x1p-271}) {
    const Corners cluster = {Eigen::Vector3d(t, t, 2 * t), {3 * t, t, 4 * t}, {t, 3 * t, t}};
    const Corners above = {
        Eigen::Vector3d(1.5 * t, 1.5 * t, 3 * t), {t, t, 1 + t}, {2 * t, t, 1 + 2 * t}};
    EXPECT_FALSE(intersects({cluster, above})) << t;
  }
}

}  // namespace
}  // namespace kios::testing
