// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Local depths that are known; local_depth_samples_test.cpp has others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "not_finite.h"
#include "scenes/depth_oracle.h"
#include "scenes/triangle_families.h"
#include "solid/solid_meshes.h"
#include "together.h"

namespace kios::testing {
namespace {

using fcl::Vector3d;
using scenes::icosphere;
using scenes::merged;
using scenes::subdividedBox;

void expectDepth(const LocalDepthResult& found, double depth, double rounding = 1e-13) {
  EXPECT_LE(found.lower, depth + rounding);
  EXPECT_GE(found.upper, depth - rounding);
  EXPECT_TRUE(found.complete);
  EXPECT_LE(found.upper - found.lower, 0.01 * found.upper + 100 * rounding);
}

/// In both orders.
void expectDepth(const Modeld& a, const fcl::Transform3d& X_WA, const Modeld& b,
                 const fcl::Transform3d& X_WB, double depth, double rounding = 1e-13) {
  expectDepth(localDepth(a, X_WA, b, X_WB), depth, rounding);
  expectDepth(localDepth(b, X_WB, a, X_WA), depth, rounding);
  EXPECT_FALSE(deeperThan(a, X_WA, b, X_WB, 1.001 * depth + 100 * rounding));
  if (!(depth > 1e4 * rounding)) return;
  EXPECT_TRUE(deeperThan(a, X_WA, b, X_WB, 0.999 * depth - rounding));
}

TEST(LocalDepth, OfSolidsWhoseDepthIsKnown) {
  const auto box = solidOf(subdividedBox({2, 2, 2}, 1));
  const auto small = solidOf(subdividedBox({0.5, 0.5, 0.5}, 1));
  const auto plate = solidOf(subdividedBox({6, 6, 0.1}, 1));
  const auto fine_plate = solidOf(subdividedBox({6, 6, 0.1}, 7));
  expectDepth(*box, kHere, *small, at(3, 0, 0), 0);
  expectDepth(*box, kHere, *small, at(0.2, 0.1, 0), 1.0 - 0.05);
  expectDepth(*box, kHere, *small, at(1.25 - 0.0625, 0, 0), 0.0625);
  // A sheet through a block, and solids on themselves.
  expectDepth(*plate, kHere, *box, kHere, 0.95);
  expectDepth(*box, kHere, *box, kHere, 1);
  expectDepth(*plate, kHere, *plate, kHere, 0.05);
  expectDepth(*plate, kHere, *fine_plate, kHere, 0.05);
  const auto box_f = solidOf<float>(subdividedBox({2, 2, 2}, 1));
  const LocalDepthResult in_float =
      localDepth(*box_f, at<float>(0, 0, 0), *box_f, at<float>(1.75, 0, 0));
  expectDepth(in_float, 0.25, 1e-6);
  const auto ball = solidOf(icosphere(1, 3));
  const LocalDepthResult same = localDepth(*ball, kHere, *ball, kHere);
  EXPECT_EQ(same.surface_of, 0);
  EXPECT_GT(same.lower, 0.98);
  EXPECT_LT(same.upper, 1.01);
}

TEST(LocalDepth, OfFacesThatAreFlush) {
  for (const double sunk : {1e-9, 1e-7, 1e-5, 1e-3}) {
    for (const int n : {1, 8}) {
      const auto wall = solidOf(subdividedBox({2, 2, 2}, n));
      const auto part = solidOf(subdividedBox({1, 1, 1}, n + 3));
      const fcl::Transform3d turned = scenes::randomPoses(1, 3, 5)[0];
      for (const double over : {0.0, 0.3, 0.8, 1.2}) {  // within the face, and over its edge
        expectDepth(*wall, kHere, *part, at(over, 0.2, 1.5 - sunk), sunk);
        expectDepth(*wall, turned, *part, turned * at(over, 0.2, 1.5 - sunk), sunk);
      }
      // Let in on all sides: the corners are deepest, and no way out is short.
      const auto pocket =
          solidOf(merged({subdividedBox({3, 3, 3}, n), flipped(subdividedBox({1, 1, 1}, 1))}));
      const double size = 1 + 2 * sunk;
      const auto bar = solidOf(subdividedBox({size, size, size}, 1));
      expectDepth(*pocket, kHere, *bar, kHere, std::sqrt(3.0) * sunk);
    }
  }
}

/// Nothing is left out because a move in the world was longer than it was asked to be.
TEST(LocalDepth, OfAFaceThatBulgesFarFromTheOrigin) {
  constexpr double kUlp = 0x1p-22, kFar = 0x1p30;
  const auto wall = solidOf(subdividedBox({2, 2, 2}, 1));
  Mesh bulging = subdividedBox({1, 1, 1}, 8);
  for (Vector3d& p : bulging.vertices) {
    const bool middle = p[2] < -0.4 && p.head<2>().cwiseAbs().maxCoeff() < 0.3;
    p[2] += middle ? 0.5e-7 : 1e-7;
  }
  const auto part = solidOf(bulging);
  const double sunk = 4096 * kUlp, depth = sunk - 0.5e-7;
  const fcl::Transform3d X_WA = at(0, 0, kFar), X_WB = at(0, 0, kFar + (1.5 - sunk));
  LocalDepthRequest request;
  request.rel_err = 0;
  for (const LocalDepthResult& found : {localDepth(*part, X_WB, *wall, X_WA, request),
                                        localDepth(*wall, X_WA, *part, X_WB, request)}) {
    EXPECT_GE(found.upper, depth - 1e-12);
    EXPECT_LE(found.lower, depth + 1e-12);
  }
}

/// A bracket is 0 only where the models are apart by more than the common frame rounds.
TEST(LocalDepth, OfFacesThatTouchInTurnedFrames) {
  const auto box = solidOf(subdividedBox({1, 1, 1}, 2));
  const auto ball = solidOf(icosphere(0.5, 2));
  for (const fcl::Transform3d& X : scenes::randomPoses(20, 3, 31)) {
    for (const auto& other : {box, ball}) {
      const LocalDepthResult touching = localDepth(*box, X, *other, X * at(1, 0, 0));
      EXPECT_GT(touching.upper, 0);
      EXPECT_LE(touching.upper, 2e-10);
      EXPECT_TRUE(touching.complete);
      EXPECT_EQ(localDepth(*box, X, *other, X * at(1 + 1e-9, 0, 0)).upper, 0);
      EXPECT_FALSE(deeperThan(*box, X, *other, X * at(1 + 1e-9, 0, 0), 0));
    }
  }
}

TEST(LocalDepth, OfFacesThatOnlyTouch) {
  const auto box = solidOf(subdividedBox({1, 1, 1}, 2));
  const double root = std::sqrt(0.5);
  fcl::Transform3d on_edge = at(0, 0, 0.5 + root);
  on_edge.rotate(Eigen::AngleAxisd(std::atan(1.0), Vector3d::UnitX()));
  for (const auto& X : {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0.3, 0.2), on_edge}) {
    const LocalDepthResult found = localDepth(*box, kHere, *box, X);
    EXPECT_TRUE(found.complete);
    EXPECT_LE(found.upper, 2e-11);
    EXPECT_FALSE(deeperThan(*box, kHere, *box, X, 1e-9));
  }
}

/// Faces, edges and middles coincide, and unions have walls.
TEST(LocalDepth, OfBoxesOnAGrid) {
  Random random(29);
  const auto whole = [&](int low, int high) { return 1.0 * scenes::integer(random, low, high); };
  const auto boxes = [&](const Vector3d& by) {
    std::vector<Mesh> parts;
    for (int k = scenes::integer(random, 1, 3); k > 0; --k) {
      Vector3d low, size;
      for (int c = 0; c < 3; ++c) {
        low[c] = whole(0, 3);
        size[c] = whole(1, 4 - static_cast<int>(low[c]));
      }
      const Mesh box = subdividedBox(size, scenes::integer(random, 1, 2));
      parts.push_back(transformed(box, 1, by + low + size / 2));
    }
    return merged(parts);
  };
  int closed = 0, walls = 0;
  const int cases = casesOr(60);
  for (int i = 0; i < cases; ++i) {
    Vector3d by;
    for (int c = 0; c < 3; ++c) by[c] = 0.5 * whole(-3, 3);
    if (i % 4 == 0) by[0] += 1e-7;
    const scenes::DepthOracle a(boxes(Vector3d::Zero())), b(boxes(by));
    LocalDepthRequest request;
    request.max_pieces = 3000;
    const auto found = localDepth(*solidOf(a.mesh), kHere, *solidOf(b.mesh), kHere, request);
    EXPECT_LE(scenes::deepestSample(a, b, 2), found.upper + 1e-11) << i;
    EXPECT_LE(scenes::deepestSample(b, a, 2), found.upper + 1e-11) << i;
    EXPECT_LE(scenes::largestBall(a, b, 200, random), found.upper + 1e-11) << i;
    if (found.lower > 1e-9) {
      const Vector3d p = Eigen::Map<const Vector3d>(found.point);
      EXPECT_GE(scenes::provenDepth(a, b, p, 1e-10), found.lower - 1e-11) << i;
    }
    closed += found.complete ? 1 : 0;
    walls += found.upper > 1.02 * found.lower + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(closed, cases / 3);
  EXPECT_GT(walls, 0);
}

/// Walls within a union aren't its surface.
TEST(LocalDepth, OfUnions) {
  const auto crossing = solidOf(merged(
      {subdividedBox({4, 2, 2}, 4), transformed(subdividedBox({4, 2, 2}, 3), 1, {2.5, 0, 0})}));
  const auto pebble = solidOf(icosphere(0.1, 2));
  // The union is a box from -2 to 4.5, with walls across it at 0.5 and 2.
  for (const double x : {0.5, 1.25, 2.0}) {
    const LocalDepthResult found = localDepth(*crossing, kHere, *pebble, at(x, 0, 0));
    EXPECT_LE(found.lower, 1);
    EXPECT_GE(found.upper, 0.99);
    EXPECT_GT(found.lower, 0.05);
    EXPECT_TRUE(deeperThan(*crossing, kHere, *pebble, at(x, 0, 0), 0.05));
  }
  // The walls of the pair's first one are no surface that is deep in a plate across it.
  const auto plate = solidOf(subdividedBox({0.5, 8, 8}, 1));
  const LocalDepthResult found = localDepth(*crossing, kHere, *plate, at(0.5, 0, 0));
  EXPECT_GE(found.upper, 0.25);  // a ball, and the surface of the plate
  const Vector3d p = Eigen::Map<const Vector3d>(found.point);
  EXPECT_TRUE(found.surface_of != 1 || std::abs(p.tail<2>().cwiseAbs().maxCoeff() - 1) < 1e-9);
  // Where surfaces of a union touch along edges alone, which pairs of triangles don't tell.
  const auto touching = solidOf(merged(
      {subdividedBox({2, 2, 2}, 4), transformed(subdividedBox({2, 1, 1}, 2), 1, {1, 0, 0})}));
  const LocalDepthResult inner = localDepth(*touching, kHere, *pebble, at(1, 0, 0));
  EXPECT_GE(inner.upper, 0.49);
  // A triangle that is a point belongs to no solid.
  Mesh stray = subdividedBox({2, 2, 2}, 1);
  stray.vertices.emplace_back(0, 0, 0);
  const std::size_t last = stray.vertices.size() - 1;
  stray.triangles.emplace_back(last, last, last);
  EXPECT_GE(localDepth(*solidOf(stray), kHere, *pebble, kHere).upper, 0.89);
  EXPECT_GT(localDepth(*solidOf(stray), kHere, *pebble, kHere).lower, 0.05);
  stray.vertices.back() = {2, 0, 0};
  EXPECT_EQ(localDepth(*solidOf(stray), kHere, *solidOf(icosphere(0.5, 2)), at(2, 0, 0)).lower, 0);
}

/// Each line in which the slabs cross is an edge of one of them alone: no triangle passes through
/// another, and the middle of each has the outside before it.
TEST(LocalDepth, OfSlabsThatCrossAlongEdges) {
  const Mesh upright = prism({{1, -10}, {1, 1}, {1, 10}, {-1, 10}, {-1, -1}, {-1, -10}},
                             {{1, 2, 3}, {1, 3, 4}, {0, 1, 4}, {0, 4, 5}}, {-1, 1});
  const Mesh flat = prism({{-10, -1}, {1, -1}, {10, -1}, {10, 1}, {-1, 1}, {-10, 1}},
                          {{0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}}, {-2, -1, 1, 2});
  const auto cross = solidOf(merged({upright, flat}));
  for (const SelfIntersection& pair : selfIntersections(*cross)) {
    EXPECT_EQ(pair.kind, Meeting::kTouch);
  }
  const auto cube = solidOf(subdividedBox({0.1, 0.1, 0.1}, 1));
  // (0, 0.05, 0) is as far from the surface's nearest points, (0, 1, +-1).
  const double depth = std::hypot(0.95, 1.0);
  EXPECT_GE(localDepth(*cross, kHere, *cube, kHere).upper, depth - 1e-9);
  EXPECT_GE(localDepth(*cube, kHere, *cross, kHere).upper, depth - 1e-9);
}

/// Flush with several walls at once: no way out through one leaves the others.
TEST(LocalDepth, OfFitsWithoutPlay) {
  const auto expectTouch = [](const Modeld& a, const Modeld& b) {
    for (const fcl::Transform3d& X : {kHere, scenes::randomPoses(1, 3, 7)[0]}) {
      EXPECT_FALSE(deeperThan(a, X, b, X, 1e-6, 5000));
      EXPECT_FALSE(deeperThan(b, X, a, X, 1e-6, 5000));
    }
  };
  // Counterclockwise in (x, z), as squares.
  const std::vector<std::array<double, 2>> contour = {{0, 0}, {1, 0}, {2, 0}, {3, 0},
                                                      {3, 1}, {3, 2}, {2, 2}, {2, 1},
                                                      {1, 1}, {1, 2}, {0, 2}, {0, 1}};
  std::vector<std::array<std::size_t, 3>> caps;
  for (const auto& q : std::vector<std::array<std::size_t, 4>>{
           {0, 1, 8, 11}, {1, 2, 7, 8}, {2, 3, 4, 7}, {11, 8, 9, 10}, {7, 4, 5, 6}}) {
    caps.insert(caps.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  }
  const auto groove = solidOf(prism(contour, caps, {0, 2, 5}));
  const auto tongue =
      solidOf(prism({{1, 1}, {2, 1}, {2, 3}, {1, 3}}, {{0, 1, 2}, {0, 2, 3}}, {0, 5}));
  expectTouch(*groove, *tongue);
  const Mesh hollow = flipped(subdividedBox({2, 2, 2}, 3));
  expectTouch(*solidOf(merged({subdividedBox({10, 10, 10}, 2), hollow})),
              *solidOf(subdividedBox({2, 2, 2}, 1)));
}

/// All pairs of a fan share a corner: beyond some number of pairs nothing is claimed of walls.
TEST(LocalDepth, OfFans) {
  for (const int sides : {40, 3000}) {
    const auto cones = solidOf(scenes::uvSphere(1, 2, sides));
    const auto cube = solidOf(subdividedBox({0.2, 0.2, 0.2}, 1));
    const LocalDepthResult found = localDepth(*cones, kHere, *cube, at(0.75, 0, 0));
    // The corner (0.65, 0.1, 0.1) lies as deep in the cones but for their flatness.
    const double depth = (1 - std::hypot(0.65, 0.1) - 0.1) / std::sqrt(2.0);
    EXPECT_GE(found.upper, depth - 1e-2) << sides;
    EXPECT_GT(found.lower, 0.5 * depth) << sides;
    EXPECT_LE(found.lower, 1 / std::sqrt(2.0)) << sides;
  }
}

/// Triangles that a move leaves aside are paid for, too.
TEST(LocalDepth, WithinABudget) {
  const auto fine = solidOf(icosphere(1, 5));
  const auto cup = solidOf(shell(1.05, 0.999, 5));
  LocalDepthRequest request;
  request.max_pieces = 50;
  const LocalDepthResult found = localDepth(*cup, kHere, *fine, kHere, request);
  EXPECT_FALSE(found.complete);
  EXPECT_LE(found.lower, found.upper);
  EXPECT_GE(found.upper, 0.5e-3);
}

TEST(LocalDepth, OfAnySizeAndPlace) {
  for (const double scale : {0x1p-299, 0x1p-280, 0x1.1p-269, 0x1.35p-268, 0x1p-260, 1e-30, 1e-6,
                             1.0, 1e20, 0x1p260, 0x1p290}) {
    const auto box = solidOf(transformed(subdividedBox({2, 2, 2}, 2), scale, {0, 0, 0}));
    expectDepth(*box, kHere, *box, at(1.9 * scale, 0.3 * scale, 0), 0.1 * scale, 1e-13 * scale);
    for (const fcl::Transform3d& X : scenes::randomPoses(4, 0, 37)) {  // no axis is an edge
      expectDepth(*box, X, *box, X * at(1.9 * scale, 0.3 * scale, 0), 0.1 * scale, 1e-13 * scale);
    }
  }
  for (const double scale : {1e-200, 1e150}) {
    const auto box = solidOf(transformed(subdividedBox({2, 2, 2}, 1), scale, {0, 0, 0}));
    EXPECT_THROW(localDepth(*box, kHere, *box, kHere), std::invalid_argument);
  }
  const auto box = solidOf(subdividedBox({2, 2, 2}, 2));
  const auto far = solidOf(transformed(subdividedBox({2, 2, 2}, 2), 1, {1e9, 1e9, 0}));
  expectDepth(*box, at(1e9, 1e9, 1e9), *box, at(1e9 + 1.5, 1e9, 1e9), 0.5, 1e-11);
  expectDepth(*far, kHere, *box, at(1e9 + 1.5, 1e9, 0), 0.5, 1e-3);
  Mesh thin = icosphere(1, 2);
  for (Vector3d& p : thin.vertices) p = p.cwiseProduct(Vector3d(4, 1e-7, 1e-9)).eval();
  const LocalDepthResult through = localDepth(*box, kHere, *solidOf(thin), kHere);
  EXPECT_TRUE(through.complete);
  EXPECT_GE(through.upper, 1 - 1e-6);
  EXPECT_LE(through.lower, 1);
}

TEST(LocalDepth, RefusesWhatHasNone) {
  const auto box = solidOf(subdividedBox({2, 2, 2}, 1));
  const auto soup = modelOf(subdividedBox({2, 2, 2}, 1));
  EXPECT_THROW(localDepth(*box, kHere, *soup, kHere), std::invalid_argument);
  EXPECT_THROW(localDepth(*soup, kHere, *box, at(9, 0, 0)), std::invalid_argument);
  EXPECT_THROW(deeperThan(*box, kHere, *soup, kHere, 1), std::invalid_argument);
  fcl::Transform3d stretched = kHere;
  stretched.linear() *= 1.1;
  EXPECT_THROW(localDepth(*box, stretched, *box, kHere), std::invalid_argument);
  const auto refuses = [&](auto set, auto value) {
    LocalDepthRequest request;
    set(request) = value;
    EXPECT_THROW(localDepth(*box, kHere, *box, kHere, request), std::invalid_argument);
  };
  for (const double bad : {kNaN, -1.0}) {
    refuses([](LocalDepthRequest& r) -> double& { return r.tolerance; }, bad);
    refuses([](LocalDepthRequest& r) -> double& { return r.rel_err; }, bad);
    EXPECT_THROW(deeperThan(*box, kHere, *box, kHere, bad), std::invalid_argument);
  }
  refuses([](LocalDepthRequest& r) -> double& { return r.rel_err; }, 1.0);
  refuses([](LocalDepthRequest& r) -> double& { return r.threshold; }, kNaN);
  refuses([](LocalDepthRequest& r) -> long long& { return r.max_pieces; }, -1);
  // What rounding hides, or too few pieces, is not decided.
  EXPECT_THROW(deeperThan(*box, kHere, *box, at(0.5, 0, 0), 0.9, 1), std::runtime_error);
  EXPECT_THROW(deeperThan(*box, kHere, *box, at(1.5, 0, 0), 0.5), std::runtime_error);
  EXPECT_FALSE(deeperThan(*box, kHere, *box, kHere, kInfinity));
  LocalDepthRequest coarse;
  coarse.tolerance = 10;
  EXPECT_TRUE(localDepth(*box, kHere, *box, kHere, coarse).complete);
}

TEST(LocalDepth, FromManyThreads) {
  const auto torus = solidOf(scenes::bumpyTorus(600));
  const auto ball = solidOf(icosphere(1, 2));
  const auto poses = scenes::randomPoses(8, 0.5, 3);
  std::vector<LocalDepthResult> found(4 * poses.size());
  together(4, [&](int thread) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      found[static_cast<std::size_t>(thread) * poses.size() + i] =
          localDepth(*torus, kHere, *ball, poses[i]);
    }
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].lower, found[i % poses.size()].lower);
    EXPECT_EQ(found[i].upper, found[i % poses.size()].upper);
  }
}

}  // namespace
}  // namespace kios::testing
