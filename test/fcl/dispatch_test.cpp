// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that reach kIOS: every way to write a query, every kind of other object.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include <fcl/math/motion/translation_motion.h>

#include "fcl/expect_refused.h"
#include "fcl/partners.h"

namespace kios::testing {
namespace {

const Transform3d kHere = Transform3d::Identity();
const Transform3d kThere(Eigen::Translation3d(0.5, 0.25, 0.125));

class Dispatch : public ::testing::Test {
 protected:
  const Mesh ball_ = scenes::icosphere(1, 1);
  const std::shared_ptr<Modeld> model_ = kiosModel(ball_);
};

TEST_F(Dispatch, QualifiedUnqualifiedAndCallbackCallsMeetOurOverloads) {
  fcl::CollisionObjectd a(model_, kHere), b(model_, kThere);
  const fcl::CollisionRequestd request;
  const fcl::DistanceRequestd distance_request;
  fcl::CollisionResultd c1, c2, c3, c4;
  EXPECT_EQ(fcl::collide(&a, &b, request, c1), 1u);
  EXPECT_EQ(collide(&a, &b, request, c2), 1u);  // by argument-dependent lookup
  EXPECT_EQ(fcl::collide(model_.get(), kHere, model_.get(), kThere, request, c3), 1u);
  const fcl::CollisionGeometryd* geometry = model_.get();
  EXPECT_EQ(collide(geometry, kHere, geometry, kThere, request, c4), 1u);
  fcl::DistanceResultd d1, d2, d3, d4;
  EXPECT_EQ(fcl::distance(&a, &b, distance_request, d1), 0);
  EXPECT_EQ(distance(&a, &b, distance_request, d2), 0);
  EXPECT_EQ(fcl::distance(model_.get(), kHere, model_.get(), kThere, distance_request, d3), 0);
  EXPECT_EQ(distance(geometry, kHere, geometry, kThere, distance_request, d4), 0);

  fcl::DefaultCollisionData<double> collision_data;
  EXPECT_TRUE(fcl::DefaultCollisionFunction(&a, &b, &collision_data));
  EXPECT_TRUE(collision_data.result.isCollision());
  fcl::DefaultDistanceData<double> distance_data;
  double d = -1;
  EXPECT_TRUE(fcl::DefaultDistanceFunction(&a, &b, &distance_data, d));
  EXPECT_EQ(d, 0);
}

std::map<std::string, Geometry> othersThanKios() {
  const Mesh mesh = scenes::icosphere(0.5, 1);
  std::map<std::string, Geometry> others = partners();
  others.erase("mesh");
  others["TriangleP"] =
      std::make_shared<fcl::TrianglePd>(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ());
  others["OBBRSS"] = scenes::buildModel<fcl::OBBRSSd>(mesh);
  others["fcl::kIOS"] = scenes::buildModel<fcl::kIOSd>(mesh);
  others["AABB"] = scenes::buildModel<fcl::AABBd>(mesh);
  others["KDOP"] = scenes::buildModel<fcl::KDOPd<16>>(mesh);
  return others;
}

/// Returns true for shapes and octrees, which all queries serve.
bool isServed(const fcl::CollisionGeometryd& other) {
  return other.getObjectType() == fcl::OT_OCTREE ||
         (other.getObjectType() == fcl::OT_GEOM && other.getNodeType() != fcl::GEOM_TRIANGLE);
}

// The call throws, and says which query it was and what the two types were.
void expectBothNamed(const std::function<void()>& call, const std::string& query,
                     const std::string& other) {
  try {
    call();
    ADD_FAILURE() << query << " of kIOS and " << other << " was not refused";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("fcl_kios: " + query + " of ", 0), 0u) << message;
    EXPECT_NE(message.find("kios::kIOS<double>"), std::string::npos) << message;
    EXPECT_NE(message.find(other), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(Dispatch, PairsWithAnythingElseAreRefusedInBothOrders) {
  for (const auto& [name, other] : othersThanKios()) {
    if (isServed(*other)) continue;
    const Geometry ours = model_;
    for (const auto& [first, second] : {std::pair(ours, other), std::pair(other, ours)}) {
      const fcl::CollisionGeometryd *g1 = first.get(), *g2 = second.get();
      fcl::CollisionObjectd o1(first, kHere), o2(second, kThere);
      fcl::CollisionResultd contacts;
      fcl::DistanceResultd distance;
      fcl::ContinuousCollisionResultd moving;
      const fcl::ContinuousCollisionRequestd moving_request;
      expectBothNamed([&] { fcl::collide(g1, kHere, g2, kThere, {}, contacts); }, "collide", name);
      expectBothNamed([&] { fcl::collide(&o1, &o2, {}, contacts); }, "collide", name);
      const fcl::DistanceRequestd request;
      expectBothNamed([&] { fcl::distance(g1, kHere, g2, kThere, request, distance); }, "distance",
                      name);
      expectBothNamed([&] { fcl::distance(&o1, &o2, request, distance); }, "distance", name);
      expectBothNamed(
          [&] {
            fcl::continuousCollide(g1, kHere, kThere, g2, kHere, kThere, moving_request, moving);
          },
          "continuousCollide", name);
      expectBothNamed(
          [&] { fcl::continuousCollide(&o1, kThere, &o2, kThere, moving_request, moving); },
          "continuousCollide", name);
      fcl::TranslationMotiond motion(kHere, kThere);
      expectBothNamed(
          [&] { fcl::continuousCollide(g1, &motion, g2, &motion, moving_request, moving); },
          "continuousCollide", name);
      EXPECT_EQ(contacts.numContacts(), 0u);
      EXPECT_EQ(distance.o1, nullptr);
    }
  }
}

// The forms that take a narrow-phase solver are FCL's, too: right or refused, never 0 contacts.
TEST_F(Dispatch, FormsWithASolver) {
  const fcl::CollisionGeometryd* geometry = model_.get();
  const fcl::CollisionObjectd object(model_, kHere);
  const fcl::detail::GJKSolver_indep<double> indep;
  const fcl::detail::GJKSolver_libccd<double> libccd;
  const auto expectHit = [&](const auto& solver) {
    fcl::CollisionResultd c1, c2;
    fcl::DistanceResultd d1, d2;
    const fcl::DistanceRequestd request;
    try {
      fcl::collide(geometry, kHere, geometry, kThere, &solver, fcl::CollisionRequestd(), c1);
      fcl::collide(&object, &object, &solver, fcl::CollisionRequestd(), c2);
      fcl::distance(geometry, kHere, geometry, kThere, &solver, request, d1);
      fcl::distance(&object, &object, &solver, request, d2);
    } catch (const std::invalid_argument&) {
      return;
    }
    EXPECT_TRUE(c1.isCollision());
    EXPECT_TRUE(c2.isCollision());
    EXPECT_EQ(d1.min_distance, 0);
    EXPECT_EQ(d2.min_distance, 0);
  };
  expectHit(indep);
  expectHit(libccd);
}

TEST_F(Dispatch, PairsWithoutKiosAreFcls) {
  const auto others = othersThanKios();
  for (const auto& [a, b] : {std::pair("box", "sphere"), std::pair("OBBRSS", "OBBRSS"),
                             std::pair("fcl::kIOS", "fcl::kIOS"), std::pair("OBBRSS", "box"),
                             std::pair("capsule", "convex"), std::pair("AABB", "AABB")}) {
    for (const Frame& frame : randomFrames(10, 1.5, 71)) {
      const fcl::CollisionGeometryd *g1 = others.at(a).get(), *g2 = others.at(b).get();
      const fcl::CollisionRequestd request(kAllContacts, true);
      fcl::CollisionResultd ours, theirs;
      EXPECT_EQ(fcl::collide(g1, frame.X_WA, g2, frame.X_WB, request, ours),
                fcl_own::collide(g1, frame.X_WA, g2, frame.X_WB, request, theirs));
      ASSERT_EQ(ours.numContacts(), theirs.numContacts());
      for (std::size_t i = 0; i < ours.numContacts(); ++i) {
        EXPECT_EQ(ours.getContact(i).b1, theirs.getContact(i).b1);
        EXPECT_EQ(ours.getContact(i).pos, theirs.getContact(i).pos);
        EXPECT_EQ(ours.getContact(i).penetration_depth, theirs.getContact(i).penetration_depth);
      }
      if (std::string(a) == "AABB") continue;  // no distance in FCL
      fcl::DistanceResultd d_ours, d_theirs;
      const fcl::DistanceRequestd distance_request(true);
      EXPECT_EQ(fcl::distance(g1, frame.X_WA, g2, frame.X_WB, distance_request, d_ours),
                fcl_own::distance(g1, frame.X_WA, g2, frame.X_WB, distance_request, d_theirs));
      EXPECT_EQ(d_ours.min_distance, d_theirs.min_distance);
    }
  }
}

TEST_F(Dispatch, FloatModels) {
  const auto model = scenes::buildModel<kIOSf>(ball_);
  const fcl::Transform3f X = fcl::Transform3f::Identity();
  const fcl::Spheref sphere(1);
  fcl::CollisionResultf contacts;
  fcl::DistanceResultf distance;
  const fcl::DistanceRequestf request;
  const fcl::TrianglePf other(X.linear().col(0), X.linear().col(1), X.linear().col(2));
  EXPECT_THROW(fcl::collide(model.get(), X, &other, X, {}, contacts), std::invalid_argument);
  EXPECT_THROW(fcl::collide(&other, X, model.get(), X, {}, contacts), std::invalid_argument);
  EXPECT_THROW(fcl::distance(model.get(), X, &other, X, request, distance), std::invalid_argument);
  EXPECT_THROW(fcl::distance(&other, X, model.get(), X, request, distance), std::invalid_argument);
  EXPECT_EQ(fcl::collide(&sphere, X, &sphere, X, {}, contacts), 1u);
  const fcl::CollisionObjectf a(model, X), b(model, X);
  fcl::CollisionResultf of_objects;
  EXPECT_EQ(fcl::collide(&a, &b, {}, of_objects), 1u);
  EXPECT_EQ(fcl::distance(&a, &b, request, distance), 0);
}

class NamedModel : public Modeld {
 public:
  explicit NamedModel(const Modeld& model) : Modeld(model) {}
  std::string name = "derived";
};

TEST_F(Dispatch, ClassesDerivedFromTheModelAreRecognised) {
  const auto derived = std::make_shared<NamedModel>(*model_);
  for (const Frame& frame : randomFrames(20, 1.5, 73)) {
    fcl::DistanceResultd expected, result;
    const fcl::DistanceRequestd request;
    fcl::distance(model_.get(), frame.X_WA, model_.get(), frame.X_WB, request, expected);
    fcl::distance(derived.get(), frame.X_WA, model_.get(), frame.X_WB, request, result);
    EXPECT_EQ(result.min_distance, expected.min_distance);
    EXPECT_EQ(result.o1, derived.get());
    fcl::CollisionObjectd a(derived, frame.X_WA), b(derived, frame.X_WB);
    fcl::CollisionResultd contacts;
    fcl::collide(&a, &b, {}, contacts);
    EXPECT_EQ(contacts.isCollision(), expected.min_distance == 0);
  }
  const fcl::TrianglePd other(Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ());
  fcl::CollisionResultd contacts;
  EXPECT_THROW(fcl::collide(derived.get(), kHere, &other, kHere, {}, contacts),
               std::invalid_argument);
}

TEST_F(Dispatch, NullIsRefused) {
  const fcl::CollisionGeometryd* none = nullptr;
  const fcl::CollisionObjectd object(model_, kHere), *no_object = nullptr;
  const fcl::CollisionObjectd hollow{Geometry()};
  const fcl::ContinuousCollisionObjectd* no_moving = nullptr;
  const fcl::MotionBased* no_motion = nullptr;
  const fcl::detail::GJKSolver_libccd<double> solver;
  fcl::CollisionResultd contacts;
  fcl::DistanceResultd distance;
  fcl::ContinuousCollisionResultd moving;
  const fcl::CollisionRequestd collide_request;
  const fcl::DistanceRequestd request;
  const fcl::ContinuousCollisionRequestd moving_request;
  for (const auto* first : {none, static_cast<const fcl::CollisionGeometryd*>(model_.get())}) {
    const auto* second = first ? none : model_.get();
    const std::string what = "a collision geometry is null";
    expectRefused([&] { fcl::collide(first, kHere, second, kHere, {}, contacts); }, what);
    expectRefused([&] { fcl::distance(first, kHere, second, kHere, request, distance); }, what);
    expectRefused(
        [&] { fcl::collide(first, kHere, second, kHere, &solver, collide_request, contacts); },
        what);
    expectRefused(
        [&] {
          fcl::continuousCollide(first, kHere, kHere, second, kHere, kHere, moving_request, moving);
        },
        what);
  }
  for (const auto* first : {no_object, &object}) {
    const auto* second = first ? no_object : &object;
    const std::string what = "a collision object is null";
    expectRefused([&] { fcl::collide(first, second, {}, contacts); }, what);
    expectRefused([&] { fcl::distance(first, second, request, distance); }, what);
    expectRefused([&] { fcl::collide(first, second, &solver, collide_request, contacts); }, what);
    expectRefused([&] { fcl::distance(first, second, &solver, request, distance); }, what);
    expectRefused(
        [&] { fcl::continuousCollide(first, kHere, second, kHere, moving_request, moving); }, what);
  }
  expectRefused([&] { fcl::collide(no_moving, no_moving, moving_request, moving); },
                "object is null");
  expectRefused([&] { fcl::collide(&object, &hollow, {}, contacts); }, "geometry is null");
  expectRefused(
      [&] {
        fcl::continuousCollide(model_.get(), no_motion, model_.get(), no_motion, moving_request,
                               moving);
      },
      "a motion for each object");
}

}  // namespace
}  // namespace kios::testing
