// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Ways out that people see: past a contact's own faces and edges, or several at once, of solids
// whose depth is known; in both orders of the pair.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "solid/known_depths.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

/// Brackets hold and are at most `most` times as long as the depth; the order changes last bits.
void expectDepth(const Mesh& a, const Mesh& b, const fcl::Transform3d& X, double depth, double most,
                 int number) {
  const auto solid_a = solidOf(a), solid_b = solidOf(b);
  const PenetrationResult p = penetration(*solid_a, X, *solid_b, X),
                          q = penetration(*solid_b, X, *solid_a, X);
  const double rounding = 1e-11;
  for (const PenetrationResult& found : {p, q}) {
    EXPECT_LE(found.lower, depth + rounding) << number;
    EXPECT_GE(found.upper, depth - rounding) << number;
    EXPECT_LE(found.upper, most * depth + rounding) << number << ", depth " << depth;
  }
  EXPECT_NEAR(p.upper, q.upper, 1e-6 * p.upper + rounding) << number;
  EXPECT_LT((p.translation + q.translation).norm(), 1e-6 * p.upper + rounding) << number;
  if (q.upper == 0) return;
  fcl::Transform3d moved = X;
  moved.translation() += q.translation;
  fcl::CollisionResultd result;
  EXPECT_EQ(fcl::collide(solid_b.get(), X, solid_a.get(), moved, fcl::CollisionRequestd(), result),
            0U);
}

Outline polygon(int sides, double radius, double turn, const Eigen::Vector2d& center) {
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = turn + 2 * EIGEN_PI * i / sides;
    outline.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

void quad(Mesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.emplace_back(a, b, c);
  mesh.triangles.emplace_back(a, c, d);
}

Mesh pin(const Outline& outline, double length) {
  Mesh mesh;
  const int n = static_cast<int>(outline.size());
  for (const double z : {-length, length}) {
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], p[1], z);
  }
  for (int i = 0; i < n; ++i) quad(mesh, i, (i + 1) % n, n + (i + 1) % n, n + i);
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(n, n + i, n + i + 1);
  }
  return mesh;
}

/// Returns a box; its faces' diagonals begin at the first corner of each.
Mesh boxFrom(const fcl::Vector3d& low, const fcl::Vector3d& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1],
                               (i & 4) != 0 ? high[2] : low[2]);
  }
  quad(mesh, 0, 2, 3, 1);
  quad(mesh, 4, 5, 7, 6);
  quad(mesh, 0, 1, 5, 4);
  quad(mesh, 2, 6, 7, 3);
  quad(mesh, 0, 4, 6, 2);
  quad(mesh, 1, 3, 7, 5);
  return mesh;
}

/// Returns a plate about a hole, three times as wide, of thickness 1.
Mesh socket(const Outline& hole) {
  Mesh mesh;
  const int n = static_cast<int>(hole.size());
  for (const double z : {-0.5, 0.5}) {
    for (const double wide : {3.0, 1.0}) {
      for (const auto& p : hole) mesh.vertices.emplace_back(wide * p[0], wide * p[1], z);
    }
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    quad(mesh, i, n + i, n + j, j);
    quad(mesh, 2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i);
    quad(mesh, i, j, 2 * n + j, 2 * n + i);
    quad(mesh, n + i, 3 * n + i, 3 * n + j, n + j);
  }
  return mesh;
}

/// Returns the length of the least shift that takes a convex outline into another, which one side
/// or two limit.
double shiftInto(const Outline& hole, const Outline& inner) {
  std::vector<Eigen::Vector2d> normals;
  std::vector<double> limits;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Eigen::Vector2d e = hole[(i + 1) % hole.size()] - hole[i];
    const Eigen::Vector2d n = Eigen::Vector2d(e[1], -e[0]).normalized();
    double reach = -1e9;
    for (const auto& p : inner) reach = std::max(reach, n.dot(p));
    normals.push_back(n);
    limits.push_back(n.dot(hole[i]) - reach);
  }
  double least = 1e9;
  const auto consider = [&](const Eigen::Vector2d& t) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (normals[i].dot(t) > limits[i] + 1e-12) return;
    }
    least = std::min(least, t.norm());
  };
  consider(Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    consider(limits[i] * normals[i]);
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Matrix2d both;
      both << normals[i].transpose(), normals[j].transpose();
      if (std::abs(both.determinant()) < 1e-9) continue;
      consider(both.inverse() * Eigen::Vector2d(limits[i], limits[j]));
    }
  }
  return least;
}

TEST(Exits, PinsLeaveWallsOfTheirHoles) {
  Random random(21);
  for (int i = 0; i < casesOr(150); ++i) {
    const double clearance = std::pow(10, random.uniform(-2.7, -0.7));
    const auto sides = [&] { return 8 + static_cast<int>(random.uniform(0, 41)); };
    const int n = sides();
    const Outline hole = polygon(n, 1, random.uniform(0, 1), {0, 0});
    const double angle = random.uniform(0, 6), radius = std::cos(EIGEN_PI / n) - clearance / 2;
    const Outline outline = polygon(
        i % 2 ? n : sides(), radius, random.uniform(0, 1),
        clearance * random.uniform(0.51, 0.99) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    const double depth = shiftInto(hole, outline);
    if (depth < 1e-6 || depth > 1) continue;
    const auto X = i % 3 ? wholePose(random, 1) : kHere;
    expectDepth(socket(hole), pin(outline, 3), X, depth, 1.5, i);
  }
}

// Tables, frames and combs over a grid; those of one solid are thinner, so that they fit.
TEST(Exits, BarsLeaveSeveralWallsAtOnce) {
  Random random(22);
  int overlapping = 0;
  for (int i = 0; i < casesOr(150); ++i) {
    const auto bars = [&](double thinner, const fcl::Vector3d& shift) {
      Boxes boxes;
      for (int k = 2 + static_cast<int>(random.uniform(0, 4)); k > 0; --k) {
        fcl::Vector3d low, high;
        for (int c = 0; c < 3; ++c) {
          low[c] = std::floor(random.uniform(0, 5)) + shift[c] + thinner;
          high[c] = low[c] + 1 + std::floor(random.uniform(0, c == k % 3 ? 5 : 1.5)) - 2 * thinner;
        }
        boxes.emplace_back(low, high);
      }
      return boxes;
    };
    fcl::Vector3d shift;
    for (int c = 0; c < 3; ++c) {
      shift[c] = std::floor(random.uniform(-5, 5)) + random.uniform(-0.05, 0.05);
    }
    const Boxes a = bars(0, fcl::Vector3d::Zero()), b = bars(0.03, shift);
    const double depth = depthOfUnions(a, b);
    if (depth < 1e-6) continue;
    ++overlapping;
    expectDepth(meshOf(a), meshOf(b), i % 2 ? wholePose(random, 1) : kHere, depth, 1.5, i);
  }
  EXPECT_GT(overlapping, casesOr(150) / 10);
}

// Turned in their own coordinates, which are doubles or floats; half of them share a corner too.
TEST(Exits, WallsThatShareAFaceHaveADepthOfRounding) {
  Random random(23);
  for (int i = 0; i < casesOr(600); ++i) {
    const auto size = [&] { return std::pow(10, random.uniform(-1.3, 0.7)); };
    const fcl::Vector3d a(size(), size(), size()), b(size(), size(), size());
    fcl::Vector3d low(a[0], 0, 0);
    if (i % 2 == 0) low += 0.9 * fcl::Vector3d(0, a[1] * random.unit(), a[2] * random.unit());
    const bool in_float = i % 4 != 0;
    const auto X = wholePose(random, 10);
    const auto placed = [&](const fcl::Vector3d& from, const fcl::Vector3d& sides) {
      Mesh mesh = boxFrom(from, from + sides);
      for (fcl::Vector3d& p : mesh.vertices) {
        p = X * p;
        if (in_float) p = p.cast<float>().cast<double>().eval();
      }
      return solidOf(mesh);
    };
    const auto solid_a = placed(fcl::Vector3d::Zero(), a), solid_b = placed(low, b);
    const double most = in_float ? 2e-5 : 1e-10;
    EXPECT_LE(penetration(*solid_a, kHere, *solid_b, kHere).upper, most) << i;
    EXPECT_LE(penetration(*solid_b, kHere, *solid_a, kHere).upper, most) << i;
  }
}

// Boxes of whole coordinates on either side of x = 0 share parts of faces and edges.
TEST(Exits, APlanePartsSolidsInBothOrders) {
  Random random(24);
  for (int i = 0; i < casesOr(300); ++i) {
    const auto whole = [&](double low, double high) {
      return std::floor(random.uniform(low, high));
    };
    const auto boxes = [&](double side) {
      std::vector<Mesh> result;
      for (int k = 0; k < 2; ++k) {
        const fcl::Vector3d low(k * whole(0, 2), whole(-2, 2), whole(-2, 2));
        const fcl::Vector3d high = low + fcl::Vector3d(whole(1, 4), whole(1, 4), whole(1, 4));
        const fcl::Vector3d mirror(side, 1, 1);
        result.push_back(boxFrom(low.cwiseProduct(mirror).cwiseMin(high.cwiseProduct(mirror)),
                                 low.cwiseProduct(mirror).cwiseMax(high.cwiseProduct(mirror))));
      }
      return scenes::merged(result);
    };
    expectDepth(boxes(1), boxes(-1), kHere, 0, 1, i);
  }
}

}  // namespace
}  // namespace kios::testing
