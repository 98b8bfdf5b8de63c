// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Winding numbers against sums of solid angles in long double.
#include <gtest/gtest.h>

#include <utility>

#include "all_pairs.h"
#include "fcl_kios/fcl_kios.h"
#include "not_finite.h"
#include "scalars.h"
#include "scenes/triangle_families.h"

namespace kios::testing {
namespace {

std::vector<NamedMesh> meshes() {
  using namespace scenes;
  Mesh open = icosphere(1, 3);
  open.triangles.resize(open.triangles.size() * 3 / 4);
  return {{"closed", bumpyTorus(4000)},
          {"open", open},
          {"cuts itself", merged({icosphere(1, 2), transformed(icosphere(1, 2), 1, {0.5, 0, 0})})},
          {"sheet", sheet(2, 2, 20, 20, 0.4)},
          {"soup", randomSoup(500, 1, 1e-4, 2, 3)},
          {"needles", uvSphere(1, 4, 400)},
          {"triangle", singleTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}};
}

KIOS_SCALAR_SUITE(WindingNumbers);

TYPED_TEST(WindingNumbers, WithinTheError) {
  using S = TypeParam;
  const bool wide = sizeof(S) == sizeof(double);
  const std::pair<double, fcl::Vector3d> places[] = {
      {1, {0, 0, 0}},
      {1, fcl::Vector3d(1, -1, 0.5) * (wide ? 1e9 : 1e3)},
      {wide ? 1e-120 : 1e-18, {0, 0, 0}},
      {wide ? 1e120 : 1e18, {0, 0, 0}}};
  Random random(3);
  for (const auto& [name, mesh] : meshes()) {
    for (const auto& [scale, offset] : places) {
      const auto model = scenes::buildModel<kIOS<S>>(transformed(mesh, scale, offset));
      const WindingTree tree(*model);
      const Triangles triangles = trianglesOf<S>(*model);
      double worst = 0;
      for (int i = 0; i < 60; ++i) {
        const fcl::Vector3d way =
            i % 3 > 0 ? fcl::Vector3d(1.5 * inCube(random)) : scenes::displacement(random, -3, 20);
        const fcl::Vector3d p = offset + scale * way;
        const long double exact = windingNumber(triangles, p);
        const double rounding = 0x1p-45 * static_cast<double>(mesh.triangles.size());
        for (const double error : {0.0, 1e-9, 1e-5, 1e-3, 0.1}) {
          const long double off = std::abs(tree.at(p, error) - exact);
          ASSERT_LE(off, error + rounding)
              << name << ", scale " << scale << ", error " << error << ", at " << way.transpose();
          if (error == 0.1) worst = std::max(worst, static_cast<double>(off));
        }
      }
      // Nodes stand for their triangles, where there are any.
      if (mesh.triangles.size() > 1) {
        EXPECT_GT(worst, 1e-6) << name;
      }
    }
  }
}

TEST(WindingNumbersOf, ClosedMeshesAreWhole) {
  const auto model = scenes::buildModel<kIOSd>(scenes::bumpyTorus(84000));
  const WindingTree tree(*model);
  EXPECT_NEAR(tree.at({1, 0, 0}), 1, 1e-3);
  EXPECT_NEAR(tree.at({0, 0, 0}), 0, 1e-3);
  EXPECT_NEAR(tree.at({1, 0, 0}, 0), 1, 1e-10);
  EXPECT_NEAR(tree.at({1e300, 0, 0}), 0, 1e-3);
}

TEST(WindingNumbersOf, BytesAreAsDocumented) {
  for (const int n : {1, 2, 8, 9, 17, 20, 50, 100, 1000, 20000}) {
    const auto model = scenes::buildModel<kIOSd>(scenes::randomSoup(n, 1, 1e-2, 1, 3));
    ASSERT_EQ(model->num_tris, n);
    EXPECT_LE(static_cast<double>(WindingTree(*model).bytes()), 34.0 * n + 600) << n;
  }
}

/// A node without area, about which there is nothing to lose, hides none of the others: however
/// near p is, where powers of its distance underflow.
TEST(WindingNumbersOf, NextToTrianglesThatArePoints) {
  Mesh mesh = scenes::uvSphere(1, 60, 120);
  const std::size_t center = mesh.vertices.size();
  mesh.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < 64; ++i) mesh.triangles.emplace_back(center, center, center);
  const auto model = scenes::buildModel<kIOSd>(mesh);
  const WindingTree tree(*model);
  for (const double off : {0.0, 1e-10, 1e-60, 1e-66, 1e-100, 1e-150, 1e-170, 1e-300, 5e-324}) {
    for (const double error : {0.0, 1e-9, 1e-6, 1e-3}) {
      EXPECT_NEAR(tree.at({off, 0, 0}, error), 1, error + 1e-9) << off << ", error " << error;
    }
  }
}

TEST(WindingNumbersOf, OtherModelsAndLaterStatesAreRefused) {
  const Mesh mesh = scenes::icosphere(1, 2);
  const auto model = scenes::buildModel<kIOSd>(mesh), other = scenes::buildModel<kIOSd>(mesh);
  const Modeld copy(*model);
  PointRequest request;
  const auto ask = [&](const Modeld& asked) { return signedDistance(asked, {0, 0, 0}, request); };
  for (const bool refit : {true, false}) {
    const WindingTree tree(*model);
    request.winding = &tree;
    EXPECT_TRUE(tree.isOf(*model));
    EXPECT_LT(ask(*model), 0);
    for (const Modeld* const another : {&std::as_const(*other), &copy}) {
      EXPECT_FALSE(tree.isOf(*another));
      EXPECT_THROW(ask(*another), std::invalid_argument);
      Eigen::VectorXd distances(2);
      EXPECT_THROW(signedDistances(*another, Eigen::Matrix3Xd::Zero(3, 2), distances, request),
                   std::invalid_argument);
    }
    model->beginReplaceModel();
    EXPECT_THROW(tree.at({0, 0, 0}), std::invalid_argument);
    model->replaceSubModel(transformed(mesh, 1, {5, 0, 0}).vertices);
    model->endReplaceModel(refit, refit);
    EXPECT_FALSE(tree.isOf(*model));
    EXPECT_THROW(tree.at({0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(ask(*model), std::invalid_argument);
    const WindingTree again(*model);
    EXPECT_NEAR(again.at({5, 0, 0}), 1, 1e-3);
    model->beginReplaceModel();
    model->replaceSubModel(mesh.vertices);
    model->endReplaceModel(refit, refit);
  }
}

TEST(WindingNumbersOf, ThePartInsideOnTheSurface) {
  const auto model = scenes::buildModel<kIOSd>(scenes::subdividedBox({2, 2, 2}, 4));
  const WindingTree tree(*model);
  EXPECT_NEAR(tree.at({0.3, 0.2, 1}, 0), 0.5, 1e-12);
  EXPECT_NEAR(tree.at({0.25, 1, 1}, 0), 0.25, 1e-12);
  EXPECT_NEAR(tree.at({1, 1, 1}, 0), 0.125, 1e-12);
  EXPECT_NEAR(tree.at({0.3, 0.2, std::nextafter(1.0, 2.0)}, 0), 0, 1e-12);
  EXPECT_NEAR(tree.at({0.3, 0.2, std::nextafter(1.0, 0.0)}, 0), 1, 1e-12);
}

TEST(WindingNumbersOf, BadArgumentsAreRefused) {
  const auto model = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  const WindingTree tree(*model);
  EXPECT_THROW(tree.at({0, kNaN, 0}), std::invalid_argument);
  EXPECT_THROW(tree.at({0, 0, kInfinity}), std::invalid_argument);
  EXPECT_THROW(tree.at({0, 0, 0}, -1), std::invalid_argument);
  EXPECT_THROW(tree.at({0, 0, 0}, kNaN), std::invalid_argument);
  const Modeld unfinished;
  EXPECT_THROW(WindingTree{unfinished}, std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
