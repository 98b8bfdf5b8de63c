// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models of points: every query answers for them as brute force over the points does.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fcl/expect_refused.h"
#include "fcl_kios/fcl_kios.h"
#include "model/bvh_check.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "shapes.h"

namespace kios::testing {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Mesh;
using scenes::Random;

std::vector<Vector3d> points(Random& random, int n, double size) {
  std::vector<Vector3d> all;
  for (int i = 0; i < n; ++i) {
    all.push_back(size * inCube(random));
    if (i % 7 == 3) all.back() = all[static_cast<std::size_t>(i) / 2];  // twice
  }
  return all;
}

template <typename S>
std::shared_ptr<Model<S>> byFcl(const std::vector<fcl::Vector3<S>>& all) {
  auto model = std::make_shared<Model<S>>();
  EXPECT_EQ(model->beginModel(), fcl::BVH_OK);
  for (const auto& p : all) EXPECT_EQ(model->addVertex(p), fcl::BVH_OK);
  EXPECT_EQ(model->endModel(), fcl::BVH_OK);
  return model;
}

double distanceOf(const fcl::CollisionGeometryd& a, const Transform3d& X_WA,
                  const fcl::CollisionGeometryd& b, const Transform3d& X_WB,
                  fcl::DistanceResultd& result) {
  return fcl::distance(&a, X_WA, &b, X_WB, fcl::DistanceRequestd(true), result);
}

TEST(PointClouds, AnswerAsTheirPoints) {
  Random random(3);
  for (const double size : {1.0, 1e-300, 1e100}) {
    Mesh ball = scenes::icosphere(0.5, 2);
    for (Vector3d& p : ball.vertices) p *= size;
    const auto mesh = makeModel(ball.vertices, ball.triangles);
    for (const int n : {1, 2, 3, 9, 200}) {
      const std::vector<Vector3d> all = points(random, n, size);
      const auto cloud = makePointCloud(all), other = byFcl(points(random, 50, size));
      ASSERT_EQ(cloud->num_tris, n);
      const auto poses = scenes::randomPoses(2, size, static_cast<std::uint64_t>(n));
      const Transform3d &X = poses[0], &Y = poses[1];
      const Vector3d middle = Vector3d::Zero();
      // The mesh: by points.h, which finds the nearest of its triangles for a point.
      double least = std::numeric_limits<double>::infinity(), near = least;
      for (const Vector3d& p : all) {
        least = std::min(least, nearestPoint(*mesh, Y.inverse() * (X * p)).distance);
        for (int i = 0; i < other->num_vertices; ++i) {
          near = std::min(near, (X * p - Y * other->vertices[i]).stableNorm());
        }
      }
      fcl::DistanceResultd result;
      EXPECT_NEAR(distanceOf(*cloud, X, *mesh, Y, result), least, 1e-13 * size);
      ASSERT_TRUE(result.b1 >= 0 && result.b1 < n);
      EXPECT_LT(
          (X * all[static_cast<std::size_t>(result.b1)] - result.nearest_points[0]).stableNorm(),
          1e-12 * size);
      result.clear();
      EXPECT_NEAR(distanceOf(*cloud, X, *other, Y, result), near, 1e-13 * size);
      EXPECT_NEAR(distanceBracket(*cloud, X, *mesh, Y, DistanceBracketRequestd()).distance, least,
                  1e-13 * size);
      EXPECT_TRUE(closerThan(*cloud, X, *mesh, Y, least * (1 + 1e-9) + 1e-12 * size));
      EXPECT_FALSE(closerThan(*cloud, X, *mesh, Y, least * (1 - 1e-9) - 1e-12 * size));
      EXPECT_NEAR(nearestPoint(*cloud, middle).distance,
                  (*std::min_element(all.begin(), all.end(),
                                     [](const auto& a, const auto& b) {
                                       return a.stableNorm() < b.stableNorm();
                                     }))
                      .stableNorm(),
                  1e-13 * size);
      // A shape; a ball that reaches the nearest point and hardly more.
      if (size != 1.0) continue;
      const fcl::Sphered reaches(nearestPoint(*cloud, middle).distance + 1e-9),
          misses(nearestPoint(*cloud, middle).distance - 1e-9);
      fcl::CollisionResultd contacts;
      const fcl::CollisionRequestd request(10, false);
      EXPECT_GT(fcl::collide(cloud.get(), X, &reaches, X, request, contacts), 0U);
      contacts.clear();
      EXPECT_EQ(fcl::collide(cloud.get(), X, &misses, X, request, contacts), 0U);
    }
  }
}

// Up to more points than a block of the build takes: some are alike, and many lie in one plane.
TEST(PointClouds, HaveVolumesAroundTheirPoints) {
  Random random(9);
  for (const int n : {1, 2, 3, 5, 8, 40, 5000}) {
    std::vector<Vector3d> all = points(random, n, 1);
    for (int i = 0; i < n; i += 3) all[static_cast<std::size_t>(i)][2] = 0.25;
    for (Vector3d& p : all) p += Vector3d(1e6, -1e5, 0);
    const auto cloud = makePointCloud(all);
    expectValidTree(*cloud);
    std::vector<fcl::Vector3f> in_float;
    for (const Vector3d& p : all) in_float.emplace_back(p.cast<float>());
    expectValidTree(*byFcl(in_float));
    for (int i = 0; i < cloud->getNumBVs(); ++i) {
      const auto& node = cloud->getBV(i);
      if (!node.isLeaf()) continue;
      EXPECT_EQ(node.bv.center(), all[static_cast<std::size_t>(node.primitiveId())]);
      EXPECT_EQ(node.bv.size(), 0);
    }
  }
}

// Points on a face or a corner touch it; beside it they don't.
TEST(PointClouds, TouchExactly) {
  const auto wall = makeModel<double>({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  const Transform3d I = Transform3d::Identity();
  const auto touches = [&](const Vector3d& p) {
    fcl::CollisionResultd result;
    const auto cloud = makePointCloud<double>({{9, 9, 9}, p, {-7, 3, 1}});
    const bool meets =
        fcl::collide(cloud.get(), I, wall.get(), I, fcl::CollisionRequestd(9, true), result) > 0;
    if (meets) {
      EXPECT_EQ(result.getContact(0).b1, 1);
    }
    return meets;
  };
  EXPECT_TRUE(touches({1, 1, 0}));
  EXPECT_TRUE(touches({4, 0, 0}));
  EXPECT_TRUE(touches({2, 2, 0}));
  EXPECT_FALSE(touches({2, std::nextafter(2.0, 3.0), 0}));
  EXPECT_FALSE(touches({1, 1, 1e-300}));
  fcl::CollisionResultd result;
  const auto cloud = makePointCloud<double>({{1, 2, 3}, {4, 5, 6}, {1, 2, 3}});
  EXPECT_EQ(fcl::collide(cloud.get(), I, cloud.get(), I, fcl::CollisionRequestd(99, false), result),
            5U);
}

TEST(PointClouds, MoveAndGrowByFclsCalls) {
  Random random(5);
  std::vector<Vector3d> all = points(random, 60, 1);
  const auto model = byFcl(all);
  const auto expectAnswers = [&](const Modeld& of) {
    for (int i = 0; i < 20; ++i) {
      const Vector3d p = points(random, 1, 2)[0];
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3d& x : all) least = std::min(least, (x - p).stableNorm());
      EXPECT_NEAR(nearestPoint(of, p).distance, least, 1e-14);
    }
  };
  expectAnswers(*model);
  const Modeld copy = *model;
  const std::vector<Vector3d> before = all;
  all = points(random, 60, 3);
  ASSERT_EQ(model->beginReplaceModel(), fcl::BVH_OK);
  ASSERT_EQ(model->replaceSubModel(all), fcl::BVH_OK);
  ASSERT_EQ(model->endReplaceModel(), fcl::BVH_OK);
  expectAnswers(*model);
  all = points(random, 60, 1);
  ASSERT_EQ(model->beginUpdateModel(), fcl::BVH_OK);
  ASSERT_EQ(model->updateSubModel(all), fcl::BVH_OK);
  ASSERT_EQ(model->endUpdateModel(), fcl::BVH_OK);
  expectAnswers(*model);
  // What is added after an update.
  const std::vector<Vector3d> more = points(random, 30, 2);
  ASSERT_EQ(model->addSubModel(more), fcl::BVH_OK);
  expectRefused([&] { nearestPoint(*model, Vector3d::Zero()); }, "geometry was added");
  all.insert(all.end(), more.begin(), more.end());
  ASSERT_EQ(model->beginUpdateModel(), fcl::BVH_OK);
  ASSERT_EQ(model->updateSubModel(all), fcl::BVH_OK);
  ASSERT_EQ(model->endUpdateModel(), fcl::BVH_OK);
  ASSERT_EQ(model->num_tris, 90);
  expectAnswers(*model);
  all = before;
  expectAnswers(copy);
}

TEST(PointClouds, RefuseWhatDoesNotFit) {
  expectRefused([] { makePointCloud<double>({}); }, "at least one point");
  expectRefused([] { makePointCloud<float>({{0, 0, std::nanf("")}}); }, "vertex 0");
  Random random(5);
  const auto cloud = makePointCloud(points(random, 40, 1));
  expectRefused([&] { markSolid(*cloud); }, "no solid");
  expectRefused([&] { contains(*cloud, Transform3d::Identity(), Vector3d::Zero()); }, "solid");
  const std::vector<Vector3d> corners(cloud->vertices, cloud->vertices + 40);
  const std::vector<fcl::Triangle> triangles(cloud->tri_indices, cloud->tri_indices + 40);
  EXPECT_TRUE(repair(corners, triangles).triangles.empty());
  EXPECT_FALSE(inspectClosedness(*cloud).isSolid());
  fcl::BVHModel<fcl::OBBRSSd> foreign;
  foreign.beginModel();
  foreign.addSubModel(points(random, 40, 1));
  foreign.endModel();
  EXPECT_EQ(toKIOS(foreign)->num_tris, 40);
}

}  // namespace
}  // namespace kios::testing
