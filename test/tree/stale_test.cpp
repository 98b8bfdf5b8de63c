// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Prepared trees are those of the model as it is: through every way that a model can change, be
// copied and be freed.

#include <gtest/gtest.h>

#include "fcl/mesh_cases.h"
#include "fcl_kios/paper.h"
#include "model/deform.h"
#include "model/prepared.h"
#include "scenes/foreign_fitter.h"

namespace kios::testing {
namespace {

using PlainFitter = scenes::ForeignFitter<kIOSd>;

class Stale : public ::testing::Test {
 protected:
  // Distances and contacts are those of the vertices.
  void expectAnswersOf(const Modeld& model, const std::vector<Vector3d>& vertices) const {
    const Mesh mesh = {vertices, mesh_.triangles};
    for (const Frame& frame : frames_) {
      SearchCounts counts;
      fcl::DistanceResultd distance;
      const double d = distanceMeshes(model, frame.X_WA, *other_, frame.X_WB,
                                      fcl::DistanceRequestd(), distance, &counts);
      EXPECT_NEAR(d, leafDistance(mesh, other_mesh_, frame), 1e-14);
      EXPECT_EQ(counts.tree_searches, 0);
      fcl::CollisionResultd contacts;
      fcl::collide(&model, frame.X_WA, other_.get(), frame.X_WB,
                   fcl::CollisionRequestd(kAllContacts), contacts);
      EXPECT_EQ(contactPairs(contacts), leafPairs(mesh, other_mesh_, frame));
    }
  }

  std::size_t bytesOfOne() const { return preparedBytes(*kiosModel(mesh_)); }

  const Mesh mesh_ = scenes::bumpyTorus(200), other_mesh_ = scenes::icosphere(0.5, 1);
  const std::shared_ptr<Modeld> other_ = kiosModel(other_mesh_);
  const std::vector<Frame> frames_ = randomFrames(4, 1.2, 71);
};

TEST_F(Stale, FinishedMeansPrepared) {
  const auto model = kiosModel(mesh_);
  const std::size_t bytes = preparedBytes(*model);
  EXPECT_GT(bytes, 0u);
  const engine::Tree* const tree = &treeOf(*model);
  expectAnswersOf(*model, mesh_.vertices);
  prepare(*model);
  EXPECT_EQ(&treeOf(*model), tree);
  EXPECT_EQ(preparedBytes(*model), bytes);
  EXPECT_THROW(prepare(Modeld()), std::invalid_argument);
  EXPECT_EQ(preparedBytes(Modeld()), 0u);
}

// Models that come and go at the same addresses, and a model that is built anew.
TEST_F(Stale, BuiltAnew) {
  for (int i = 0; i < 20; ++i) {
    const auto model = kiosModel({swayed(mesh_, i), mesh_.triangles});
    expectAnswersOf(*model, swayed(mesh_, i));
  }
  Modeld model(*kiosModel(mesh_));
  expectAnswersOf(model, mesh_.vertices);
  for (int i = 0; i < 5; ++i) {
    ::testing::internal::CaptureStderr();
    model.beginModel();  // FCL clears a full model, with a warning, and wants to be called again
    ::testing::internal::GetCapturedStderr();
    ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
    ASSERT_EQ(model.addSubModel(swayed(mesh_, i), mesh_.triangles), fcl::BVH_OK);
    ASSERT_EQ(model.endModel(), fcl::BVH_OK);
    expectAnswersOf(model, swayed(mesh_, i));
  }
}

// Written where the old volumes don't reach, too. FCL refuses to replace a model that was updated,
// and verticesChanged() goes by replacing.
TEST_F(Stale, DirectWritesNeedInvalidate) {
  for (const bool updated : {false, true}) {
    for (const double away : {0.0, 0.5, 20.0}) {
      const auto model = kiosModel(mesh_);
      if (updated) update(*model, swayed(mesh_, 1), true, true);
      expectAnswersOf(*model, updated ? swayed(mesh_, 1) : mesh_.vertices);
      std::vector<Vector3d> vertices = swayed(mesh_, 2);
      for (Vector3d& p : vertices) p += Vector3d(away, 0, 0);
      std::copy(vertices.begin(), vertices.end(), model->vertices);
      verticesChanged(*model);
      expectAnswersOf(*model, vertices);
      const Frame there = {Transform3d::Identity(), Transform3d(Eigen::Translation3d(away, 0, 0))};
      fcl::CollisionResultd contacts;
      fcl::collide(model.get(), there.X_WA, other_.get(), there.X_WB,
                   fcl::CollisionRequestd(kAllContacts), contacts);
      EXPECT_EQ(contactPairs(contacts), leafPairs({vertices, mesh_.triangles}, other_mesh_, there));
      EXPECT_TRUE(contacts.isCollision());
    }
  }
  const auto model = kiosModel(mesh_);
  model->vertices[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(verticesChanged(*model), std::invalid_argument);
}

// Whoever fits the volumes of FCL's tree, queries search ours.
TEST_F(Stale, AnotherFitter) {
  auto model = std::make_shared<Modeld>();
  model->bv_fitter.reset(new PlainFitter());
  model->beginModel();
  model->addSubModel(mesh_.vertices, mesh_.triangles);
  ASSERT_EQ(model->endModel(), fcl::BVH_OK);
  expectAnswersOf(*model, mesh_.vertices);
  EXPECT_EQ(preparedBytes(*model), bytesOfOne());
  replace(*model, swayed(mesh_, 1), true, true);
  expectAnswersOf(*model, swayed(mesh_, 1));
  verticesChanged(*model);

  // Replaced after queries; and ours again, by the published fit.
  const auto other = kiosModel(mesh_);
  expectAnswersOf(*other, mesh_.vertices);
  other->bv_fitter.reset(new PlainFitter());
  expectAnswersOf(*other, mesh_.vertices);
  other->bv_fitter.reset(new PaperFitter<double>(FitMethod::kMethodII));
  replace(*other, swayed(mesh_, 2), false, true);
  expectAnswersOf(*other, swayed(mesh_, 2));
}

TEST_F(Stale, FreedWithTheLastCopy) {
  auto original = kiosModel(mesh_);
  const std::weak_ptr<const engine::Tree> tree = preparedOf(*original).tree;
  auto copy = std::make_shared<Modeld>(*original);
  original.reset();
  expectAnswersOf(*copy, mesh_.vertices);
  EXPECT_FALSE(tree.expired());
  copy.reset();
  EXPECT_TRUE(tree.expired());
}

}  // namespace
}  // namespace kios::testing
