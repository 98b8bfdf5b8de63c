// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>

#include "fcl/expect_refused.h"
#include "fcl/managers.h"
#include "solid/solid_meshes.h"
#include "together.h"

// fcl::collide, fcl::distance, FCL's managers and scenes with marked models.

namespace kios {
namespace {

using testing::at;
using testing::flipped;
using testing::kHere;
using testing::modelOf;
using testing::solidOf;

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

std::size_t collide(const Geometry& a, const fcl::Transform3d& X_WA, const Geometry& b,
                    const fcl::Transform3d& X_WB, fcl::CollisionResultd* out = nullptr) {
  fcl::CollisionRequestd request;
  request.enable_contact = out != nullptr;
  fcl::CollisionResultd unused;
  return fcl::collide(a.get(), X_WA, b.get(), X_WB, request, out ? *out : unused);
}

double distance(const Geometry& a, const fcl::Transform3d& X_WA, const Geometry& b,
                const fcl::Transform3d& X_WB, bool with_sign = false,
                fcl::DistanceResultd* out = nullptr) {
  const fcl::DistanceRequestd request(true, with_sign);
  fcl::DistanceResultd unused;
  return fcl::distance(a.get(), X_WA, b.get(), X_WB, request, out ? *out : unused);
}

TEST(SolidQueries, AMeshInAMeshIsInContactWithIt) {
  const auto big = solidOf(scenes::icosphere(2, 2)), small = solidOf(scenes::icosphere(0.5, 1));
  for (const auto& pair : {std::make_pair(big, small), std::make_pair(small, big)}) {
    fcl::CollisionResultd result;
    EXPECT_EQ(collide(pair.first, kHere, pair.second, at(0.6, 0, 0), &result), 1u);
    const fcl::Contactd& contact = result.getContact(0);
    EXPECT_EQ(contact.b1, -1);
    EXPECT_EQ(contact.b2, -1);
    EXPECT_EQ(contact.o1, pair.first.get());
    // The small ball leaves along x: 2 - 0.6 + 0.5, but for the facets.
    EXPECT_NEAR(contact.penetration_depth, 1.9, 0.1);
    EXPECT_NEAR(contact.normal[0], 1, 0.05);
    EXPECT_LE(contact.pos.norm(), 2);
    EXPECT_EQ(distance(pair.first, kHere, pair.second, at(0.6, 0, 0)), 0);
    EXPECT_EQ(collide(pair.first, kHere, pair.second, at(3, 0, 0)), 0u);
    EXPECT_GT(distance(pair.first, kHere, pair.second, at(3, 0, 0), true), 0.4);
  }
  // One that isn't marked is a soup still.
  EXPECT_EQ(collide(big, kHere, modelOf(scenes::icosphere(0.5, 1)), kHere), 0u);
  EXPECT_GT(distance(big, kHere, modelOf(scenes::icosphere(0.5, 1)), kHere, true), 1.3);
}

TEST(SolidQueries, ABallIsFreeInACavityAndInContactInTheWall) {
  const auto shell = solidOf(testing::shell(2, 1, 3));
  const auto ball = solidOf(scenes::icosphere(0.2, 1));
  EXPECT_EQ(collide(shell, kHere, ball, kHere), 0u);
  EXPECT_NEAR(distance(shell, kHere, ball, kHere, true), 0.8, 0.05);
  EXPECT_EQ(collide(shell, kHere, ball, at(1.5, 0, 0)), 1u);
  EXPECT_EQ(collide(ball, at(0, -1.5, 0), shell, kHere), 1u);
  EXPECT_EQ(collide(shell, kHere, ball, at(2.5, 0, 0)), 0u);
  const auto torus = solidOf(scenes::bumpyTorus(2000));
  EXPECT_EQ(collide(torus, kHere, ball, kHere), 0u);
  EXPECT_EQ(collide(torus, kHere, ball, at(1, 0, 0)), 1u);
  EXPECT_EQ(collide(torus, kHere, solidOf(scenes::icosphere(0.01, 1)), at(0, 1, 0)), 1u);
}

TEST(SolidQueries, AComponentInTheOtherSolidIsEnough) {
  const auto parts = solidOf(scenes::merged(
      {scenes::icosphere(0.3, 1), testing::transformed(scenes::icosphere(0.3, 1), 1, {5, 0, 0})}));
  const auto ball = solidOf(scenes::icosphere(1, 2));
  EXPECT_EQ(collide(parts, kHere, ball, kHere), 1u);
  EXPECT_EQ(collide(ball, at(5, 0, 0), parts, kHere), 1u);
  EXPECT_EQ(collide(parts, kHere, ball, at(2.5, 0, 0)), 0u);
}

// The gap is far below what the mapping into the other's frame rounds.
TEST(SolidQueries, TinyGapsAreDecidedInTheCommonFrame) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const auto outer =
        solidOf(testing::transformed(scenes::subdividedBox({2, 2, 2}, 2), scale, {0, 0, 0}));
    const auto cavity = solidOf(scenes::merged(
        {testing::transformed(scenes::subdividedBox({4, 4, 4}, 2), scale, {0, 0, 0}),
         testing::transformed(flipped(scenes::subdividedBox({2, 2, 2}, 2)), scale, {0, 0, 0})}));
    for (const double gap : {1e-9, 1e-14}) {
      const auto inner = solidOf(
          testing::transformed(scenes::subdividedBox({2, 2, 2}, 2), scale * (1 - gap), {0, 0, 0}));
      scenes::Random random(2);
      for (int i = 0; i < 20; ++i) {
        const fcl::Transform3d X = i == 0 ? kHere : testing::wholePose(random, scale);
        if (gap < 1e-12 && i > 0) continue;
        EXPECT_EQ(collide(outer, X, inner, X), 1u) << scale << " " << gap << " " << i;
        EXPECT_EQ(collide(inner, X, outer, X), 1u) << scale << " " << gap << " " << i;
        EXPECT_EQ(collide(cavity, X, inner, X), 0u) << scale << " " << gap << " " << i;
        EXPECT_EQ(collide(inner, X, cavity, X), 0u) << scale << " " << gap << " " << i;
      }
    }
  }
}

TEST(SolidQueries, AShapeInASolidIsInContactWithIt) {
  const auto shell = solidOf(testing::shell(2, 1, 3));
  std::vector<Geometry> shapes = {
      std::make_shared<fcl::Sphered>(0.2),       std::make_shared<fcl::Boxd>(0.3, 0.2, 0.1),
      std::make_shared<fcl::Capsuled>(0.1, 0.2), std::make_shared<fcl::Ellipsoidd>(0.1, 0.2, 0.3),
      std::make_shared<fcl::Coned>(0.2, 0.2),    std::make_shared<fcl::Cylinderd>(0.2, 0.2)};
  for (const Geometry& shape : shapes) {
    EXPECT_EQ(collide(shell, kHere, shape, kHere), 0u);
    fcl::CollisionResultd result;
    EXPECT_EQ(collide(shape, at(1.5, 0, 0), shell, kHere, &result), 1u);
    const fcl::Contactd& contact = result.getContact(0);
    EXPECT_EQ(contact.o1, shell.get());
    EXPECT_EQ(contact.b1, -1);
    EXPECT_GT(contact.penetration_depth, 0.4);
    EXPECT_LT(contact.penetration_depth, 0.95);
    fcl::Transform3d X = at(1.5, 0, 0);
    X.translation() += 1.0001 * contact.penetration_depth * contact.normal;
    EXPECT_EQ(collide(shape, X, shell, kHere), 0u);
    EXPECT_EQ(distance(shell, kHere, shape, at(1.5, 0, 0)), 0);
    EXPECT_LT(distance(shell, kHere, shape, at(1.5, 0, 0), true), -0.4);
    EXPECT_LT(distance(shell, kHere, shape, at(1.95, 0, 0), true), -0.05);  // surfaces meet
    EXPECT_EQ(distance(shell, kHere, shape, at(1.95, 0, 0)), 0);
    EXPECT_GT(distance(shell, kHere, shape, at(2.5, 0, 0), true), 0.1);
  }
  const Geometry ground = std::make_shared<fcl::Halfspaced>(fcl::Vector3d(0, 0, 1), -1.9);
  EXPECT_NEAR(distance(shell, kHere, ground, kHere, true), -0.1, 1e-9);
}

// Their normals are rounded on the way into the world and back.
TEST(SolidQueries, HalfspacesAndPlanesHaveADepthInAnyPose) {
  const auto box = solidOf(scenes::subdividedBox({2, 2, 2}, 2));
  const fcl::Vector3d n = fcl::Vector3d(1, 2, 3).normalized();
  const Geometry ground = std::make_shared<fcl::Halfspaced>(n, -0.9);
  const Geometry plane = std::make_shared<fcl::Planed>(n, 0.9);
  fcl::Transform3d X_BG = kHere;  // n is the box's z
  X_BG.linear() = Eigen::Quaterniond::FromTwoVectors(n, fcl::Vector3d::UnitZ()).matrix();
  scenes::Random random(5);
  for (int i = 0; i < 50; ++i) {
    const fcl::Vector3d axis = fcl::Vector3d(random.unit(), random.unit(), 0.1).normalized();
    fcl::Transform3d X = at(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
    X.linear() = Eigen::AngleAxisd(random.uniform(-3, 3), axis).matrix();
    EXPECT_NEAR(distance(box, X, ground, X * X_BG, true), -0.1, 1e-9);
    EXPECT_NEAR(distance(box, X, plane, X * X_BG, true), -0.1, 1e-9);
  }
}

TEST(SolidQueries, MarksStayThroughReplacesAndAreCopied) {
  const scenes::Mesh mesh = scenes::icosphere(2, 2);
  const auto big = solidOf(mesh), small = solidOf(scenes::icosphere(0.5, 1));
  const auto copy = std::make_shared<Modeld>(*big);
  EXPECT_TRUE(isSolid(*copy));
  unmarkSolid(*big);
  EXPECT_FALSE(isSolid(*big));
  EXPECT_TRUE(isSolid(*copy));
  EXPECT_EQ(collide(big, kHere, small, kHere), 0u);
  EXPECT_EQ(collide(copy, kHere, small, kHere), 1u);
  markSolid(*big);
  for (const bool bottomup : {true, false}) {
    std::vector<fcl::Vector3d> vertices = mesh.vertices;
    for (fcl::Vector3d& p : vertices) p *= 0.9;
    big->beginReplaceModel();
    big->replaceSubModel(vertices);
    big->endReplaceModel(true, bottomup);
    EXPECT_TRUE(isSolid(*big));
    EXPECT_EQ(collide(big, kHere, small, kHere), 1u);
  }
}

TEST(SolidQueries, AReplaceThatOpensTheMeshIsAnErrorAtTheQuery) {
  const scenes::Mesh mesh = scenes::soup(scenes::icosphere(2, 1));
  const auto big = solidOf(mesh), small = solidOf(scenes::icosphere(0.5, 1));
  EXPECT_EQ(collide(big, kHere, small, kHere), 1u);
  std::vector<fcl::Vector3d> vertices = mesh.vertices;
  vertices[7] *= 1.01;
  const auto replace = [&] {
    big->beginReplaceModel();
    big->replaceSubModel(vertices);
    big->endReplaceModel(true, true);
  };
  replace();
  EXPECT_FALSE(isSolid(*big));
  for (int i = 0; i < 2; ++i) {
    testing::expectRefused([&] { collide(big, kHere, small, kHere); },
                           "4 open edges; the first: triangle 2, (");
  }
  EXPECT_THROW(distance(small, kHere, big, kHere), std::invalid_argument);
  EXPECT_THROW(collide(big, kHere, std::make_shared<fcl::Sphered>(0.2), kHere),
               std::invalid_argument);
  EXPECT_THROW(contains<double>(*big, kHere, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(penetration<double>(*big, kHere, *small, kHere), std::invalid_argument);
  vertices[7] = mesh.vertices[7];
  replace();
  EXPECT_TRUE(isSolid(*big));
  EXPECT_EQ(collide(big, kHere, small, kHere), 1u);
  vertices[7] *= 1.01;
  replace();
  unmarkSolid(*big);
  EXPECT_EQ(collide(big, kHere, small, kHere), 0u);
}

// The first queries of a state examine it, and the first penetration measures its convexity.
TEST(SolidQueries, ManyThreadsMayAskFirst) {
  for (int round = 0; round < 5; ++round) {
    const auto big = solidOf(scenes::icosphere(2, 3)), small = solidOf(scenes::icosphere(0.5, 2));
    big->beginReplaceModel();
    big->replaceSubModel(scenes::icosphere(2, 3).vertices);
    big->endReplaceModel(true, true);
    std::atomic<int> wrong{0};
    testing::together(4, [&](int thread) {
      const fcl::Transform3d X = at(0.1 * thread, 0, 0);
      if (collide(big, kHere, small, X) != 1) ++wrong;
      if (!contains(*big, kHere, X.translation())) ++wrong;
      const PenetrationResult p = penetration(*big, kHere, *small, X);
      if (!(p.lower > 1 && p.upper <= 1.05 * p.lower)) ++wrong;
    });
    EXPECT_EQ(wrong, 0);
  }
}

/// A ball in a shell's wall and one outside, through each manager, and free when unmarked.
TEST(SolidQueries, ManagersAndScenesSeeContainment) {
  const auto shell = solidOf(testing::shell(2, 1, 2));
  const auto ball = solidOf(scenes::icosphere(0.2, 1));
  fcl::CollisionObjectd outer(shell, kHere), inner(ball, at(1.5, 0, 0)), other(ball, at(4, 0, 0));
  const testing::Objects objects = {&outer, &inner, &other};
  SceneDistanced scene;
  for (const auto* object : objects) scene.add(object);
  const auto expect = [&](bool contact) {
    for (const auto& [name, make] : testing::managers()) {
      const auto manager = testing::filled(make, objects);
      fcl::DefaultCollisionData<double> collision;
      manager->collide(&collision, fcl::DefaultCollisionFunction<double>);
      EXPECT_EQ(collision.result.isCollision(), contact) << name;
      fcl::DefaultDistanceData<double> nearest;
      manager->distance(&nearest, fcl::DefaultDistanceFunction<double>);
      EXPECT_EQ(nearest.result.min_distance == 0, contact) << name;
      ManagerQueryd query;
      manager->distance(&query, ManagerQueryd::callback);
      ASSERT_EQ(query.pairs().size(), 1u) << name;
      EXPECT_EQ(query.pairs()[0].distance == 0, contact) << name;
    }
    for (int i = 0; i < 2; ++i) {  // the second from what is remembered
      SceneRequest request;
      request.nearest_points = true;
      const auto closest = scene.closestPair(request);
      ASSERT_TRUE(closest.has_value());
      EXPECT_EQ(closest->distance == 0, contact);
      EXPECT_EQ(scene.pairsWithin(0).size(), contact ? 1u : 0u);
      EXPECT_EQ(scene.pairsWithin(0.01).size(), contact ? 1u : 0u);
      const auto all = scene.clearances(request);
      ASSERT_EQ(all.size(), 3u);
      EXPECT_EQ(all[0].distance == 0, contact);
      EXPECT_EQ(all[0].distance, distance(shell, kHere, ball, inner.getTransform()));
      if (contact) {
        EXPECT_EQ(all[0].triangle_a, -1);
        EXPECT_EQ(all[0].nearest_a, all[0].nearest_b);
      }
    }
  };
  expect(true);
  unmarkSolid(*shell);
  expect(false);
  markSolid(*shell);
  expect(true);
  inner.setTranslation({0, 0, 0});
  inner.computeAABB();
  expect(false);
  inner.setTranslation({0, 1.5, 0});
  inner.computeAABB();
  expect(true);
}

// Tesseract's and TrajOpt's contact normal: (min_distance * (p2 - p1)).normalized(), which is to
// point from object 1 to object 2; the gradient of the distance by object 2's position.
TEST(SolidQueries, SignedDistancesGiveOptimisersAGradient) {
  const auto a = solidOf(scenes::bumpyBlob()), b = solidOf(scenes::bumpyTorus(400));
  scenes::Random random(4);
  int overlapping = 0;
  for (int i = 0; i < 100; ++i) {
    const fcl::Transform3d X = testing::wholePose(random, 1.2);
    fcl::DistanceResultd result;
    const double d = distance(a, kHere, b, X, true, &result);
    EXPECT_EQ(d, result.min_distance);
    const fcl::Vector3d normal =
        (d * (result.nearest_points[1] - result.nearest_points[0])).normalized();
    ASSERT_NEAR(normal.norm(), 1, 1e-12);
    if (d > 0) continue;
    ++overlapping;
    EXPECT_NEAR((result.nearest_points[1] - result.nearest_points[0]).norm(), -d, 1e-12);
    // A step of the optimiser along the gradient parts the bodies.
    fcl::Transform3d moved = X;
    moved.translation() += -d * normal;
    EXPECT_GE(distance(a, kHere, b, moved, true), -1e-9);
    // After half of it the other half is a way out, than which no bound may be longer.
    moved = X;
    moved.translation() += -0.5 * d * normal;
    EXPECT_LE(penetration<double>(*a, kHere, *b, moved).lower, -0.5 * d + 1e-9);
    EXPECT_GT(distance(a, kHere, b, moved, true), d);
  }
  EXPECT_GT(overlapping, 40);
}

}  // namespace
}  // namespace kios
