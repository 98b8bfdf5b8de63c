// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Models that change after they were built: replaced, updated, refitted, made relative, copied.
// Motions walk the nodes that change; collide() and distance() a tree of their own.

#include <gtest/gtest.h>

#include <cmath>

#include "continuous/moving_meshes.h"
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
    const double toc_err = 1e-7, time = contactTime(model, toc_err);
    EXPECT_NEAR(time, contactTime(*fresh, toc_err), toc_err);
    EXPECT_GT(time, 0.1);
    EXPECT_LT(time, 0.5);
  }
  double contactTime(const Modeld& model, double toc_err) const {
    fcl::ContinuousCollisionResultd result;
    return firstContact(model, at(0, 0, 0), at(0, 0, 0, 1), *other_, at(9, 0, 0), at(-9, 0, 0, 1),
                        requestFor(fcl::CCDM_LINEAR, toc_err), result);
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

// An updated model's volumes hold the previous positions too.
TEST_F(Refit, ReplaceAndUpdateEveryWay) {
  const auto built = nodesOf(*kiosModel({swayed(mesh_, 2.5), mesh_.triangles}));
  for (const bool is_update : {false, true}) {
    for (const bool refit : {true, false}) {
      for (const bool bottomup : {true, false}) {
        const auto model = kiosModel(mesh_);
        for (const double phase : {0.5, 1.0, 2.5}) {
          const auto vertices = swayed(mesh_, phase);
          (is_update ? update : replace)(*model, vertices, refit, bottomup);
          EXPECT_EQ(model->build_state,
                    is_update ? fcl::BVH_BUILD_STATE_UPDATED : fcl::BVH_BUILD_STATE_PROCESSED);
          EXPECT_EQ(model->prev_vertices != nullptr, is_update);
          expectValidTree(*model);
          expectValidTree(Modeld(*model));
          expectAnswersOf(*model, vertices);
        }
        if (!refit && !is_update) {
          EXPECT_TRUE(sameTree(*model, built));
        }
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

/// Fits as ours does, but for nodes of at least so many triangles, which get a volume that it
/// keeps.
class StoringFitter final : public fcl::detail::BVFitter<kIOSd> {
 public:
  explicit StoringFitter(int least) : least_(least) {
    const std::vector<Vector3d> far = scenes::icosphere(20, 1).vertices;
    kios::fit(far.data(), static_cast<int>(far.size()), volume_);
  }
  kIOSd fit(unsigned int* primitives, int n) override {
    return n >= least_ ? volume_ : fcl::detail::BVFitter<kIOSd>::fit(primitives, n);
  }

 private:
  const int least_;
  kIOSd volume_;
};

TEST_F(Refit, VolumesThatAUsersFitterStores) {
  const int all = static_cast<int>(mesh_.triangles.size());
  for (const int least : {all, all / 2, 1}) {
    Modeld model;
    model.bv_fitter = std::make_shared<StoringFitter>(least);
    ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
    ASSERT_EQ(model.addSubModel(mesh_.vertices, mesh_.triangles), fcl::BVH_OK);
    ASSERT_EQ(model.endModel(), fcl::BVH_OK);
    for (int i = 0; i < 4; ++i) {
      replace(model, swayed(mesh_, i), i > 0, i % 2 == 0);
      expectValidTree(model);
      expectAnswersOf(model, swayed(mesh_, i));
    }
  }
}

// FCL's copy constructor lets copies share one fitter and one splitter.
TEST_F(Refit, CopiesRefitInTwoThreadsAsInOne) {
  const Mesh large = scenes::bumpyTorus(3000);
  const Modeld original(*kiosModel(large));
  const auto work = [&](Modeld& model, double phase) {
    for (int i = 0; i < 6; ++i) {
      model.build_state = fcl::BVH_BUILD_STATE_PROCESSED;  // lets replace follow update
      if (i % 3 == 2) {
        update(model, swayed(large, phase + i), false, false);
      } else {
        replace(model, swayed(large, phase + i), i % 3 == 1, false);
      }
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

}  // namespace
}  // namespace kios::testing
