// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles so small that squares and fourth powers of their edges vanish, in meshes of ordinary
// size: they have distances, contacts and rays like all others.

#include <gtest/gtest.h>

#include <cmath>

#include "fcl/mesh_cases.h"
#include "fcl_kios/fcl_kios.h"
#include "shapes.h"

namespace kios::testing {
namespace {

constexpr double kSizes[] = {1e-30, 1e-60,  1e-75,  1e-77,  1e-79,  1e-81,
                             1e-90, 1e-120, 1e-150, 1e-155, 1e-162, 1e-200};

/// Returns triangles far off in two corners, which give a mesh its size.
Mesh withCorners(double z) {
  Mesh mesh;
  addTriangle(mesh, {1, 1, 1}, {1, 0.9, 1}, {0.9, 1, 1});
  addTriangle(mesh, {-1, -1, -1}, {-1, -0.9, -1}, {-0.9, -1, -1});
  for (Vector3d& p : mesh.vertices) p.z() += z;
  return mesh;
}

TEST(TinyTriangles, MeetAPlane) {
  const Frame frame = {Transform3d::Identity(), Transform3d::Identity()};
  for (const double s : kSizes) {
    SCOPED_TRACE(s);
    Mesh tiny = withCorners(0), plane = withCorners(3);
    addTriangle(tiny, {-s, -s, -s}, {s, -s, s}, {0, s, s});
    addTriangle(plane, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
    ASSERT_EQ(leafPairs(tiny, plane, frame), Pairs({{2, 2}}));
    const auto a = kiosModel(tiny), b = kiosModel(plane);
    for (const std::size_t limit : {std::size_t{1}, std::size_t{100}}) {
      fcl::CollisionResultd result;
      fcl::collide(a.get(), frame.X_WA, b.get(), frame.X_WB, {limit, true}, result);
      EXPECT_EQ(contactPairs(result), Pairs({{2, 2}})) << limit;
    }
    fcl::DistanceResultd distance;
    fcl::distance(a.get(), frame.X_WA, b.get(), frame.X_WB, fcl::DistanceRequestd(), distance);
    EXPECT_EQ(distance.min_distance, 0);
    Rayd ray;
    ray.origin = {0, 0, 5};
    ray.direction = {0, 0, -1};
    const auto hit = firstHit(*a, Transform3d::Identity(), ray);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->triangle, 2);
  }
}

// Two tiny soups within each other, and nothing else near: contacts, and distances to 16 eps of
// their own size.
TEST(TinyTriangles, AmongEachOther) {
  Random random(5);
  const Frame frame = {Transform3d::Identity(), Transform3d::Identity()};
  int meeting = 0, apart = 0;
  for (const double s : kSizes) {
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE(::testing::Message() << s << " " << i);
      Mesh meshes[2] = {withCorners(0), withCorners(5)};
      for (Mesh& mesh : meshes) {
        for (int t = 0; t < 4; ++t) {
          const Vector3d c = s * inCube(random);
          const double part = i % 2 == 0 ? s : s * 1e-3;
          addTriangle(mesh, c, c + part * inCube(random), c + part * inCube(random));
        }
      }
      const auto a = kiosModel(meshes[0]), b = kiosModel(meshes[1]);
      const double exact = leafDistance(meshes[0], meshes[1], frame);
      fcl::DistanceResultd distance;
      fcl::distance(a.get(), frame.X_WA, b.get(), frame.X_WB, fcl::DistanceRequestd(), distance);
      EXPECT_NEAR(distance.min_distance, exact, 1e-14 * s);
      EXPECT_EQ(distance.min_distance == 0, exact == 0);
      fcl::CollisionResultd contacts;
      fcl::collide(a.get(), frame.X_WA, b.get(), frame.X_WB, {kAllContacts, true}, contacts);
      EXPECT_EQ(contactPairs(contacts), leafPairs(meshes[0], meshes[1], frame));
      ++(exact == 0 ? meeting : apart);
    }
  }
  EXPECT_GT(meeting, 30);
  EXPECT_GT(apart, 30);
}

// Two triangles that cross, from the smallest to the largest scale whose cross products S can't
// hold: normals are of length 1, points lie on both.
template <typename S>
void expectContactsAt(S scale) {
  SCOPED_TRACE(scale);
  using Point = fcl::Vector3<S>;
  const std::vector<Point> a = {Point(-1, -1, 0) * scale, Point(1, -1, 0) * scale,
                                Point(0, 1, 0) * scale};
  const std::vector<Point> b = {Point(0, 0, -1) * scale, Point(0, 0.5, 1) * scale,
                                Point(0, -0.5, 1) * scale};
  const auto pose = fcl::Transform3<S>::Identity();
  const auto model_a = makeModel<S>(a, {{0, 1, 2}}), model_b = makeModel<S>(b, {{0, 1, 2}});
  fcl::CollisionRequest<S> request(10, true);
  fcl::CollisionResult<S> result;
  fcl::collide(model_a.get(), pose, model_b.get(), pose, request, result);
  ASSERT_GE(result.numContacts(), 1u);
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    EXPECT_NEAR(contact.normal.norm(), 1, 1e-5);
    EXPECT_TRUE(std::isfinite(contact.penetration_depth));
    EXPECT_LE((contact.pos / scale).cwiseAbs().maxCoeff(), 1 + 1e-5);
  }
}

TEST(TinyTriangles, ContactsHaveNormalsAtAnyScale) {
  for (int e = -60; e <= 60; e += 5) expectContactsAt<float>(std::ldexp(1.0F, e));
  for (int e = -500; e <= 500; e += 25) expectContactsAt<double>(std::ldexp(1.0, e));
}

}  // namespace
}  // namespace kios::testing
