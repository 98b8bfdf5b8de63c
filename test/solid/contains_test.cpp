// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scalars.h"
#include "scenes/containment_oracle.h"
#include "solid/solid_meshes.h"

namespace kios {
namespace {

using scenes::ContainmentOracle;
using scenes::Random;

/// Returns points where verdicts are hard: near the surface, on its faces, edges and vertices,
/// level with vertices, and anywhere.
fcl::Vector3d hardPoint(const scenes::Mesh& mesh, double size, Random& random) {
  const auto pick = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random.unit() * static_cast<double>(n)));
  };
  const fcl::Triangle& t = mesh.triangles[pick(mesh.triangles.size())];
  const fcl::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const fcl::Vector3d step = size * testing::inCube(random);
  double u = random.unit(), v = random.unit();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  switch (pick(9)) {
    case 0:
      return a;
    case 1:
      return 0.5 * (a + b);
    case 2:
      return a + u * (b - a);
    case 3:
      return a + u * (b - a) + v * (c - a);
    case 4:
      return a + u * (b - a) + v * (c - a) + 1e-12 * step;
    case 5:
      return a + 1e-12 * step;
    case 6:
      return {a[0], b[1], c[2]};
    case 7:
      return {a[0], a[1], a[2] + step[2]};
    default:
      return mesh.vertices[t[0]] + step;
  }
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

KIOS_SCALAR_SUITE(Contains);

// KIOS_SOLID_CASES=100000 asks for so many verdicts.
TYPED_TEST(Contains, VerdictsEqualRationalArithmetic) {
  using S = TypeParam;
  const int cases = testing::casesOr(20000);
  struct Placed {
    double scale;
    fcl::Vector3d offset;
  };
  const double far = sizeof(S) == sizeof(double) ? 1e9 : 1e3;
  const Placed places[] = {
      {1, {0, 0, 0}}, {1, {far, -far, far / 2}}, {1e-9, {0, 0, 0}}, {1e9, {0, 0, 0}}};
  const auto meshes = testing::solidMeshes();
  Random random(3);
  const int each = std::max(1, cases / static_cast<int>(4 * meshes.size()));
  int inside = 0, on_surface = 0;
  for (const auto& named : meshes) {
    for (const Placed& place : places) {
      scenes::Mesh mesh = testing::transformed(named.mesh, place.scale, place.offset);
      for (fcl::Vector3d& p : mesh.vertices) p = rounded<S>(p).template cast<double>();
      const auto model = testing::modelOf<S>(mesh);
      // Rounding to a float grid far away may close faces up, or open none: still a solid or not.
      if (!inspectClosedness(*model).isSolid()) continue;
      markSolid(*model);
      const ContainmentOracle oracle(mesh);
      for (int i = 0; i < each; ++i) {
        const fcl::Vector3<S> p = rounded<S>(hardPoint(mesh, place.scale, random));
        const auto expected = oracle.placeOf(p.template cast<double>());
        inside += expected == ContainmentOracle::Place::kInside;
        on_surface += expected == ContainmentOracle::Place::kSurface;
        ASSERT_EQ(contains<S>(*model, fcl::Transform3<S>::Identity(), p),
                  expected != ContainmentOracle::Place::kOutside)
            << named.name << ", scale " << place.scale << ", at " << p.transpose();
      }
    }
  }
  EXPECT_GT(inside, cases / 10);
  EXPECT_GT(on_surface, cases / 20);
}

TEST(ContainsPosed, ThePointIsMappedIntoTheModel) {
  const auto model = testing::solidOf(scenes::subdividedBox({2, 4, 6}, 3));
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const fcl::Transform3d X = testing::wholePose(random, 100);
    const fcl::Vector3d p(random.uniform(-1.5, 1.5), random.uniform(-3, 3), random.uniform(-4, 4));
    const fcl::Vector3d out = p.cwiseAbs() - fcl::Vector3d(1, 2, 3);
    if (std::abs(out.maxCoeff()) < 1e-9) continue;
    EXPECT_EQ(contains<double>(*model, X, X * p), out.maxCoeff() < 0);
  }
}

TEST(ContainsPosed, ModelsBeyondTheRangeOfPreparedTreesAreServed) {
  const auto model =
      testing::solidOf(testing::transformed(scenes::icosphere(1, 2), 1e-30, {0, 0, 0}));
  EXPECT_TRUE(contains<double>(*model, fcl::Transform3d::Identity(), {1e-31, 0, 0}));
  EXPECT_FALSE(contains<double>(*model, fcl::Transform3d::Identity(), {1e-30, 1e-30, 0}));
}

TEST(ContainsPosed, BadArgumentsAreRefused) {
  const auto soup = testing::modelOf(scenes::icosphere(1, 1));
  const fcl::Transform3d X = fcl::Transform3d::Identity();
  EXPECT_THROW(contains<double>(*soup, X, {0, 0, 0}), std::invalid_argument);
  const auto model = testing::solidOf(scenes::icosphere(1, 1));
  EXPECT_THROW(contains<double>(*model, X, {0, NAN, 0}), std::invalid_argument);
  fcl::Transform3d skew = X;
  skew.linear() *= 2;
  EXPECT_THROW(contains<double>(*model, skew, {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace kios
