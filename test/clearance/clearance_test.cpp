// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Clearance over a level of two trees: bounds of the meshes' distance, the gap of the smooth
// minimum, and which of the two has a continuous gradient.
#include "fcl_kios/clearance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "fcl_kios/fcl_kios.h"
#include "scalars.h"
#include "scenes/mesh.h"
#include "scenes/oracle.h"
#include "scenes/shapes.h"
#include "volume/point_sets.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(ClearanceOf);

TYPED_TEST(ClearanceOf, BoundsTheDistanceOfTheMeshes) {
  using S = TypeParam;
  Random random(41);
  const scenes::Mesh mesh_a = scenes::bumpyTorus(300), mesh_b = scenes::bumpyBlob();
  const auto a = scenes::buildModel<kIOS<S>>(mesh_a), b = scenes::buildModel<kIOS<S>>(mesh_b);
  const scenes::MeshOracle oracle(mesh_a, mesh_b);
  double total[7] = {};
  for (const int level : {0, 1, 3, 6}) {
    const Cover<S> cover_a(*a, level), cover_b(*b, level);
    ASSERT_LE(cover_a.size(), 1 << level);
    ASSERT_GT(cover_a.size(), (1 << level) / 2);
    Random poses(42);
    for (int i = 0; i < 25; ++i) {
      fcl::Transform3d X = fcl::Transform3d::Identity();
      X.linear() = randomRotation(poses);
      X.translation() = poses.uniform(1.5, 4) * randomDirection(poses);
      const RelativePose<S> pose(X.linear().template cast<S>(), X.translation().template cast<S>());
      const double truth = oracle.distance(fcl::Transform3d::Identity(), X);
      const Clearance plain = minimumClearance(cover_a, cover_b, pose);
      constexpr double kRounding = sizeof(S) == sizeof(double) ? 1e-13 : 1e-5;
      ASSERT_LE(plain.value, truth + kRounding) << "level " << level << ", pose " << i;
      ASSERT_EQ(plain.pairs, cover_a.size() * cover_b.size());
      // Brute force over the pairs.
      double least = std::numeric_limits<double>::infinity();
      long double sums[3] = {};
      const double betas[3] = {1, 20, 400};
      for (int p = 0; p < cover_a.size(); ++p) {
        for (int q = 0; q < cover_b.size(); ++q) {
          const double d = exactDistance(cover_a.volume(p), cover_b.volume(q), pose).distance;
          least = std::min(least, d);
          for (int k = 0; k < 3; ++k) sums[k] += std::exp(-static_cast<long double>(betas[k]) * d);
        }
        if (level == 6) break;  // 4096 pairs: the contract only
      }
      if (level < 6) {
        ASSERT_EQ(plain.value, least);
      }
      for (int k = 0; k < 3; ++k) {
        const Clearance smooth = smoothClearance(cover_a, cover_b, pose, betas[k]);
        ASSERT_LE(smooth.value, plain.value);
        ASSERT_GE(smooth.value, plain.value - std::log(plain.pairs) / betas[k] - 1e-14);
        ASSERT_LE(smooth.by_translation.norm(), 1 + 1e-14);
        if (level < 6) {
          ASSERT_NEAR(smooth.value, static_cast<double>(-std::log(sums[k]) / betas[k]), 1e-13);
        }
      }
      total[level] += plain.value;
    }
  }
  EXPECT_LT(total[0], total[3]);  // the halves of a torus are not tighter than the whole
  EXPECT_LT(total[3], total[6]);
}

TEST(Clearance, GradientOfTheSmoothMinimum) {
  const auto a = scenes::buildModel<kIOSd>(scenes::bumpyTorus(200));
  const auto b = scenes::buildModel<kIOSd>(scenes::subdividedBox({1, 0.6, 0.3}, 3));
  const Cover<double> cover_a(*a, 4), cover_b(*b, 3);
  Random random(43);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const fcl::Matrix3d R = randomRotation(random);
    const fcl::Vector3d T = random.uniform(1.8, 3) * randomDirection(random);
    const auto at = [&](const fcl::Matrix3d& rotation, const fcl::Vector3d& translation) {
      return smoothClearance(cover_a, cover_b, RelativePose<double>(rotation, translation), 30);
    };
    if (!(minimumClearance(cover_a, cover_b, RelativePose<double>(R, T)).value > 0.05)) continue;
    const Clearance smooth = at(R, T);
    constexpr double kStep = 1e-6;
    for (int c = 0; c < 3; ++c) {
      const fcl::Vector3d h = kStep * fcl::Vector3d::Unit(c);
      const double by_t = at(R, T + h).value - at(R, T - h).value;
      const double by_w = at(turned(h, R), T).value - at(turned(-h, R), T).value;
      ASSERT_NEAR(by_t / (2 * kStep), smooth.by_translation[c], 2e-5) << i;
      ASSERT_NEAR(by_w / (2 * kStep), smooth.by_rotation[c], 2e-5) << i;
    }
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

TEST(Clearance, RefusesWhatItCannotCover) {
  Modeld unfinished;
  EXPECT_THROW(Cover<double>(unfinished, 0), std::invalid_argument);
  const auto model = scenes::buildModel<kIOSd>(scenes::bumpyTorus(100));
  EXPECT_THROW(Cover<double>(*model, -1), std::invalid_argument);
  EXPECT_THROW(Cover<double>(std::vector<kIOSd>{}), std::invalid_argument);
  EXPECT_THROW(Cover<double>(std::vector<kIOSd>(2)), std::invalid_argument);
  const Cover<double> cover(*model, 40);  // deeper than the tree: its leaves
  EXPECT_EQ(cover.size(), model->getNumBVs() / 2 + 1);
  const RelativePose<double> X(fcl::Matrix3d::Identity(), {5, 0, 0});
  for (const double beta : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(smoothClearance(cover, cover, X, beta), std::invalid_argument);
  }
}

// Triangles as long as the bodies: no level of the tree tells anything of the gap.
TYPED_TEST(ClearanceOf, CoversOfSizeSeeGapsBesideLongTriangles) {
  using S = TypeParam;
  const scenes::Mesh link = scenes::subdividedBox({1, 0.05, 0.05}, 1);
  const auto a = scenes::buildModel<kIOS<S>>(link), b = scenes::buildModel<kIOS<S>>(link);
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = turned({0.3, 0.1, 0.2}, fcl::Matrix3d::Identity());
  X.translation() = fcl::Vector3d(0.1, 0.02, 0.2);
  const scenes::MeshOracle oracle(link, link);
  const double truth = oracle.distance(fcl::Transform3d::Identity(), X);
  ASSERT_GT(truth, 0.05);
  const auto clearance = [&](const Cover<S>& cover_a, const Cover<S>& cover_b,
                             const fcl::Transform3d& pose) {
    return minimumClearance(
        cover_a, cover_b,
        RelativePose<S>(pose.linear().template cast<S>(), pose.translation().template cast<S>()));
  };
  EXPECT_EQ(clearance(Cover<S>(*a, 20), Cover<S>(*b, 20), X).value, 0);
  for (const double size : {0.04, 0.02}) {
    const auto cover_a = Cover<S>::ofSize(*a, size), cover_b = Cover<S>::ofSize(*b, size);
    for (int i = 0; i < cover_a.size(); ++i) {
      ASSERT_LE(2 * double{cover_a.volume(i).radius0}, size);
    }
    const Clearance found = clearance(cover_a, cover_b, X);
    EXPECT_LE(found.value, truth + 1e-6);
    EXPECT_GE(found.value, truth - 2 * size);
    EXPECT_NEAR(found.by_translation.norm(), 1, 1e-5);
    fcl::Transform3d moved = X;
    moved.translation() += 0.01 * found.by_translation;
    EXPECT_GT(clearance(cover_a, cover_b, moved).value, found.value + 0.005);
  }
  // The whole surface is covered: no point of it is outside of all volumes.
  const auto cover = Cover<S>::ofSize(*a, 0.03);
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const fcl::Triangle& t = a->tri_indices[i % a->num_tris];
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const fcl::Vector3<S>&p = a->vertices[t[0]], &q = a->vertices[t[1]], &r = a->vertices[t[2]];
    const fcl::Vector3<S> x = p + S(u) * (q - p) + S(v) * (r - p);
    int inside = 0;
    for (int j = 0; j < cover.size(); ++j) inside += cover.volume(j).contain(x) ? 1 : 0;
    ASSERT_GT(inside, 0) << x.transpose();
  }
  EXPECT_THROW(Cover<S>::ofSize(*a, 0), std::invalid_argument);
  EXPECT_THROW(Cover<S>::ofSize(*a, std::nan("")), std::invalid_argument);
  EXPECT_THROW(Cover<S>::ofSize(*a, 1e-9), std::invalid_argument);
  EXPECT_THROW(Cover<S>::ofSize(Model<S>(), 1), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
