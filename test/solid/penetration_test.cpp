// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solids.h"

#include <gtest/gtest.h>

#include "scenes/oracle.h"
#include "solid/known_depths.h"
#include "solid/solid_meshes.h"

namespace kios {
namespace {

using scenes::Mesh;
using scenes::Random;
using testing::at;
using testing::solidOf;

/// What must hold of any bracket: it is one, the translation is as long as it says, and after it
/// nothing touches and no component of one is in the other, by queries that share nothing with the
/// search. Returns upper / lower.
double expectSound(const PenetrationResult& p, const Mesh& mesh_a, const fcl::Transform3d& X_WA,
                   const Mesh& mesh_b, const fcl::Transform3d& X_WB) {
  EXPECT_GE(p.lower, 0);
  EXPECT_LE(p.lower, p.upper);
  EXPECT_DOUBLE_EQ(p.translation.norm(), p.upper);
  fcl::Transform3d moved = X_WB;
  moved.translation() += p.translation;
  const scenes::MeshOracle oracle(mesh_a, mesh_b);
  EXPECT_FALSE(oracle.collide(X_WA, moved));
  const auto a = solidOf(mesh_a), b = solidOf(mesh_b);
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  EXPECT_EQ(fcl::collide(a.get(), X_WA, b.get(), moved, request, result), 0u);
  for (const fcl::Vector3d& v : mesh_b.vertices)
    EXPECT_FALSE(contains<double>(*a, X_WA, moved * v));
  for (const fcl::Vector3d& v : mesh_a.vertices)
    EXPECT_FALSE(contains<double>(*b, moved, X_WA * v));
  return p.lower > 0 ? p.upper / p.lower : std::numeric_limits<double>::infinity();
}

struct Case {
  Mesh a, b;
  fcl::Transform3d X_WA, X_WB;
};

/// Returns upper / lower, 1 where they are apart.
double expectDepth(const Case& c, double depth, const char* what, int number) {
  const auto a = solidOf(c.a), b = solidOf(c.b);
  const PenetrationResult p = penetration<double>(*a, c.X_WA, *b, c.X_WB);
  const double rounding = 1e-11 * (1 + c.X_WA.translation().norm() + c.X_WB.translation().norm());
  EXPECT_LE(p.lower, depth + rounding) << what << " " << number;
  EXPECT_GE(p.upper, depth - rounding) << what << " " << number;
  if (p.upper == 0) {
    EXPECT_LE(depth, rounding) << what << " " << number;
    return 1;
  }
  return expectSound(p, c.a, c.X_WA, c.b, c.X_WB);
}

Mesh smallHull(Random& random) {
  // An icosphere, stretched and turned: convex, and no two faces alike.
  Mesh mesh = scenes::icosphere(1, random.unit() < 0.2 ? 1 : 0);
  const fcl::Transform3d X = testing::wholePose(random, 0.1);
  fcl::Vector3d stretch;
  for (int c = 0; c < 3; ++c) stretch[c] = random.uniform(0.2, 1.5);
  for (fcl::Vector3d& p : mesh.vertices) p = X * stretch.cwiseProduct(p);
  return mesh;
}

// KIOS_SOLID_CASES=10000 asks for so many pairs of each kind.
TEST(Penetration, BoxesAreBracketedToFivePercent) {
  Random random(11);
  const int cases = testing::casesOr(500);
  int overlapping = 0;
  for (int i = 0; i < cases; ++i) {
    const auto box = [&] {
      fcl::Vector3d size;
      for (int c = 0; c < 3; ++c) size[c] = random.uniform(0.1, 2);
      return scenes::subdividedBox(size, 1 + i % 3);
    };
    const Case c = {box(), box(), testing::wholePose(random, 0.6), testing::wholePose(random, 0.6)};
    const double depth = testing::convexDepth(c.a, c.X_WA, c.b, c.X_WB);
    overlapping += depth > 0;
    EXPECT_LE(expectDepth(c, depth, "boxes", i), 1.05) << i << " of depth " << depth;
  }
  EXPECT_GT(overlapping, cases / 3);
}

TEST(Penetration, ConvexPairsAreBracketedToFivePercent) {
  Random random(12);
  const int cases = testing::casesOr(300);
  int overlapping = 0;
  for (int i = 0; i < cases; ++i) {
    Case c = {smallHull(random), smallHull(random), testing::wholePose(random, 0.8),
              testing::wholePose(random, 0.8)};
    if (i % 5 == 0) c.X_WA.translation() = c.X_WB.translation();
    if (i % 10 == 1) c.b = testing::transformed(c.b, 1e-3, {0, 0, 0});
    const double depth = testing::convexDepth(c.a, c.X_WA, c.b, c.X_WB);
    overlapping += depth > 0;
    EXPECT_LE(expectDepth(c, depth, "convex", i), 1.05) << i << " of depth " << depth;
  }
  EXPECT_GT(overlapping, cases / 3);
}

TEST(Penetration, ABallInAShellsWallLeavesByTheNearerSide) {
  const Mesh wall = testing::shell(2, 1, 4);
  const Mesh ball = scenes::icosphere(0.1, 2);
  const auto a = solidOf(wall), b = solidOf(ball);
  Random random(15);
  constexpr double kFacets = 0.02;
  for (int i = 0; i < 60; ++i) {
    const double from_center = random.uniform(0.95, 2.05);
    fcl::Transform3d X = testing::wholePose(random, 1);
    X.translation() = from_center * testing::inCube(random).normalized();
    const double depth = std::min(2 - from_center + 0.1, from_center - 1 + 0.1);
    const PenetrationResult p = penetration<double>(*a, fcl::Transform3d::Identity(), *b, X);
    EXPECT_LE(p.lower, depth + kFacets);
    EXPECT_GE(p.upper, depth - kFacets);
    EXPECT_LE(expectSound(p, wall, fcl::Transform3d::Identity(), ball, X), 1.6) << i;
  }
}

// FCL's own measure is the depth of a vertex or a triangle, and falls with finer meshes.
TEST(Penetration, RefinementChangesNothing) {
  for (const int n : {1, 4, 16}) {
    const auto a = solidOf(scenes::subdividedBox({2, 2, 2}, n));
    const auto b = solidOf(scenes::subdividedBox({2, 2, 2}, n));
    const PenetrationResult p = penetration<double>(*a, at(0, 0, 0), *b, at(1.75, 0.1, 0.2));
    EXPECT_NEAR(p.lower, 0.25, 1e-10);
    EXPECT_NEAR(p.upper, 0.25, 1e-10);
    EXPECT_NEAR(p.translation[0], 0.25, 1e-10);
    EXPECT_NEAR(p.point[0], 1, 1e-12);
  }
}

TEST(Penetration, SolidsThatTouchOrAreApartHaveNone) {
  const auto box = solidOf(scenes::subdividedBox({2, 2, 2}, 2));
  const auto expectNone = [&](const Modeld& b, const fcl::Transform3d& X) {
    const PenetrationResult p = penetration<double>(*box, at(0, 0, 0), b, X);
    EXPECT_EQ(p.lower, 0);
    EXPECT_EQ(p.upper, 0);
    EXPECT_TRUE(p.translation.isZero(0));
  };
  expectNone(*box, at(3, 0, 0));
  expectNone(*box, at(2, 0, 0));        // faces
  expectNone(*box, at(2, 2, 0.5));      // edges
  expectNone(*box, at(2, 2, 2));        // corners
  expectNone(*box, at(-2, 0.25, 0.5));  // faces, shifted
  // From within: a box that fills a cavity.
  const auto cavity =
      solidOf(scenes::merged({scenes::subdividedBox({4, 4, 4}, 2),
                              testing::flipped(scenes::subdividedBox({2, 2, 2}, 2))}));
  expectNone(*solidOf(scenes::subdividedBox({1, 1, 1}, 1)), at(1.5, 0, 0));
  const PenetrationResult p = penetration<double>(*cavity, at(0, 0, 0), *box, at(0, 0, 0));
  EXPECT_EQ(p.lower, 0);  // it touches all round, and can leave only as a whole
}

TEST(Penetration, BracketsHoldAtAllScalesAndFarAway) {
  Random random(16);
  for (const double scale : {1e-9, 1e-3, 1.0, 1e9}) {
    const Mesh a = testing::transformed(scenes::bumpyBlob(), scale, {0, 0, 0});
    const Mesh box = testing::transformed(scenes::subdividedBox({1, 1, 1}, 3), scale, {0, 0, 0});
    const auto solid_a = solidOf(a), solid_box = solidOf(box);
    for (int i = 0; i < 5; ++i) {
      const fcl::Transform3d X = at(0.3 * scale * i, 0.1 * scale, 0);
      const PenetrationResult p = penetration<double>(*solid_a, at(0, 0, 0), *solid_box, X);
      if (p.upper == 0) continue;
      EXPECT_LT(expectSound(p, a, at(0, 0, 0), box, X), 2);
      const PenetrationResult q = penetration<double>(*solid_box, at(0, 0, 0), *solid_box, X);
      if (q.upper > 0) {
        EXPECT_NEAR(q.lower, scale * std::min(0.9, 1 - 0.3 * i), 0.05 * scale);
        EXPECT_LE(q.upper, 1.05 * q.lower);
      }
    }
  }
  const auto box = solidOf(scenes::subdividedBox({1, 1, 1}, 3));
  const PenetrationResult p =
      penetration<double>(*box, at(1e9, -1e9, 1e9), *box, at(1e9 + 0.75, -1e9, 1e9));
  EXPECT_NEAR(p.lower, 0.25, 1e-3);
  EXPECT_NEAR(p.upper, 0.25, 1e-3);
}

// The poses are rounded by as much as the way that a gap alone would prove.
TEST(Penetration, OddShapesAreBracketedFarAway) {
  Random random(17);
  const Mesh blob = scenes::bumpyBlob(), torus = scenes::bumpyTorus(400);
  const auto a = solidOf(blob), b = solidOf(torus);
  for (const double far : {0.0, 1e6, 1e12}) {
    for (int i = 0; i < 8; ++i) {
      fcl::Transform3d X_WA = testing::wholePose(random, 0.3),
                       X_WB = testing::wholePose(random, 0.7);
      X_WA.translation().array() += far;
      X_WB.translation().array() += far;
      const PenetrationResult p = penetration<double>(*a, X_WA, *b, X_WB);
      if (p.upper > 0) expectSound(p, blob, X_WA, torus, X_WB);
    }
  }
}

// A box with a dent that rounding could have made, and a spike of another solid in it.
TEST(Penetration, AFlatDentIsNoPartOfTheSolid) {
  for (const double dent : {1e-8, 1e-5, 1e-2}) {
    Mesh box = scenes::subdividedBox({1, 1, 1}, 4);
    for (fcl::Vector3d& v : box.vertices) {
      if (v.isApprox(fcl::Vector3d(0, 0, 0.5))) v[2] -= dent;
    }
    Mesh spike;
    spike.vertices = {{0, 0, 0}, {-0.1, -0.1, 1}, {0.1, -0.1, 1}, {0, 0.1, 1}};
    spike.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
    const auto a = solidOf(box), b = solidOf(spike);
    const double in = 0.01 * dent;
    const Case c = {box, spike, at(0, 0, 0), at(0, 0, 0.5 - dent - in)};
    const PenetrationResult p = penetration<double>(*a, c.X_WA, *b, c.X_WB);
    EXPECT_LE(p.lower, in + 1e-13) << dent;
    EXPECT_GT(p.upper, 0) << dent;
    expectSound(p, c.a, c.X_WA, c.b, c.X_WB);
  }
}

TEST(Penetration, FloatModelsAreBracketed) {
  const auto box = solidOf<float>(scenes::subdividedBox({1, 1, 1}, 2));
  const auto torus = solidOf<float>(scenes::bumpyTorus(400));
  const PenetrationResult p =
      penetration<float>(*box, at<float>(0, 0, 0), *box, at<float>(0.75, 0, 0));
  EXPECT_NEAR(p.lower, 0.25, 1e-3);
  EXPECT_NEAR(p.upper, 0.25, 1e-3);
  const PenetrationResult q =
      penetration<float>(*torus, at<float>(0, 0, 0), *box, at<float>(1, 0, 0));
  EXPECT_GT(q.lower, 0);
  const fcl::CollisionRequestf request;
  fcl::CollisionResultf result;
  auto X = at<float>(1, 0, 0);
  X.translation() += q.translation.cast<float>();
  EXPECT_EQ(fcl::collide(torus.get(), at<float>(0, 0, 0), box.get(), X, request, result), 0u);
}

TEST(Penetration, BadArgumentsAreRefused) {
  const auto box = solidOf(scenes::subdividedBox({1, 1, 1}, 2));
  const auto soup = testing::modelOf(scenes::subdividedBox({1, 1, 1}, 2));
  PenetrationRequest options;
  EXPECT_THROW(penetration<double>(*box, at(0, 0, 0), *soup, at(0, 0, 0)), std::invalid_argument);
  EXPECT_THROW(penetration<double>(*soup, at(0, 0, 0), *box, at(0, 0, 0)), std::invalid_argument);
  options.rel_gap = -1;
  EXPECT_THROW(penetration<double>(*box, at(0, 0, 0), *box, at(0, 0, 0), options),
               std::invalid_argument);
  options = {};
  options.max_tests = -1;
  EXPECT_THROW(penetration<double>(*box, at(0, 0, 0), *box, at(0, 0, 0), options),
               std::invalid_argument);
}

}  // namespace
}  // namespace kios
