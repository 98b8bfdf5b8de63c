// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which volumes are shared with builds of equal meshes, and when no more.

#include "model/shared_volumes.h"

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "model/bvh_check.h"
#include "model/deform.h"
#include "model/prepared.h"

namespace kios::testing {
namespace {

class SharedVolumes : public ::testing::Test {
 protected:
  /// Returns whether a build of this mesh would find volumes to copy.
  static bool areShared(const Mesh& mesh) {
    const std::size_t n = mesh.triangles.size();
    std::vector<fcl::BVNode<kIOSd>> nodes(2 * n - 1);
    std::vector<unsigned int> primitives(n);
    const engine::ContentHash content = engine::contentHash(engine::MeshView<double>{
        mesh.vertices.data(), mesh.vertices.size(), mesh.triangles.data(), n});
    return copySharedVolumes<double>(content, n, {nodes.data(), primitives.data()});
  }

  const Mesh mesh_ = scenes::bumpyTorus(300);
};

TEST_F(SharedVolumes, AsLongAsAModelLives) {
  EXPECT_FALSE(areShared(mesh_));
  auto model = kiosModel(mesh_);
  EXPECT_TRUE(areShared(mesh_));
  auto copy = std::make_shared<Modeld>(*model);
  auto second = kiosModel(mesh_);
  model.reset();
  EXPECT_TRUE(areShared(mesh_));
  second.reset();
  EXPECT_TRUE(areShared(mesh_));  // of the copy
  copy.reset();
  EXPECT_FALSE(areShared(mesh_));

  const Mesh box = scenes::subdividedBox({1, 1, 1}, 1);  // fewer than kLeastSharedCopy
  auto built = kiosModel(box);
  const Modeld of_few(*built);
  EXPECT_TRUE(areShared(box));
  built.reset();
  EXPECT_FALSE(areShared(box));
}

// A model may be built anew, and grow or shrink, across the number of triangles from which on it
// shares. releaseVolumes() tells by the room of its tree whether it did.
TEST_F(SharedVolumes, NeverThoseOfFewTriangles) {
  const auto first = [this](int n) {
    return Mesh{mesh_.vertices, {mesh_.triangles.begin(), mesh_.triangles.begin() + n}};
  };
  Modeld model;
  for (const int n : {1, 5, 2, 4, 3, 4, 6, 3, 1, 4}) {
    const Mesh mesh = first(n);
    if (model.build_state != fcl::BVH_BUILD_STATE_EMPTY) {
      ::testing::internal::CaptureStderr();
      model.beginModel();  // only resets it
      ::testing::internal::GetCapturedStderr();
    }
    for (int other = 1; other < 8; ++other) EXPECT_FALSE(areShared(first(other))) << other;
    ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
    ASSERT_EQ(model.addSubModel(mesh.vertices, mesh.triangles), fcl::BVH_OK);
    ASSERT_EQ(model.endModel(), fcl::BVH_OK);
    EXPECT_EQ(areShared(mesh), n >= kLeastShared) << n;
    const Modeld copy(model);
    EXPECT_TRUE(sameTree(copy, nodesOf(model)));
    if (n % 2 == 1) continue;
    replace(model, swayed(mesh_, 1), true, n == 4);
    EXPECT_FALSE(areShared(mesh)) << n;
  }
}

TEST_F(SharedVolumes, UntilTheyChange) {
  for (int way = 0; way < 6; ++way) {
    const auto model = kiosModel(mesh_);
    ASSERT_TRUE(areShared(mesh_));
    if (way == 0) replace(*model, swayed(mesh_, 1), true, true);
    if (way == 1) replace(*model, swayed(mesh_, 1), true, false);
    if (way == 2) replace(*model, swayed(mesh_, 1), false, true);
    if (way == 3) update(*model, swayed(mesh_, 1), true, true);
    if (way == 4) invalidate(*model);
    if (way == 5) {
      ::testing::internal::CaptureStderr();
      model->beginModel();
      ::testing::internal::GetCapturedStderr();
    }
    EXPECT_FALSE(areShared(mesh_)) << way;
  }
}

// Volumes that were written show that a build reads them.
TEST_F(SharedVolumes, ABuildCopiesThem) {
  const auto first = kiosModel(mesh_);
  first->getBV(5).bv.radius0 *= 2;
  const auto second = kiosModel(mesh_);
  EXPECT_TRUE(sameTree(*second, *first));
  const auto third = modelAlone(mesh_);
  EXPECT_FALSE(sameTree(*third, *first));
}

TEST_F(SharedVolumes, OnlyThoseOfTheTunedFitByCost) {
  Modeld published, median, cloud;
  published.bv_fitter.reset(new fcl::detail::BVFitter<kIOSd>(FitMethod::kMethodII));
  median.bv_splitter.reset(new fcl::detail::BVSplitter<kIOSd>(fcl::detail::SPLIT_METHOD_MEDIAN));
  for (Modeld* model : {&published, &median}) {
    model->beginModel();
    model->addSubModel(mesh_.vertices, mesh_.triangles);
    model->endModel();
  }
  cloud.beginModel();
  cloud.addSubModel(mesh_.vertices);
  cloud.endModel();
  EXPECT_FALSE(areShared(mesh_));
}

// A model that could use a prepared tree at once doesn't do without.
TEST_F(SharedVolumes, AnEqualPreparedTreeIsUsedAtOnce) {
  const auto prepared = kiosModel(mesh_);
  prepare(*prepared);
  const auto equal = kiosModel(mesh_);
  SearchCounts counts;
  fcl::CollisionResultd result;
  collideMeshes(*equal, Transform3d::Identity(), *prepared,
                Transform3d(fcl::Translation3d(0.3, 0.2, 0.1)), fcl::CollisionRequestd(), result,
                &counts);
  EXPECT_EQ(counts.tree_searches, 0);
  EXPECT_EQ(preparedTree(*equal).operator->(), preparedTree(*prepared).operator->());
}

}  // namespace
}  // namespace kios::testing
