// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Poses that aren't rigid and arrays that make no model are refused with a clear message.

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include <fcl/geometry/octree/octree.h>

#include "fcl/expect_refused.h"
#include "fcl/mesh_cases.h"
#include "not_finite.h"

namespace kios::testing {
namespace {

class Refused : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::internal::CaptureStderr(); }  // FCL's warnings
  void TearDown() override { ::testing::internal::GetCapturedStderr(); }

  const Transform3d here_ = Transform3d::Identity();
  const Mesh mesh_ = scenes::icosphere(1, 1);
  const std::shared_ptr<Modeld> good_ = kiosModel(mesh_);
};

TEST_F(Refused, PosesThatAreNotRigid) {
  std::vector<Transform3d> poses(5, here_);
  poses[0].linear() *= 1.01;
  poses[1].linear()(0, 1) = 0.01;
  poses[2].linear()(2, 2) = kNaN;
  poses[4].linear().setZero();
  // Each must be rigid by itself: distances would be right here, points and normals would not.
  Transform3d half = here_;
  half.linear() *= 0.5;
  poses[3].linear() *= 2;
  for (const Transform3d& bad : poses) {
    for (const auto& [X1, X2] :
         {std::pair(bad, here_), std::pair(here_, bad), std::pair(bad, half)}) {
      fcl::CollisionResultd contacts;
      fcl::DistanceResultd distance;
      expectRefused(
          [&, &X1 = X1, &X2 = X2] { fcl::collide(good_.get(), X1, good_.get(), X2, {}, contacts); },
          "");
      expectRefused(
          [&, &X1 = X1, &X2 = X2] {
            fcl::distance(good_.get(), X1, good_.get(), X2, fcl::DistanceRequestd(), distance);
          },
          "");
      EXPECT_EQ(contacts.numContacts(), 0u);
      EXPECT_EQ(distance.o1, nullptr);
    }
  }
}

// Also where the request is satisfied before anything is looked at.
TEST_F(Refused, TranslationThatIsNotFinite) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  fcl::CollisionRequestd none, one;
  none.num_max_contacts = 0;
  fcl::CollisionResultd touching;
  ASSERT_GT(fcl::collide(good_.get(), here_, good_.get(), here_, one, touching), 0u);
  fcl::DistanceResultd near;
  near.min_distance = 0;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinite, 1e308}) {
    Transform3d there = here_;
    there.translation()[1] = bad;
    for (const auto& [X1, X2] : {std::pair(here_, there), std::pair(there, here_)}) {
      const Transform3d &Y1 = X1, &Y2 = X2;
      const auto refusedBy = [&](const auto& request, auto result) {
        expectRefused(
            [&] {
              if constexpr (std::is_same_v<decltype(result), fcl::DistanceResultd>) {
                fcl::distance(good_.get(), Y1, good_.get(), Y2, request, result);
              } else {
                fcl::collide(good_.get(), Y1, good_.get(), Y2, request, result);
              }
            },
            "translation");
      };
      refusedBy(one, fcl::CollisionResultd());
      refusedBy(one, touching);
      refusedBy(none, fcl::CollisionResultd());
      refusedBy(fcl::DistanceRequestd(), fcl::DistanceResultd());
      refusedBy(fcl::DistanceRequestd(), near);
    }
  }
}

// A reflection would turn faces inside out: refused by every query, static or moving. Both poses
// reflected make a relative pose that is none.
template <typename S>
void expectReflectionsRefused(const Mesh& mesh) {
  using Pose = fcl::Transform3<S>;
  const auto model = scenes::buildModel<kIOS<S>>(mesh);
  const auto sphere = std::make_shared<fcl::Sphere<S>>(S(0.5));
  const auto cells = std::make_shared<octomap::OcTree>(0.1);
  cells->updateNode(octomap::point3d(0, 0, 0), true);
  const auto octree = std::make_shared<fcl::OcTree<S>>(cells);
  Pose proper = Pose::Identity();
  proper.translation().z() = 3;
  std::vector<Pose> mirrors(4, proper);
  mirrors[0].linear()(1, 1) = -1;
  mirrors[1].linear() = -mirrors[1].linear();
  mirrors[2].linear() = scenes::randomPoses(1, 1, 82)[0].linear().cast<S>() * mirrors[0].linear();
  mirrors[3].linear() << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  const std::string part = "not rigid: it is a reflection";
  for (const Pose& mirror : mirrors) {
    for (const auto& [X1, X2] :
         {std::pair(mirror, proper), std::pair(proper, mirror), std::pair(mirror, mirror)}) {
      const Pose &Y1 = X1, &Y2 = X2;
      fcl::CollisionResult<S> contacts;
      fcl::DistanceResult<S> result;
      const fcl::DistanceRequest<S> request;
      const std::vector<const fcl::CollisionGeometry<S>*> others{model.get(), sphere.get(),
                                                                 octree.get()};
      for (const auto* other : others) {
        expectRefused([&] { fcl::collide(model.get(), Y1, other, Y2, {}, contacts); }, part);
        expectRefused([&] { fcl::collide(other, Y1, model.get(), Y2, {}, contacts); }, part);
        expectRefused([&] { fcl::distance(model.get(), Y1, other, Y2, request, result); }, part);
        expectRefused([&] { fcl::distance(other, Y1, model.get(), Y2, request, result); }, part);
      }
      expectRefused([&] { kios::distanceBracket(*model, Y1, *model, Y2); }, part);
      expectRefused([&] { closerThan(*model, Y1, *model, Y2, S(1)); }, part);
      fcl::CollisionObject<S> o1(model, Y1), o2(model, Y2);
      ManagerQuery<S> query;
      S dist = 1;
      expectRefused([&] { ManagerQuery<S>::callback(&o1, &o2, &query, dist); }, part);
      EXPECT_EQ(contacts.numContacts(), 0u);
      EXPECT_EQ(result.o1, nullptr);
    }
    SceneDistance<S> scene;
    const int id = scene.add(model, proper);
    expectRefused([&] { scene.add(model, mirror); }, part);
    expectRefused([&] { scene.add(sphere, mirror); }, part);
    expectRefused([&] { scene.move(id, mirror); }, part);
    const Ray<S> ray{fcl::Vector3<S>::Zero(), fcl::Vector3<S>::UnitZ()};
    expectRefused([&] { firstHit(*model, mirror, ray); }, part);
    expectRefused([&] { anyHit(*model, mirror, ray); }, part);
    expectRefused([&] { allHits(*model, mirror, ray); }, part);
    expectRefused(
        [&] {
          RelativePose<S>(fcl::Matrix3<S>(mirror.linear()), fcl::Vector3<S>(mirror.translation()));
        },
        part);
    if constexpr (std::is_same_v<S, double>) {
      fcl::ContinuousCollisionRequestd request;
      fcl::ContinuousCollisionResultd result;
      for (const auto& [begin, end] :
           {std::pair(mirror, mirror), std::pair(proper, mirror), std::pair(mirror, proper)}) {
        const Pose &X_0 = begin, &X_1 = end;
        for (const fcl::CollisionGeometryd* other :
             {static_cast<const fcl::CollisionGeometryd*>(model.get()),
              static_cast<const fcl::CollisionGeometryd*>(sphere.get())}) {
          expectRefused(
              [&] {
                fcl::continuousCollide(model.get(), X_0, X_1, other, proper, proper, request,
                                       result);
              },
              part);
        }
      }
    }
  }
}

TEST_F(Refused, Reflections) {
  expectReflectionsRefused<double>(mesh_);
  expectReflectionsRefused<float>(mesh_);
}

TEST_F(Refused, MakeModelAndValidate) {
  EXPECT_NO_THROW(validate(*good_));
  EXPECT_NO_THROW(validate(*makeModel(mesh_.vertices, mesh_.triangles)));
  expectRefused([&] { makeModel<double>({}, {}); }, "at least one triangle");
  expectRefused([&] { makeModel(mesh_.vertices, {}); }, "at least one triangle");
  expectRefused(
      [&] {
        makeModel(mesh_.vertices, {{0, 1, mesh_.vertices.size()}});
      },
      "triangle 0 refers to vertex 42, but there are 42");
  expectRefused(
      [&] {
        makeModel(mesh_.vertices, {{0, 1, 2}, {0, std::size_t(-1), 2}});
      },
      "triangle 1 ");
  auto vertices = mesh_.vertices;
  vertices.emplace_back(0, kNaN, 0);  // no triangle uses it
  expectRefused([&] { makeModel(vertices, mesh_.triangles); }, "vertex 42 ");
  const auto unused = kiosModel({vertices, mesh_.triangles});
  expectRefused([&] { validate(*unused); }, "vertex 42 ");

  Modeld broken(*good_);
  broken.tri_indices[7] = fcl::Triangle(0, 1, 4000);
  expectRefused([&] { validate(broken); }, "triangle 7 refers to vertex 4000");
  std::vector<fcl::Vector3f> in_float(3, fcl::Vector3f::Zero());
  in_float[2][0] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(makeModel<float>(in_float, {{0, 1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
