// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models that can't be queried (bad vertices, unfinished) are refused at every entry
// point with one clear error: no crash, and results stay as they were.

#include <gtest/gtest.h>

#include <string>

#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "fcl/expect_refused.h"
#include "fcl/managers.h"
#include "fcl/partners.h"
#include "not_finite.h"

namespace kios::testing {
namespace {

class Unusable : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::internal::CaptureStderr(); }  // FCL's warnings
  void TearDown() override { ::testing::internal::GetCapturedStderr(); }

  // Every query with the model, in either place, refuses and leaves its result alone. Managers sort
  // boxes, so that they are only asked about finite ones.
  void expectUnusable(Modeld& model, const std::string& part, bool finite = true) const {
    SCOPED_TRACE(part);
    const std::shared_ptr<Modeld> bad(&model, [](Modeld*) {});
    for (const auto& [name, other] : partners_) {
      SCOPED_TRACE(name);
      expectStaticRefused(bad, other, part);
      expectStaticRefused(other, bad, part);
    }
    expectMovingRefused(bad, good_, part);
    expectMovingRefused(good_, bad, part);
    expectNodesRefuse(model, *good_, part);
    expectNodesRefuse(*good_, model, part);
    expectNodesRefuse(model, model, part);
    expectRefused([&] { prepare(model); }, part);
    expectRefused([&] { validate(model); }, part);
    expectRefused([&] { toKIOS(model); }, part);
    if (finite) expectManagersRefuse(bad, part);
  }

  // Geometries and objects, with and without a solver.
  void expectStaticRefused(const Geometry& first, const Geometry& second,
                           const std::string& part) const {
    const fcl::detail::GJKSolver_indep<double> indep;
    const fcl::detail::GJKSolver_libccd<double> libccd;
    const fcl::CollisionGeometryd *a = first.get(), *b = second.get();
    const fcl::CollisionObjectd o1(first), o2(second);
    const fcl::CollisionRequestd any, none(0);
    fcl::CollisionResultd contacts;
    expectRefused([&] { fcl::collide(a, here_, b, here_, any, contacts); }, part);
    expectRefused([&] { fcl::collide(a, here_, b, here_, none, contacts); }, part);
    expectRefused([&] { fcl::collide(&o1, &o2, any, contacts); }, part);
    expectRefused([&] { fcl::collide(a, here_, b, here_, &indep, any, contacts); }, part);
    expectRefused([&] { fcl::collide(&o1, &o2, &libccd, any, contacts); }, part);
    EXPECT_EQ(contacts.numContacts(), 0u);
    const fcl::DistanceRequestd request(true, true);
    fcl::DistanceResultd nearest;
    expectRefused([&] { fcl::distance(a, here_, b, here_, request, nearest); }, part);
    expectRefused([&] { fcl::distance(&o1, &o2, request, nearest); }, part);
    expectRefused([&] { fcl::distance(a, here_, b, here_, &libccd, request, nearest); }, part);
    expectRefused([&] { fcl::distance(&o1, &o2, &indep, request, nearest); }, part);
    EXPECT_EQ(nearest.o1, nullptr);
  }

  void expectMovingRefused(const Geometry& first, const Geometry& second,
                           const std::string& part) const {
    const Transform3d there(Eigen::Translation3d(1, 0, 0));
    const fcl::CollisionGeometryd *a = first.get(), *b = second.get();
    const fcl::CollisionObjectd o1(first), o2(second);
    const auto motion = std::make_shared<fcl::TranslationMotiond>(here_, there);
    const fcl::ContinuousCollisionObjectd m1(first, motion), m2(second, motion);
    for (const auto solver : {fcl::CCDC_NAIVE, fcl::CCDC_CONSERVATIVE_ADVANCEMENT,
                              fcl::CCDC_RAY_SHOOTING, fcl::CCDC_POLYNOMIAL_SOLVER}) {
      fcl::ContinuousCollisionRequestd request;
      request.ccd_solver_type = solver;
      fcl::ContinuousCollisionResultd result;
      expectRefused(
          [&] { fcl::continuousCollide(a, motion.get(), b, motion.get(), request, result); }, part);
      expectRefused(
          [&] { fcl::continuousCollide(a, here_, there, b, here_, there, request, result); }, part);
      expectRefused([&] { fcl::continuousCollide(&o1, there, &o2, there, request, result); }, part);
      expectRefused([&] { fcl::collide(&m1, &m2, request, result); }, part);
      EXPECT_FALSE(result.is_collide);
    }
  }

  void expectNodesRefuse(const Modeld& a, const Modeld& b, const std::string& part) const {
    MeshCollisionTraversalNode<double> collision;
    MeshDistanceTraversalNode<double> distance;
    fcl::CollisionResultd contacts;
    fcl::DistanceResultd nearest;
    expectRefused(
        [&] { initialize(collision, a, here_, b, here_, fcl::CollisionRequestd(), contacts); },
        part);
    expectRefused(
        [&] { initialize(distance, a, here_, b, here_, fcl::DistanceRequestd(), nearest); }, part);
  }

  // A manager asks about pairs whose boxes meet: then it throws. A model without a vertex has no
  // box and meets nothing.
  void expectManagersRefuse(const Geometry& model, const std::string& part) const {
    fcl::CollisionObjectd bad(model), fine(good_);
    const auto collide = fcl::DefaultCollisionFunction<double>;
    const auto nearest = fcl::DefaultDistanceFunction<double>;
    const bool has_box = static_cast<const Modeld&>(*model).num_vertices > 0;
    for (const auto& [name, make] : managers()) {
      SCOPED_TRACE(name);
      fcl::DefaultCollisionData<double> contacts;
      fcl::DefaultDistanceData<double> distance;
      const auto both = filled(make, {&bad, &fine});
      if (!has_box) {
        try {
          both->collide(&contacts, collide);
        } catch (const std::invalid_argument& error) {
          EXPECT_NE(std::string(error.what()).find(part), std::string::npos);
        }
        EXPECT_FALSE(contacts.result.isCollision());
        continue;
      }
      expectRefused([&] { both->collide(&contacts, collide); }, part);
      expectRefused([&] { both->distance(&distance, nearest); }, part);
    }
  }

  const Transform3d here_ = Transform3d::Identity();
  const Mesh mesh_ = scenes::icosphere(1, 1);
  const std::shared_ptr<Modeld> good_ = kiosModel(mesh_);
  const std::map<std::string, Geometry> partners_ = partners();
};

TEST_F(Unusable, BadVerticesAtBuild) {
  for (const double bad : {kNaN, kInfinity, -kInfinity, 0x1p1001}) {
    for (const std::size_t at : {std::size_t{0}, mesh_.vertices.size() - 1}) {
      Mesh mesh = mesh_;
      mesh.vertices[at][1] = bad;
      Modeld model;
      ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
      ASSERT_EQ(model.addSubModel(mesh.vertices, mesh.triangles), fcl::BVH_OK);
      expectRefused([&] { model.endModel(); }, "");
      EXPECT_EQ(model.build_state, fcl::BVH_BUILD_STATE_BEGUN);
      expectUnusable(model, "begun", false);
    }
  }
}

TEST_F(Unusable, BadVerticesAtReplaceAndUpdate) {
  std::vector<Vector3d> vertices = mesh_.vertices;
  for (const double bad : {kNaN, kInfinity}) {
    for (const bool refit : {false, true}) {
      for (const bool bottomup : {false, true}) {
        vertices[3][2] = bad;
        Modeld replaced(*good_), updated(*good_);
        ASSERT_EQ(replaced.beginReplaceModel(), fcl::BVH_OK);
        ASSERT_EQ(replaced.replaceSubModel(vertices), fcl::BVH_OK);
        EXPECT_THROW(replaced.endReplaceModel(refit, bottomup), std::invalid_argument);
        expectUnusable(replaced, "replace", false);
        ASSERT_EQ(updated.beginUpdateModel(), fcl::BVH_OK);
        ASSERT_EQ(updated.updateSubModel(vertices), fcl::BVH_OK);
        EXPECT_THROW(updated.endUpdateModel(refit, bottomup), std::invalid_argument);
        expectUnusable(updated, "update", false);
      }
    }
  }
  // A thread that met a bad model builds good ones as ever.
  fcl::DistanceResultd result;
  const auto fresh = kiosModel(mesh_);
  EXPECT_EQ(
      fcl::distance(fresh.get(), here_, good_.get(), Transform3d(Eigen::Translation3d(5, 0, 0)),
                    fcl::DistanceRequestd(), result),
      leafDistance(mesh_, mesh_, {here_, Transform3d(Eigen::Translation3d(5, 0, 0))}));
}

// The vertices are public: mend them, and end again.
TEST_F(Unusable, AModelThatFailedCanBeMended) {
  Modeld model(*good_);
  std::vector<Vector3d> vertices = mesh_.vertices;
  vertices[5][0] = kNaN;
  model.beginReplaceModel();
  model.replaceSubModel(vertices);
  EXPECT_THROW(model.endReplaceModel(), std::invalid_argument);
  model.vertices[5] = mesh_.vertices[5];
  EXPECT_EQ(model.endReplaceModel(), fcl::BVH_OK);
  EXPECT_NO_THROW(validate(model));
  model.beginUpdateModel();
  model.updateSubModel(vertices);
  EXPECT_THROW(model.endUpdateModel(false), std::invalid_argument);
  model.vertices[5] = mesh_.vertices[5];
  EXPECT_EQ(model.endUpdateModel(false), fcl::BVH_OK);
  EXPECT_NO_THROW(validate(model));
}

TEST_F(Unusable, UnfinishedModels) {
  Modeld fresh;
  expectUnusable(fresh, "empty");

  Modeld begun;
  begun.beginModel();
  expectUnusable(begun, "begun");
  begun.addSubModel(mesh_.vertices, mesh_.triangles);
  expectUnusable(begun, "begun");

  Modeld empty;
  empty.beginModel();
  EXPECT_EQ(empty.endModel(), fcl::BVH_ERR_BUILD_EMPTY_MODEL);
  expectUnusable(empty, "begun");

  // FCL segfaults here.
  Modeld reset(*good_);
  EXPECT_EQ(reset.beginModel(), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
  expectUnusable(reset, "empty");
  reset.addTriangle(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ());
  EXPECT_EQ(reset.endModel(), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
  expectUnusable(reset, "empty");

  Modeld replacing(*good_);
  replacing.beginReplaceModel();
  expectUnusable(replacing, "replace");
  replacing.replaceVertex(Vector3d::Zero());
  EXPECT_EQ(replacing.endReplaceModel(), fcl::BVH_ERR_INCORRECT_DATA);
  expectUnusable(replacing, "replace");

  Modeld updating(*good_);
  updating.beginUpdateModel();
  expectUnusable(updating, "update");
}

TEST_F(Unusable, TrianglesAddedAfterAnUpdate) {
  Modeld model(*good_);
  model.beginUpdateModel();
  model.updateSubModel(mesh_.vertices);
  ASSERT_EQ(model.endUpdateModel(), fcl::BVH_OK);
  EXPECT_NO_THROW(prepare(model));
  ASSERT_EQ(model.addTriangle(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()),
            fcl::BVH_OK);
  expectUnusable(model, "geometry was added");
  expectRefused([&] { prepare(model); }, "triangles but a tree of");
}

}  // namespace
}  // namespace kios::testing
