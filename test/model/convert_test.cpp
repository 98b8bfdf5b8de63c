// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios::toKIOS() from models over FCL's volumes, and scenes that mix volumes.

#include <gtest/gtest.h>

#include "fcl/expect_refused.h"
#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

const Transform3d kHere = Transform3d::Identity();

template <typename BV>
class Convert : public ::testing::Test {};
using Volumes =
    ::testing::Types<fcl::AABBd, fcl::OBBd, fcl::RSSd, fcl::OBBRSSd, fcl::kIOSd, fcl::KDOPd<16>,
                     fcl::KDOPd<18>, fcl::KDOPd<24>, kIOSd, kIOSf, fcl::OBBRSSf>;
TYPED_TEST_SUITE(Convert, Volumes);

TYPED_TEST(Convert, KeepsGeometryAndSettings) {
  using S = typename TypeParam::S;
  const Mesh mesh = scenes::bumpyTorus(150);
  const auto source = scenes::buildModel<TypeParam>(mesh);
  int user = 0;
  source->user_data = &user;
  source->cost_density = S(3);
  source->threshold_occupied = S(0.75);
  source->threshold_free = S(0.25);
  source->computeLocalAABB();
  const std::shared_ptr<Model<S>> converted = toKIOS(*source);
  EXPECT_NO_THROW(validate(*converted));
  ASSERT_EQ(converted->num_vertices, source->num_vertices);
  ASSERT_EQ(converted->num_tris, source->num_tris);
  EXPECT_TRUE(
      std::equal(source->vertices, source->vertices + source->num_vertices, converted->vertices));
  for (int i = 0; i < source->num_tris; ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(converted->tri_indices[i][c], source->tri_indices[i][c]);
  }
  EXPECT_EQ(converted->user_data, &user);
  EXPECT_EQ(converted->cost_density, S(3));
  EXPECT_EQ(converted->threshold_occupied, S(0.75));
  EXPECT_EQ(converted->threshold_free, S(0.25));
  EXPECT_TRUE(converted->aabb_local.equal(source->aabb_local));
  EXPECT_EQ(converted->aabb_center, source->aabb_center);
  EXPECT_EQ(converted->aabb_radius, source->aabb_radius);
}

template <typename BV>
void expectUnfit(const fcl::BVHModel<BV>& model, const std::string& part) {
  expectRefused([&] { toKIOS(model); }, part);
}

TYPED_TEST(Convert, RefusesWhatIsUnfinished) {
  using S = typename TypeParam::S;
  ::testing::internal::CaptureStderr();  // FCL's warnings
  using Source = fcl::BVHModel<TypeParam>;
  expectUnfit(Source(), "empty");
  const auto good = scenes::buildModel<TypeParam>(scenes::icosphere(1, 0));
  std::vector<fcl::Vector3<S>> points(good->vertices, good->vertices + good->num_vertices);
  Source begun;
  begun.beginModel();
  begun.addSubModel(points);
  expectUnfit(begun, "begun");
  ASSERT_EQ(begun.endModel(), fcl::BVH_OK);
  EXPECT_EQ(toKIOS(begun)->num_tris, static_cast<int>(points.size()));
  Source nothing;
  nothing.beginModel();
  nothing.endModel();
  expectUnfit(nothing, "begun");
  Source replacing(*good);
  replacing.beginReplaceModel();
  expectUnfit(replacing, "replace");
  Source updating(*good);
  updating.beginUpdateModel();
  expectUnfit(updating, "update");
  Source bad(*good);
  bad.vertices[3][1] = std::numeric_limits<S>::quiet_NaN();
  expectUnfit(bad, "vertex 3 ");
  Source wild(*good);
  wild.tri_indices[2] = fcl::Triangle(0, 1, 999);
  expectUnfit(wild, "triangle 2 refers to vertex 999");
  ::testing::internal::GetCapturedStderr();
}

TEST(ConvertStale, TheBoxIsThatOfTheVerticesNow) {
  const Mesh mesh = scenes::icosphere(1, 1);
  const auto source = scenes::buildModel<fcl::OBBRSSd>(mesh);
  source->computeLocalAABB();
  std::vector<Vector3d> vertices = mesh.vertices;
  for (Vector3d& p : vertices) p *= 7;
  source->beginReplaceModel();
  source->replaceSubModel(vertices);
  source->endReplaceModel();
  EXPECT_LT(source->aabb_radius, 2);  // FCL leaves it
  EXPECT_NEAR(toKIOS(*source)->aabb_radius, 7, 1e-9);
}

// The message of a scene that mixes volumes names both types, and the remedy, which works.
template <typename BV>
void expectRemedy(const std::string& name) {
  const Mesh mesh = scenes::icosphere(1, 1);
  const auto ours = kiosModel(mesh);
  const auto other = scenes::buildModel<BV>(mesh);
  const Transform3d there(Eigen::Translation3d(0.5, 0.25, 0.125));
  const fcl::CollisionGeometryd *g1 = ours.get(), *g2 = other.get();
  for (int order = 0; order < 2; ++order, std::swap(g1, g2)) {
    fcl::CollisionResultd contacts;
    fcl::DistanceResultd result;
    for (const std::string& part :
         {std::string("kios::kIOS<double>"), name, std::string("kios::toKIOS(model)")}) {
      expectRefused([&] { fcl::distance(g1, kHere, g2, there, fcl::DistanceRequestd(), result); },
                    part);
      expectRefused([&] { fcl::collide(g1, kHere, g2, there, {}, contacts); }, part);
    }
  }
  fcl::CollisionResultd contacts;
  EXPECT_GT(fcl::collide(ours.get(), kHere, toKIOS(*other).get(), there, {}, contacts), 0u);
}

TEST(MixedScenes, AreRefusedByNameAndRemedy) {
  expectRemedy<fcl::AABBd>("AABB");
  expectRemedy<fcl::OBBd>("OBB");
  expectRemedy<fcl::RSSd>("RSS");
  expectRemedy<fcl::OBBRSSd>("OBBRSS");
  expectRemedy<fcl::kIOSd>("fcl::kIOS");
  expectRemedy<fcl::KDOPd<16>>("KDOP");
}

}  // namespace
}  // namespace kios::testing
