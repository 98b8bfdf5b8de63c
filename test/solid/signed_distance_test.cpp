// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "not_finite.h"
#include "query/hard_points.h"
#include "scalars.h"
#include "scenes/containment_oracle.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using Columns = Eigen::Matrix3Xd;
using scenes::ContainmentOracle;

template <typename S>
Eigen::VectorXd signedOf(const Model<S>& model, const Columns& points,
                         const PointRequest& request = {}) {
  Eigen::VectorXd distances(points.cols());
  signedDistances(model, points, distances, request);
  return distances;
}

/// Rounds through memory: g++ 12's vectoriser folds a round trip from double to float and
/// back.
template <typename S>
fcl::Vector3<S> rounded(const fcl::Vector3d& p) {
  fcl::Vector3<S> r;
  for (int c = 0; c < 3; ++c) {
    const volatile S v = static_cast<S>(p[c]);
    r[c] = v;
  }
  return r;
}

KIOS_SCALAR_SUITE(SignedDistance);

// KIOS_SOLID_CASES=100000 asks for so many verdicts.
TYPED_TEST(SignedDistance, SignsEqualRationalArithmetic) {
  using S = TypeParam;
  const double far = sizeof(S) == sizeof(double) ? 1e9 : 1e3;
  const std::pair<double, fcl::Vector3d> places[] = {
      {1, {0, 0, 0}}, {1, {far, -far, far / 2}}, {1e-30, {0, 0, 0}}, {1e23, {0, 0, 0}}};
  const auto meshes = solidMeshes();
  const int cases = casesOr(20000), each = cases / static_cast<int>(4 * meshes.size());
  std::uint64_t seed = 5;
  int inside = 0, on_surface = 0;
  for (const auto& named : meshes) {
    for (const auto& [scale, offset] : places) {
      Mesh mesh = transformed(named.mesh, scale, offset);
      const auto model = modelOf<S>(mesh);
      // Rounding to a float grid far away may close faces up, or open none: still a solid or not.
      if (!inspectClosedness(*model).isSolid()) continue;
      markSolid(*model);
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        mesh.vertices[v] = model->vertices[v].template cast<double>();
      }
      const ContainmentOracle oracle(mesh);
      Columns points = pointsAbout(mesh, each, scale, offset, ++seed);
      for (Eigen::Index i = 0; i < points.cols(); i += 2) {  // as S holds them
        points.col(i) = rounded<S>(points.col(i)).template cast<double>();
      }
      const Eigen::VectorXd distances = signedOf(*model, points);
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        const fcl::Vector3d p = points.col(i);
        SCOPED_TRACE(named.name);
        ASSERT_EQ(signedDistance(*model, p), distances[i]);
        const double surface = nearestPoint(*model, p).distance;
        const auto place = oracle.placeOf(p);
        inside += place == ContainmentOracle::Place::kInside;
        on_surface += place == ContainmentOracle::Place::kSurface;
        // A wall within the union is no surface of the solid, but at distance 0.
        ASSERT_EQ(distances[i]<0, surface> 0 && place == ContainmentOracle::Place::kInside);
        ASSERT_EQ(std::abs(distances[i]), surface) << p.transpose();
        ASSERT_TRUE(surface == 0 || place != ContainmentOracle::Place::kSurface);
        if (i % 2 != 0) continue;
        const fcl::Vector3<S> q = rounded<S>(p);
        ASSERT_EQ(contains<S>(*model, fcl::Transform3<S>::Identity(), q),
                  place != ContainmentOracle::Place::kOutside)
            << p.transpose();
      }
    }
  }
  EXPECT_GT(inside, cases / 10);
  EXPECT_GT(on_surface, cases / 20);
}

/// Two boxes that cross, and shells one in the other, at any size and place.
TEST(SignedDistanceOf, WallsWithinTheUnionCount) {
  const Mesh crossing =
      scenes::merged({scenes::subdividedBox({4, 2, 2}, 8),
                      transformed(scenes::subdividedBox({4, 2, 2}, 6), 1, {2.5, 0, 0})});
  for (const double scale : {1.0, 0x1p-272, 0x1p266, 0x1p512}) {
    const auto model = solidOf(transformed(crossing, scale, {0, 0, 0}));
    const auto depth = [&](double x, double y, double z) {
      return -signedDistance(*model, fcl::Vector3d(x, y, z) * scale) / scale;
    };
    // The union is a box from -2 to 4.5, with walls across it at 0.5 and 2.
    EXPECT_EQ(depth(0.5, 0, 0), 0);
    EXPECT_EQ(depth(0.5, 0.25, 0.5), 0);
    EXPECT_DOUBLE_EQ(depth(1.75, 0.25, 0), 0.25);
    EXPECT_DOUBLE_EQ(depth(-1.5, 0, 0), 0.5);
    EXPECT_EQ(depth(1, 1, 0.3), 0);
    EXPECT_DOUBLE_EQ(depth(1, 1.5, 0), -0.5);
  }
  const auto nested = solidOf(scenes::merged({scenes::icosphere(2, 3), scenes::icosphere(0.3, 2)}));
  EXPECT_LT(signedDistance(*nested, {0, 0, 0}), -0.28);
  EXPECT_GT(signedDistance(*nested, {0, 0, 0}), -0.3);
  // Two boxes an ulp apart, whose union has a wall in two layers.
  const auto gap = solidOf(
      scenes::merged({scenes::subdividedBox({2, 2, 2}, 1),
                      transformed(scenes::subdividedBox({2, 2, 2}, 1), 1, {2 + 0x1p-51, 0, 0})}));
  EXPECT_EQ(signedDistance(*gap, {1, 0.2, 0.1}), 0);
  EXPECT_DOUBLE_EQ(signedDistance(*gap, {0.75, 0.2, 0.1}), -0.25);
}

Mesh rotatedBox(double half, const Eigen::Quaterniond& q) {
  Mesh box = scenes::subdividedBox({2 * half, 2 * half, 2 * half}, 1);
  for (fcl::Vector3d& v : box.vertices) v = q * v;
  return box;
}

/// Points that are about as far from the last one as that is from the surface: the sign is that of
/// a point by itself in every order.
TEST(SignedDistanceOf, SignsAtTheLimitOfEmptyBalls) {
  Random random(3);
  int crossed = 0;
  for (const double half : {1e-170, 1e-30, 1.0, 1e6, 1e100}) {
    for (int i = 0; i < 40; ++i) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1)
              .normalized();
      const auto model = solidOf(rotatedBox(half, q));
      const fcl::Vector3d n = q * fcl::Vector3d::UnitZ();
      const fcl::Vector3d on =
          half * (q * fcl::Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 1));
      const fcl::Vector3d p = on - 1e-9 * half * n;
      for (int k = -20; k < 30; ++k) {
        Columns points(3, 2);
        points.col(0) = p;
        points.col(1) = on + (8e-17 * k * half) * n;
        PointRequest request;
        request.within = std::nextafter(-signedDistance(*model, p), 0.0);
        for (int turn = 0; turn < 2; ++turn) {
          const Eigen::VectorXd distances = signedOf(*model, points, request);
          for (Eigen::Index c = 0; c < 2; ++c) {
            ASSERT_EQ(distances[c], signedDistance(*model, points.col(c), request));
          }
          crossed += std::signbit(distances[0]) != std::signbit(distances[1]);
          points = points.rowwise().reverse().eval();
        }
      }
      Columns far(3, 2);
      far << fcl::Vector3d::Zero(), 1.5 * half * n;
      EXPECT_NEAR(signedOf(*model, far)[1], 0.5 * half, 1e-14 * half);
    }
  }
  EXPECT_GT(crossed, 1000);
}

TEST(SignedDistanceOf, BatchesPosesAndThreads) {
  const Mesh mesh = scenes::bumpyTorus(3000);
  const auto model = solidOf(mesh);
  const Columns points = pointsAbout(mesh, 4000, 1, {0, 0, 0}, 8);
  const Eigen::VectorXd expected = signedOf(*model, points);
  PointRequest request;
  for (const int threads : {0, 2, 5}) {
    request.threads = threads;
    EXPECT_EQ(signedOf(*model, points, request), expected);
  }
  EXPECT_EQ(signedOf(*model, points.rowwise().reverse(), request).reverse(), expected);
  request.within = 0.1;
  const Eigen::VectorXd within = signedOf(*model, points, request);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double far = std::copysign(kInfinity, expected[i]);
    ASSERT_EQ(within[i], std::abs(expected[i]) <= 0.1 ? expected[i] : far);
  }
  request = {};
  request.X_WM.translation() << 4, 2, -8;
  const Columns placed = points.colwise() + request.X_WM.translation();
  const Eigen::VectorXd posed = signedOf(*model, placed, request);
  EXPECT_LE(((posed - expected).array() / (1 + expected.array().abs())).abs().maxCoeff(), 1e-13);
}

TEST(SignedDistanceOf, OpenMeshesByWindingNumbers) {
  Mesh bowl = scenes::icosphere(1, 4);
  std::vector<fcl::Triangle> kept;
  for (const fcl::Triangle& t : bowl.triangles) {
    if (bowl.vertices[t[0]][2] < 0.8) kept.push_back(t);
  }
  bowl.triangles = kept;
  const auto model = modelOf(bowl);
  const WindingTree tree(*model);
  PointRequest request;
  request.winding = &tree;
  const Columns points = pointsAbout(bowl, 2000, 1, {0, 0, 0}, 2);
  const Eigen::VectorXd distances = signedOf(*model, points, request);
  int inside = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double surface = nearestPoint(*model, points.col(i)).distance;
    ASSERT_EQ(std::abs(distances[i]), surface);
    if (surface == 0) continue;
    const double number = tree.at(points.col(i), 0);
    if (std::abs(number - 0.5) < 1e-10) continue;
    ASSERT_EQ(distances[i]<0, number> 0.5);
    inside += number > 0.5;
  }
  EXPECT_GT(inside, 200);
  EXPECT_LT(signedDistance(*model, {0, 0, 0.5}, request), 0);
  EXPECT_GT(signedDistance(*model, {0, 0, 1.2}, request), 0);
}

TEST(SignedDistanceOf, MeshesWithoutAnInsideAreRefused) {
  const auto model = modelOf(scenes::sheet(1, 1, 2, 2, 0));
  EXPECT_THROW(signedDistance(*model, {0, 0, 0}), std::invalid_argument);
  const auto solid = solidOf(scenes::icosphere(1, 1));
  EXPECT_THROW(signedDistance(*solid, {0, 0, kNaN}), std::invalid_argument);
  fcl::Transform3d X = kHere;
  EXPECT_THROW(contains<double>(*model, X, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(contains<double>(*solid, X, {0, kNaN, 0}), std::invalid_argument);
  X.linear() *= 2;
  EXPECT_THROW(contains<double>(*solid, X, {0, 0, 0}), std::invalid_argument);
  Eigen::VectorXd few(1);
  EXPECT_THROW(signedDistances(*solid, Columns::Zero(3, 2), few), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
