// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Local depths against samples of both surfaces and balls, of meshes and of boxes on a grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "not_finite.h"
#include "scalars.h"
#include "scenes/cad_shapes.h"
#include "scenes/depth_oracle.h"
#include "scenes/triangle_families.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using fcl::Vector3d;
using scenes::DepthOracle;
using scenes::merged;
using scenes::subdividedBox;

/// Returns what is wrong with the place where `lower` is attained, if anything.
std::string faultOfLower(const LocalDepthResult& found, const DepthOracle& a, const DepthOracle& b,
                         double rounding) {
  if (!(found.lower > rounding)) return {};
  const Vector3d p(found.point[0], found.point[1], found.point[2]),
      q(found.nearest[0], found.nearest[1], found.nearest[2]);
  const DepthOracle &other = found.surface_of == 1 ? b : a, &own = found.surface_of == 1 ? a : b;
  if (!(other.distance(p) >= found.lower - rounding)) return "the point is nearer to the surface";
  if (!(std::abs((p - q).norm() - found.lower) <= 4 * rounding)) return "the points are elsewhere";
  if (!other.holds(p)) return "the point is outside";
  if (found.surface_of != 0) {
    if (!(own.distance(p) <= rounding)) return "the point isn't of its surface";
    return other.distance(q) <= rounding ? "" : "the nearest point isn't of its surface";
  }
  if (!(own.distance(p) >= found.lower - rounding) || !own.holds(p))
    return "the ball isn't in both";
  return std::min(a.distance(q), b.distance(q)) <= rounding ? "" : "nothing bounds the ball";
}

KIOS_SCALAR_SUITE(LocalDepthOfTwo);

TYPED_TEST(LocalDepthOfTwo, IsThatOfSamples) {
  using S = TypeParam;
  Random random(11);
  const auto meshes = solidMeshes();
  const double rounding = sizeof(S) == sizeof(double) ? 2e-11 : 1e-3;
  const auto poses = scenes::randomPoses(casesOr(24), 0.8, 17);
  int deep = 0, open = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Mesh& mesh_a = meshes[i % meshes.size()].mesh;
    const Mesh& mesh_b = meshes[(i / meshes.size() + 3 * i) % meshes.size()].mesh;
    const auto a = solidOf<S>(mesh_a), b = solidOf<S>(mesh_b);
    const fcl::Transform3<S> X_WA = fcl::Transform3<S>::Identity(),
                             X_WB = poses[i].template cast<S>();
    LocalDepthRequest request;
    request.rel_err = i % 3 == 0 ? 0.01 : 0.1;
    request.max_pieces = 2000;
    const LocalDepthResult found = localDepth(*a, X_WA, *b, X_WB, request);
    const DepthOracle in_world_a(mesh_a),
        in_world_b(scenes::moved(X_WB.template cast<double>(), mesh_b));
    const double deepest = std::max({deepestSample(in_world_a, in_world_b, 6),
                                     deepestSample(in_world_b, in_world_a, 6),
                                     largestBall(in_world_a, in_world_b, 2000, random)});
    EXPECT_LE(deepest, found.upper + rounding);
    EXPECT_EQ(faultOfLower(found, in_world_a, in_world_b, rounding), "");
    EXPECT_LE(found.lower, found.upper);
    EXPECT_TRUE(!found.complete ||
                found.upper - found.lower <= request.rel_err * found.upper + rounding);
    deep += deepest > 0 ? 1 : 0;
    open += found.complete ? 0 : 1;
    EXPECT_TRUE(found.lower > 0 || deepest <= rounding);
    // Decided by a threshold, too.
    request.threshold = 0.5 * (found.lower + found.upper) * random.uniform(0.5, 1.5);
    const LocalDepthResult told = localDepth(*a, X_WA, *b, X_WB, request);
    EXPECT_LE(told.lower, found.upper + rounding);
    EXPECT_GE(told.upper, found.lower - rounding);
    EXPECT_TRUE(!told.complete || told.lower > request.threshold ||
                told.upper <=
                    std::max(request.threshold, told.lower / (1 - request.rel_err)) + rounding);
    request.threshold = -1;
    request.max_pieces = i % 40;
    const LocalDepthResult reversed = localDepth(*b, X_WB, *a, X_WA, request);
    const LocalDepthResult brief = localDepth(*a, X_WA, *b, X_WB, request);
    EXPECT_LE(brief.lower, found.upper + rounding);
    EXPECT_GE(brief.upper, found.lower - rounding);
    const auto told_of = [](const LocalDepthResult& d, int surface) {
      return std::vector<double>{d.lower,      d.upper,     d.complete * 1.0, surface * 1.0,
                                 d.point[0],   d.point[1],  d.point[2],       d.nearest[0],
                                 d.nearest[1], d.nearest[2]};
    };
    EXPECT_EQ(told_of(brief, (3 - brief.surface_of) % 3), told_of(reversed, reversed.surface_of));
  }
  EXPECT_GT(deep, static_cast<int>(poses.size()) / 2);
  EXPECT_LT(open, static_cast<int>(poses.size()) / 2);
}

/// A union of boxes whose corners are whole, at an offset: known cube by cube, and so what of the
/// boxes' faces is surface of the union.
class Cubes {
 public:
  Cubes(Random& random, const Vector3d& at) : at_(at) {
    std::vector<Mesh> boxes;
    const int count = scenes::integer(random, 1, 3);
    for (int i = 0; i < count; ++i) {
      Vector3d low, size;
      for (int c = 0; c < 3; ++c) {
        low[c] = scenes::integer(random, 0, kSide - 2);
        size[c] = scenes::integer(random, 1, kSide - 1 - static_cast<int>(low[c]));
      }
      boxes.push_back(
          transformed(subdividedBox(size, scenes::integer(random, 1, 3)), 1, low + size / 2));
      for (int k = 0; k < kSide * kSide * kSide; ++k) {
        const Vector3d middle = corner(k) + Vector3d::Constant(0.5);
        full_[k] |= ((middle - low).array() > 0 && (low + size - middle).array() > 0).all();
      }
    }
    model = solidOf(merged(boxes));
    for (int k = 0; k < kSide * kSide * kSide; ++k) {
      if (!full_[k]) continue;
      for (int c = 0; c < 6; ++c) {
        const Vector3d to = (c < 3 ? 1.0 : -1.0) * Vector3d::Unit(c % 3);
        if (holdsCube(corner(k) + to)) continue;
        const Vector3d middle = corner(k) + Vector3d::Constant(0.5) + 0.5 * to;
        const Vector3d half = 0.5 * (Vector3d::Ones() - Vector3d::Unit(c % 3));
        faces.emplace_back(at_ + middle - half, at_ + middle + half);
      }
    }
  }

  fcl::Transform3d pose() const { return at(at_[0], at_[1], at_[2]); }
  /// 0 outside.
  double depth(const Vector3d& p) const {
    bool inside = false;
    for (int k = 0; k < kSide * kSide * kSide && !inside; ++k) {
      const Vector3d from = p - at_ - corner(k);
      inside = full_[k] && from.minCoeff() >= 0 && from.maxCoeff() <= 1;
    }
    return inside ? distance(p) : 0;
  }
  double distance(const Vector3d& p) const {
    double least = kInfinity;
    for (const Eigen::AlignedBox3d& face : faces) {
      least = std::min(least, face.exteriorDistance(p));
    }
    return least;
  }

  std::vector<Eigen::AlignedBox3d> faces;  ///< of the surface, in the world
  std::shared_ptr<Modeld> model;

 private:
  static constexpr int kSide = 5;
  static Vector3d corner(int k) {
    return {double(k % kSide), double(k / kSide % kSide), double(k / (kSide * kSide))};
  }
  bool holdsCube(const Vector3d& low) const {
    if (low.minCoeff() < 0 || low.maxCoeff() >= kSide) return false;
    return full_[static_cast<int>(low[0] + kSide * (low[1] + kSide * low[2]))];
  }
  const Vector3d at_;
  bool full_[kSide * kSide * kSide] = {};
};

/// Faces, edges and middles coincide, and unions have walls.
TEST(LocalDepth, OfBoxesOnAGrid) {
  Random random(29);
  int closed = 0, walls = 0;
  const int cases = casesOr(60);
  for (int i = 0; i < cases; ++i) {
    Vector3d by;
    for (int c = 0; c < 3; ++c) by[c] = 0.5 * scenes::integer(random, -3, 3);
    if (i % 4 == 0) by[0] += 1e-7;
    const Cubes a(random, Vector3d::Zero()), b(random, by);
    LocalDepthRequest request;
    request.max_pieces = 3000;
    const LocalDepthResult found = localDepth(*a.model, a.pose(), *b.model, b.pose(), request);
    double deepest = 0;
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
      for (const Eigen::AlignedBox3d& face : own->faces) {
        for (int k = 0; k < 27; ++k) {
          const Vector3d share(k % 3 / 2.0, k / 3 % 3 / 2.0, k / 9 / 2.0);
          deepest = std::max(deepest, other->depth(face.min() + share.cwiseProduct(face.sizes())));
        }
      }
    }
    for (int k = 0; k < 500; ++k) {
      Vector3d p;
      for (int c = 0; c < 3; ++c) p[c] = 0.25 * scenes::integer(random, 0, 20);
      deepest = std::max(deepest, std::min(a.depth(p), b.depth(p)));
    }
    EXPECT_LE(deepest, found.upper + 1e-11) << i;
    const Vector3d p = Eigen::Map<const Vector3d>(found.point);
    if (found.lower > 1e-9) {
      const double depth_a = a.depth(p), depth_b = b.depth(p);
      EXPECT_GE(found.surface_of == 1 ? depth_b : depth_a, found.lower - 1e-11) << i;
      EXPECT_TRUE(found.surface_of != 0 || depth_b >= found.lower - 1e-11) << i;
      EXPECT_LE(found.surface_of == 0 ? 0 : (found.surface_of == 1 ? a : b).distance(p), 1e-10);
    }
    closed += found.complete ? 1 : 0;
    walls += found.upper > 1.02 * found.lower + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(closed, cases / 3);
  EXPECT_GT(walls, 0);
}

}  // namespace
}  // namespace kios::testing
