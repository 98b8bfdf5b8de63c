// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models that change after they were built: replaced, updated, refitted, made relative, copied.

#include <gtest/gtest.h>

#include <cmath>

#include "fcl/mesh_cases.h"
#include "model/bvh_check.h"
#include "model/deform.h"
#include "together.h"

namespace kios::testing {
namespace {

struct Answers {
  std::vector<double> distances;
  std::vector<Pairs> pairs;
  bool operator==(const Answers& other) const {
    return distances == other.distances && pairs == other.pairs;
  }
};

Answers ask(const Modeld& a, const Modeld& b, const std::vector<Frame>& frames) {
  Answers answers;
  for (const Frame& frame : frames) {
    fcl::DistanceResultd distance;
    answers.distances.push_back(
        fcl::distance(&a, frame.X_WA, &b, frame.X_WB, fcl::DistanceRequestd(), distance));
    fcl::CollisionResultd contacts;
    fcl::collide(&a, frame.X_WA, &b, frame.X_WB, fcl::CollisionRequestd(kAllContacts), contacts);
    answers.pairs.push_back(contactPairs(contacts));
  }
  return answers;
}

class Refit : public ::testing::Test {
 protected:
  // The model answers as one built from the vertices afresh.
  void expectAnswersOf(const Modeld& model, const std::vector<Vector3d>& vertices) const {
    const auto fresh = modelAlone({vertices, mesh_.triangles});
    EXPECT_TRUE(ask(model, *other_, frames_) == ask(*fresh, *other_, frames_));
    EXPECT_TRUE(ask(*other_, model, frames_) == ask(*other_, *fresh, frames_));
  }

  const Mesh mesh_ = scenes::bumpyTorus(300);
  const std::shared_ptr<Modeld> other_ = kiosModel(scenes::bumpyTorus(140));
  const std::vector<Frame> frames_ = randomFrames(15, 1.3, 61);
};

// A manager may ask for the box of a model whose new vertices aren't given yet.
TEST_F(Refit, AnUpdateBeginsWithTheVerticesThatWere) {
  const auto model = kiosModel(mesh_);
  ASSERT_EQ(model->beginUpdateModel(), fcl::BVH_OK);
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    EXPECT_EQ(model->vertices[i], mesh_.vertices[i]);
    EXPECT_EQ(model->prev_vertices[i], mesh_.vertices[i]);
  }
}

TEST_F(Refit, ReplaceEveryWay) {
  const auto built = nodesOf(*kiosModel({swayed(mesh_, 2.5), mesh_.triangles}));
  for (const bool refit : {true, false}) {
    for (const bool bottomup : {true, false}) {
      const auto model = kiosModel(mesh_);
      for (const double phase : {0.5, 1.0, 2.5}) {
        const auto vertices = swayed(mesh_, phase);
        replace(*model, vertices, refit, bottomup);
        EXPECT_EQ(model->build_state, fcl::BVH_BUILD_STATE_PROCESSED);
        expectValidTree(*model);
        expectAnswersOf(*model, vertices);
      }
      if (!refit) {
        EXPECT_TRUE(sameTree(*model, built));
      }
    }
  }
}

TEST_F(Refit, UpdateEveryWayHoldsThePreviousPositionsToo) {
  for (const bool refit : {true, false}) {
    for (const bool bottomup : {true, false}) {
      const auto model = kiosModel(mesh_);
      for (const double phase : {0.5, 1.0, 2.5}) {
        const auto vertices = swayed(mesh_, phase);
        update(*model, vertices, refit, bottomup);
        EXPECT_EQ(model->build_state, fcl::BVH_BUILD_STATE_UPDATED);
        ASSERT_NE(model->prev_vertices, nullptr);
        expectValidTree(*model);
        expectAnswersOf(*model, vertices);
      }
    }
  }
}

TEST_F(Refit, TopDownIsAsTightAsABuild) {
  const auto model = kiosModel(mesh_);
  Mesh moved = mesh_;
  for (Vector3d& p : moved.vertices) p += Vector3d(4, 8, 16);
  replace(*model, moved.vertices, true, false);
  // A build fits large volumes by some of their points, a refit by all of them.
  const double refitted = model->getBV(0).bv.radius0;
  const double built = kiosModel(moved)->getBV(0).bv.radius0;
  EXPECT_LE(refitted, built + 1e-6);
  EXPECT_LE(built, 1.02 * refitted);
}

// Merging upwards must not let volumes grow with every level (defect 1 of docs/fcl-coverage.md).
TEST_F(Refit, BottomUpStaysTight) {
  const auto model = kiosModel(mesh_);
  const double fitted = model->getBV(0).bv.radius0;
  for (int i = 0; i < 5; ++i) replace(*model, mesh_.vertices, true, true);
  EXPECT_LT(model->getBV(0).bv.radius0, 2 * fitted);
}

TEST_F(Refit, MakeParentRelativeKeepsEveryAnswer) {
  const auto model = kiosModel(mesh_);
  const Answers before = ask(*model, *other_, frames_);
  for (int i = 0; i < 2; ++i) {
    model->makeParentRelative();
    EXPECT_TRUE(ask(*model, *other_, frames_) == before);
    EXPECT_TRUE(ask(*model, *model, frames_) == ask(*kiosModel(mesh_), *kiosModel(mesh_), frames_));
  }
  for (const bool bottomup : {true, false}) {
    const auto vertices = swayed(mesh_, 3);
    replace(*model, vertices, true, bottomup);
    expectValidTree(*model);
    expectAnswersOf(*model, vertices);
    model->makeParentRelative();
    expectAnswersOf(*model, vertices);
  }
}

TEST_F(Refit, CopiesAreIndependent) {
  auto original = kiosModel(mesh_);
  update(*original, swayed(mesh_, 1), true, true);
  Modeld copy(*original);
  expectValidTree(copy);
  EXPECT_TRUE(sameTree(copy, *original));
  const Answers before = ask(*original, *other_, frames_);
  EXPECT_TRUE(ask(copy, *other_, frames_) == before);
  update(copy, swayed(mesh_, 2), true, false);
  expectAnswersOf(copy, swayed(mesh_, 2));
  EXPECT_TRUE(ask(*original, *other_, frames_) == before);
  original.reset();
  update(copy, swayed(mesh_, 4), false, true);
  expectValidTree(copy);
  expectAnswersOf(copy, swayed(mesh_, 4));
}

// FCL's copy constructor lets copies share one fitter and one splitter.
TEST_F(Refit, CopiesRefitInTwoThreadsAsInOne) {
  const Mesh large = scenes::bumpyTorus(3000);
  const Modeld original(*kiosModel(large));
  const auto work = [&](Modeld& model, double phase) {
    for (int i = 0; i < 6; ++i) {
      if (i % 3 == 0) replace(model, swayed(large, phase + i), false, false);
      if (i % 3 == 1) replace(model, swayed(large, phase + i), true, false);
      if (i % 3 == 2) update(model, swayed(large, phase + i), false, false);
      if (model.build_state == fcl::BVH_BUILD_STATE_UPDATED)
        model.build_state = fcl::BVH_BUILD_STATE_PROCESSED;  // lets replace follow update
    }
  };
  Modeld one(original), two(original), one_alone(original), two_alone(original);
  ASSERT_EQ(one.bv_fitter, two.bv_fitter);
  work(one_alone, 0);
  work(two_alone, 7);
  for (int round = 0; round < 3; ++round) {
    Modeld a(original), b(original);
    together(2, [&](int t) { t == 0 ? work(a, 0) : work(b, 7); });
    EXPECT_TRUE(sameTree(a, one_alone));
    EXPECT_TRUE(sameTree(b, two_alone));
  }
}

TEST_F(Refit, ModelsBuiltInManyThreadsAreAsBuiltAlone) {
  const auto meshOf = [&](std::size_t i) { return Mesh{swayed(mesh_, i), mesh_.triangles}; };
  std::vector<std::vector<fcl::BVNode<kIOSd>>> alone;
  for (std::size_t i = 0; i < 8; ++i) alone.push_back(nodesOf(*kiosModel(meshOf(i))));
  std::vector<std::shared_ptr<Modeld>> models(8);
  together(8, [&](int t) { models[t] = kiosModel(meshOf(t)); });
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(sameTree(*models[i], alone[i])) << i;
}

}  // namespace
}  // namespace kios::testing
