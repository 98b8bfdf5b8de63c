// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A program of which one file sees FCL's headers alone: its queries of meshes over k-IOS are
// refused in words, and nothing else is.
#include "fcl/expect_refused.h"
#include "fcl/fcl_only.h"
#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

using Object = fcl::CollisionObjectd;

const Transform3d kHere = Transform3d::Identity();

TEST(HalfSwapped, FclsOwnQueriesOfOurMeshesAreRefused) {
  const auto mesh = kiosModel(scenes::icosphere(1, 1));
  const Object a(mesh, kHere), b(mesh, kHere);
  const Object box(std::make_shared<fcl::Boxd>(1, 1, 1), kHere);
  for (const Object* const other : {&b, &box}) {
    for (const auto& [first, second] : {std::pair(&a, other), std::pair(other, &a)}) {
      expectRefused([&, f = first, s = second] { fcl_only::collide(*f, *s); }, "force_include");
      expectRefused([&, f = first, s = second] { fcl_only::collideGeometries(*f, *s); },
                    "force_include");
      expectRefused([&, f = first, s = second] { fcl_only::distance(*f, *s); }, "force_include");
    }
  }
}

// Not so in C++20, where these forms are ours.
#if __cplusplus < 202002L
TEST(HalfSwapped, SoAreExplicitTemplateArguments) {
  const auto mesh = kiosModel(scenes::icosphere(1, 1));
  const Object a(mesh, kHere), b(mesh, kHere);
  fcl::CollisionResultd contacts;
  fcl::DistanceResultd distance;
  expectRefused([&] { fcl::collide<double>(&a, &b, fcl::CollisionRequestd(), contacts); },
                "fcl::collide<double>(...)");
  expectRefused([&] { fcl::distance<double>(&a, &b, fcl::DistanceRequestd(), distance); },
                "fcl::collide<double>(...)");
}
#endif

TEST(HalfSwapped, ManagersOfFclEndWithTheRefusal) {
  const auto mesh = kiosModel(scenes::icosphere(1, 1));
  Object a(mesh, kHere), b(mesh, Transform3d(Eigen::Translation3d(0.5, 0, 0)));
  for (const auto& [name, make] : managers()) {
    const Manager manager = filled(make, {&a, &b});
    expectRefused([&, m = manager] { fcl_only::collide(*m); }, "force_include");
    expectRefused([&, m = manager] { fcl_only::distance(*m); }, "force_include");
    // By our callbacks they answer.
    fcl::DefaultCollisionData<double> contacts;
    manager->collide(&contacts, fcl::DefaultCollisionFunction<double>);
    EXPECT_TRUE(contacts.result.isCollision()) << name;
  }
}

TEST(HalfSwapped, OtherGeometriesAndQuestionsAreAsEver) {
  const Object mesh(kiosModel(scenes::icosphere(1, 1)), kHere);
  const Object fcls(scenes::buildModel<fcl::OBBRSSd>(scenes::icosphere(1, 1)), kHere);
  EXPECT_TRUE(fcl_only::isMesh(mesh));
  EXPECT_NO_THROW(fcl_only::collide(fcls, fcls));
  EXPECT_NO_THROW(fcl_only::distance(fcls, fcls));
  fcl::CollisionResultd contacts;
  EXPECT_GT(fcl::collide(&mesh, &mesh, fcl::CollisionRequestd(), contacts), 0U);
}

}  // namespace
}  // namespace kios::testing
