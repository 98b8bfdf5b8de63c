// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models that can't be queried, at every entry point: one clear error each, no crash, no answer.

#include <gtest/gtest.h>

#include <fcl/geometry/octree/octree.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "coverage/shape_distance.h"
#include "fcl/expect_refused.h"
#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

using fcl::Transform3d;
using testing::expectRefused;
using testing::Vector3d;
using ModelPtr = std::shared_ptr<Modeld>;
using Geometry = fcl::CollisionGeometryd;

const Transform3d kHere = Transform3d::Identity();

// Each with what its message must say.
std::vector<std::pair<ModelPtr, std::string>> unusable() {
  const scenes::Mesh mesh = scenes::icosphere(1, 1);
  const auto good = [&] { return scenes::buildModel<kIOSd>(mesh); };
  std::vector<std::pair<ModelPtr, std::string>> models{{std::make_shared<Modeld>(), "empty"}};
  auto begun = std::make_shared<Modeld>();
  begun->beginModel();
  begun->addSubModel(mesh.vertices, mesh.triangles);
  models.emplace_back(begun, "begun");
  auto nothing = std::make_shared<Modeld>();
  nothing->beginModel();
  nothing->endModel();
  models.emplace_back(nothing, "begun");
  auto cloud = std::make_shared<Modeld>();
  cloud->beginModel();
  cloud->addSubModel(mesh.vertices);
  cloud->endModel();
  models.emplace_back(cloud, "point cloud");
  auto replacing = good();
  replacing->beginReplaceModel();
  replacing->replaceVertex(Vector3d::Zero());
  models.emplace_back(replacing, "replace");
  auto updating = good();
  updating->beginUpdateModel();
  models.emplace_back(updating, "update");
  auto grown = good();
  grown->beginUpdateModel();
  grown->updateSubModel(mesh.vertices);
  grown->endUpdateModel();
  grown->addTriangle(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ());
  models.emplace_back(grown, "geometry was added");
  return models;
}

// What a k-IOS model may meet.
std::map<std::string, std::shared_ptr<Geometry>> partners() {
  std::map<std::string, std::shared_ptr<Geometry>> others;
  for (const auto& [name, shape] : shapeCases<double>()) others[name] = shape.geometry;
  others["mesh"] = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  const auto tree = std::make_shared<octomap::OcTree>(0.25);
  tree->updateNode(octomap::point3d(0.1f, 0.1f, 0.1f), true);
  others["octree"] = std::make_shared<fcl::OcTreed>(tree);
  return others;
}

class Unusable : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::internal::CaptureStderr(); }  // FCL's warnings
  void TearDown() override { ::testing::internal::GetCapturedStderr(); }

  // Both orders, with and without a solver, geometries and objects.
  template <typename Check>
  static void inBothOrders(const ModelPtr& model, const Check& check) {
    for (const auto& [name, other] : partners()) {
      SCOPED_TRACE(name);
      check(model, other);
      check(other, model);
    }
  }
};

TEST_F(Unusable, Collide) {
  const fcl::detail::GJKSolver_indep<double> indep;
  const fcl::detail::GJKSolver_libccd<double> libccd;
  for (const auto& [model, part] : unusable()) {
    inBothOrders(model, [&, &part = part](const std::shared_ptr<Geometry>& first,
                                          const std::shared_ptr<Geometry>& second) {
      const Geometry *a = first.get(), *b = second.get();
      const fcl::CollisionObjectd o1(first), o2(second);
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      expectRefused([&] { fcl::collide(a, kHere, b, kHere, request, result); }, part);
      expectRefused([&] { fcl::collide(&o1, &o2, request, result); }, part);
      expectRefused([&] { fcl::collide(a, kHere, b, kHere, &indep, request, result); }, part);
      expectRefused([&] { fcl::collide(&o1, &o2, &libccd, request, result); }, part);
      EXPECT_EQ(result.numContacts(), 0u);
    });
  }
}

TEST_F(Unusable, Distance) {
  const fcl::detail::GJKSolver_indep<double> indep;
  const fcl::detail::GJKSolver_libccd<double> libccd;
  for (const auto& [model, part] : unusable()) {
    inBothOrders(model, [&, &part = part](const std::shared_ptr<Geometry>& first,
                                          const std::shared_ptr<Geometry>& second) {
      const Geometry *a = first.get(), *b = second.get();
      const fcl::CollisionObjectd o1(first), o2(second);
      const fcl::DistanceRequestd request(true, true);
      fcl::DistanceResultd result;
      expectRefused([&] { fcl::distance(a, kHere, b, kHere, request, result); }, part);
      expectRefused([&] { fcl::distance(&o1, &o2, request, result); }, part);
      expectRefused([&] { fcl::distance(a, kHere, b, kHere, &libccd, request, result); }, part);
      expectRefused([&] { fcl::distance(&o1, &o2, &indep, request, result); }, part);
      EXPECT_EQ(result.o1, nullptr);
    });
  }
}

TEST_F(Unusable, ContinuousCollide) {
  const ModelPtr good = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  const Transform3d there(Eigen::Translation3d(1, 0, 0));
  for (const auto& [model, part] : unusable()) {
    for (const auto& [first, second] : {std::pair(model, good), std::pair(good, model)}) {
      const Geometry *a = first.get(), *b = second.get();
      const fcl::CollisionObjectd o1(first), o2(second);
      const auto motion = std::make_shared<fcl::TranslationMotiond>(kHere, there);
      const fcl::ContinuousCollisionObjectd m1(first, motion), m2(second, motion);
      for (const auto solver : {fcl::CCDC_NAIVE, fcl::CCDC_CONSERVATIVE_ADVANCEMENT,
                                fcl::CCDC_RAY_SHOOTING, fcl::CCDC_POLYNOMIAL_SOLVER}) {
        fcl::ContinuousCollisionRequestd request;
        request.ccd_solver_type = solver;
        fcl::ContinuousCollisionResultd result;
        expectRefused(
            [&] { fcl::continuousCollide(a, motion.get(), b, motion.get(), request, result); },
            part);
        expectRefused(
            [&] { fcl::continuousCollide(a, kHere, there, b, kHere, there, request, result); },
            part);
        expectRefused([&] { fcl::continuousCollide(&o1, there, &o2, there, request, result); },
                      part);
        expectRefused([&] { fcl::collide(&m1, &m2, request, result); }, part);
        EXPECT_FALSE(result.is_collide);
      }
    }
  }
}

TEST_F(Unusable, NodesOfOurs) {
  const ModelPtr good = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  for (const auto& [model, part] : unusable()) {
    for (const auto& [first, second] :
         {std::pair(model, good), std::pair(good, model), std::pair(model, model)}) {
      const Modeld &a = *first, &b = *second;
      MeshCollisionTraversalNode<double> collision;
      MeshDistanceTraversalNode<double> distance;
      fcl::CollisionResultd contacts;
      fcl::DistanceResultd nearest;
      expectRefused(
          [&] { initialize(collision, a, kHere, b, kHere, fcl::CollisionRequestd(), contacts); },
          part);
      expectRefused(
          [&] { initialize(distance, a, kHere, b, kHere, fcl::DistanceRequestd(), nearest); },
          part);
    }
    expectRefused([&, &m = model] { prepare(*m); }, part);
    expectRefused([&, &m = model] { validate(*m); }, part);
    expectRefused([&, &m = model] { toKIOS(*m); }, part);
  }
}

// A manager asks about pairs whose boxes meet: then it throws. A model without a vertex has no box
// and meets nothing.
TEST_F(Unusable, Managers) {
  const ModelPtr good = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  for (const auto& [model, part] : unusable()) {
    if (model->num_vertices == 0) continue;
    fcl::CollisionObjectd bad(model), fine(good);
    for (const auto& [name, make] : testing::managers()) {
      SCOPED_TRACE(name + ", " + part);
      fcl::DefaultCollisionData<double> contacts;
      fcl::DefaultDistanceData<double> distance;
      const auto collide = fcl::DefaultCollisionFunction<double>;
      const auto nearest = fcl::DefaultDistanceFunction<double>;
      const auto both = testing::filled(make, {&bad, &fine});
      const auto left = testing::filled(make, {&bad}), right = testing::filled(make, {&fine});
      expectRefused([&] { both->collide(&contacts, collide); }, part);
      expectRefused([&] { both->distance(&distance, nearest); }, part);
      expectRefused([&] { left->collide(right.get(), &contacts, collide); }, part);
      expectRefused([&] { left->distance(right.get(), &distance, nearest); }, part);
      expectRefused([&] { right->collide(&bad, &contacts, collide); }, part);
      expectRefused([&] { right->distance(&bad, &distance, nearest); }, part);
    }
  }
}

TEST_F(Unusable, ManagersWithModelsWithoutVertices) {
  const ModelPtr good = scenes::buildModel<kIOSd>(scenes::icosphere(1, 1));
  for (const auto& [model, part] : unusable()) {
    if (model->num_vertices > 0) continue;
    fcl::CollisionObjectd bad(model), fine(good);
    for (const auto& [name, make] : testing::managers()) {
      SCOPED_TRACE(name);
      const auto both = testing::filled(make, {&bad, &fine});
      fcl::DefaultCollisionData<double> contacts;
      try {
        both->collide(&contacts, fcl::DefaultCollisionFunction<double>);
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos);
      }
      EXPECT_FALSE(contacts.result.isCollision());
    }
  }
}

}  // namespace
}  // namespace kios::coverage
