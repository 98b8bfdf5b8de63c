// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons of faces become triangles that cover them once.
#include <algorithm>
#include <set>

#include "files/sample.h"

namespace kios::testing {
namespace {

using Corner = Eigen::Vector2d;
using scenes::Random;

double areaWithin(const std::vector<Corner>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

int below(Random& random, int n) { return static_cast<int>(random.unit() * n); }

/// A polygon that doesn't cross itself, on a grid: a comb with teeth of any height, a spiral, a
/// star, or a triangle; corners on its edges are then put in.
std::vector<Corner> drawn(Random& random) {
  std::vector<Corner> result;
  switch (below(random, 4)) {
    case 0: {
      const int teeth = 1 + below(random, 8);
      for (int i = 0; i < teeth; ++i) {
        result.emplace_back(2 * i, -1 - below(random, 9));
        result.emplace_back(2 * i + 1, -1 - below(random, 9));
        if (random.unit() < 0.7) result.emplace_back(2 * i + 1, 0);
        if (random.unit() < 0.7) result.emplace_back(2 * i + 2, 0);
      }
      result.emplace_back(2 * teeth, 2);
      result.emplace_back(0, 2);
      break;
    }
    case 1: {
      const int turns = 4 + below(random, 12);
      std::vector<Corner> inner;
      for (int i = 0; i < turns; ++i) {
        const Corner side[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        const Corner out = side[i % 4] + side[(i + 3) % 4];
        result.push_back((i + 3.0) * out);
        inner.push_back((i + 2.0) * out);
      }
      result.insert(result.end(), inner.rbegin(), inner.rend());
      break;
    }
    case 2: {
      const int n = 3 + below(random, 20);
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n, r = 16 + below(random, 1000);
        result.emplace_back(r * std::cos(angle), r * std::sin(angle));
      }
      break;
    }
    default:
      result = {{0, 0}, {12, 0}, {0, 12}};
  }
  std::vector<Corner> with_middles;
  for (std::size_t i = 0; i < result.size(); ++i) {
    with_middles.push_back(result[i]);
    if (random.unit() < 0.3)
      with_middles.push_back((result[i] + result[(i + 1) % result.size()]) / 2);
  }
  return with_middles;
}

TEST(Polygons, TrianglesCoverThemOnce) {
  Random random(1);
  for (int round = 0; round < 1500; ++round) {
    std::vector<Corner> polygon = drawn(random);
    std::rotate(polygon.begin(), polygon.begin() + below(random, static_cast<int>(polygon.size())),
                polygon.end());
    const double area = areaWithin(polygon);
    ASSERT_GT(area, 0);
    // Exactly in a plane of the axes, far away, or anywhere; wound either way.
    fcl::Transform3d X = fcl::Transform3d::Identity();
    if (random.unit() < 0.5) X.translation() = fcl::Vector3d(448262, 4582940, 12);
    if (random.unit() < 0.5) {
      X.linear() = fcl::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1),
                                    random.uniform(-1, 1), random.uniform(-1, 1))
                       .normalized()
                       .toRotationMatrix();
    }
    const bool reversed = random.unit() < 0.5;
    if (reversed) std::reverse(polygon.begin(), polygon.end());
    std::string text, face = "f";
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const fcl::Vector3d p = X * fcl::Vector3d(polygon[i].x(), polygon[i].y(), 0);
      char line[120];
      std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
      text += line;
      face += " " + std::to_string(i + 1);
    }
    SCOPED_TRACE(text + face);
    const files::Mesh mesh = readContent("a.obj", text + face + "\n");
    ASSERT_EQ(mesh.triangles.size(), polygon.size() - 2);
    EXPECT_NEAR(areaOf(mesh), area, 1e-6 * area);
    EXPECT_TRUE(mesh.warnings.empty());
    const fcl::Vector3d normal = X.linear().col(2) * (reversed ? -1 : 1);
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (const fcl::Triangle& t : mesh.triangles) {
      const fcl::Vector3d& a = mesh.vertices[t[0]];
      EXPECT_GT((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).dot(normal), -1e-6);
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(edges.insert({t[c], t[(c + 1) % 3]}).second);
      }
    }
    // Its own edges are there, so that neighbours meet it without a gap.
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      EXPECT_EQ(edges.count({i, (i + 1) % polygon.size()}), 1u);
    }
  }
}

TEST(Polygons, ConvexOnesAreFansOfTheirFirstCorner) {
  const files::Mesh mesh =
      readContent("a.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 2 3 4 5 1\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (const fcl::Triangle& t : mesh.triangles) EXPECT_EQ(t[0], 1u);
}

TEST(Polygons, SlitsLeadToHoles) {
  // A square of 6 with a hole of 2, whose border is reached along a slit there and back.
  const files::Mesh mesh =
      readContent("a.off",
                  "OFF\n8 1 0\n0 0 0\n6 0 0\n6 6 0\n0 6 0\n2 2 0\n4 2 0\n4 4 0\n2 4 0\n"
                  "10 0 1 2 3 0 4 7 6 5 4\n");
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_NEAR(areaOf(mesh), 32, 1e-12);
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Polygons, CrossingsAreSaid) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\n";
  EXPECT_TRUE(warnsOf(readContent("a.obj", square + "f 1 2 3 4\nf 1 3 2 4\n"),
                      ":8: face 1 crosses itself or has no area"));
  EXPECT_TRUE(warnsOf(readContent("a.obj", square + "f 1 2 5 6\nf 1 2 3\n"), "no area"));
  // A corner that is named twice is one.
  EXPECT_EQ(readContent("a.obj", square + "f 1 1 2 2 3 4 1\n").triangles.size(), 2u);
  EXPECT_EQ(readContent("a.obj", square + "f 1 2 1 2 1\nf 1 2 3\nf 4 4 4 4\n").other_faces, 1u);
}

TEST(Polygons, LargeOnesTakeLittleTime) {
  std::string comb, circle, face = "f";
  constexpr int kCorners = 20000;
  for (int i = 0; i < kCorners; ++i) {
    comb += "v " + std::to_string(i) + " " + std::to_string(i % 2 == 0 ? 5 + i % 7 : 0) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  comb += "v 20000 20 0\nv -1 20 0\n" + face + " 20001 20002\n";
  EXPECT_EQ(readContent("a.obj", comb).triangles.size(), std::size_t{kCorners});
  std::string more, large = "f";
  for (int i = 0; i < 40000; ++i) {
    more += "v " + std::to_string(i) + " " + std::to_string(i % 2 * 5) + " 0\n";
    large += " " + std::to_string(i + 1);
  }
  expectUnread("a.obj", more + "v 40000 -9 0\n" + large + " 40001\n", ":40002: a polygon of 40001");
}

}  // namespace
}  // namespace kios::testing
