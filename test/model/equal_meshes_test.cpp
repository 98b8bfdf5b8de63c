// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A build takes the volumes of a living model of equal content. It is as if it had not.

#include <gtest/gtest.h>

#include <atomic>
#include <list>

#include "fcl/mesh_cases.h"
#include "fcl_kios/paper.h"
#include "model/bvh_check.h"
#include "model/deform.h"
#include "model/prepared.h"
#include "together.h"

namespace kios::testing {
namespace {

using Nodes = std::vector<fcl::BVNode<kIOSd>>;

class EqualMeshes : public ::testing::Test {
 protected:
  /// Whether the model answers as the oracle does for these vertices.
  void expectAnswersOf(const Modeld& model, const std::vector<Vector3d>& vertices) const {
    EXPECT_EQ(wrongAnswers(model, vertices), 0);
  }
  int wrongAnswers(const Modeld& model, const std::vector<Vector3d>& vertices) const {
    int wrong = 0;
    const scenes::MeshOracle oracle({vertices, mesh_.triangles}, other_mesh_);
    for (const Frame& frame : frames_) {
      fcl::DistanceResultd result;
      const double found = fcl::distance(&model, frame.X_WA, other_.get(), frame.X_WB,
                                         fcl::DistanceRequestd(), result);
      wrong += std::abs(found - static_cast<double>(oracle.distance(frame.X_WA, frame.X_WB))) >
               1e-13 * sizeOf(mesh_, other_mesh_);
    }
    return wrong;
  }

  const Mesh mesh_ = scenes::bumpyTorus(300), other_mesh_ = scenes::icosphere(0.5, 1);
  const std::shared_ptr<Modeld> other_ = kiosModel(other_mesh_);
  const std::vector<Frame> frames_ = randomFrames(4, 1.5, 17);
  const Nodes built_ = nodesOf(*kiosModel(mesh_));  // while no other lives
};

TEST_F(EqualMeshes, InAnyOrderOfTheirLives) {
  std::list<std::shared_ptr<Modeld>> models;
  for (int i = 0; i < 40; ++i) {
    models.push_back(kiosModel(mesh_));
    if (i % 3 == 0) models.push_back(std::make_shared<Modeld>(*models.front()));
    if (i % 4 == 3) models.pop_front();
    if (i % 7 == 6) models.erase(std::next(models.begin()));
    if (i % 11 == 10) models.clear();
    for (const auto& model : models) ASSERT_TRUE(sameTree(*model, built_)) << i;
  }
  models.remove_if([n = 0](const auto&) mutable { return ++n > 1; });
  expectAnswersOf(*models.front(), mesh_.vertices);
}

// A model that moves, is built anew or is written to is no longer what it was.
TEST_F(EqualMeshes, OneMoves) {
  const auto vertices = swayed(mesh_, 1);
  const Nodes built_there = nodesOf(*kiosModel({vertices, mesh_.triangles}));
  for (int way = 0; way < 6; ++way) {
    const auto moving = kiosModel(mesh_);
    if (way < 2) replace(*moving, vertices, true, way == 0);
    if (way == 2) replace(*moving, vertices, false, true);
    if (way == 3) update(*moving, vertices, true, true);
    if (way == 4) std::copy(vertices.begin(), vertices.end(), moving->vertices);
    if (way == 5) {
      std::copy(vertices.begin(), vertices.end(), moving->vertices);
      verticesChanged(*moving);
    }
    if (way != 3 && way != 4) expectAnswersOf(*moving, vertices);
    const auto still = kiosModel(mesh_), there = kiosModel({vertices, mesh_.triangles});
    EXPECT_TRUE(sameTree(*still, built_)) << way;
    EXPECT_TRUE(sameTree(*there, built_there)) << way;
    expectAnswersOf(*still, mesh_.vertices);
    expectAnswersOf(*there, vertices);
  }
}

TEST_F(EqualMeshes, OtherTreesAreNotCopied) {
  const auto tuned = kiosModel(mesh_);
  for (const bool published : {true, false}) {
    Modeld model;
    if (published) {
      model.bv_fitter.reset(new PaperFitter<double>(FitMethod::kMethodII));
    } else {
      model.bv_splitter.reset(new fcl::detail::BVSplitter<kIOSd>(fcl::detail::SPLIT_METHOD_MEDIAN));
    }
    model.beginModel();
    model.addSubModel(mesh_.vertices, mesh_.triangles);
    model.endModel();
    EXPECT_FALSE(sameTree(model, built_)) << published;
    EXPECT_TRUE(sameTree(*kiosModel(mesh_), built_)) << published;
  }
  Modeld cloud;
  cloud.beginModel();
  cloud.addSubModel(mesh_.vertices);
  cloud.endModel();
  EXPECT_EQ(cloud.getNumBVs(), 2 * static_cast<int>(mesh_.vertices.size()) - 1);
}

// Equal models and copies hold one tree, each as long as its content is that.
TEST_F(EqualMeshes, ShareATree) {
  const Mesh& mesh = mesh_;
  const auto a = kiosModel(mesh), b = kiosModel(mesh);
  const auto copy = std::make_shared<Modeld>(*a);
  const engine::Tree* const tree = &treeOf(*a);
  for (const auto& model : {b, copy}) {
    EXPECT_EQ(&treeOf(*model), tree);
  }
  // One that moved has its own, made of the shared one; the others keep theirs.
  Mesh moved = mesh;
  moved.vertices[0] += Vector3d(1e-3, 0, 0);
  b->beginReplaceModel();
  b->replaceSubModel(moved.vertices);
  b->endReplaceModel();
  EXPECT_NE(&treeOf(*b), tree);
  EXPECT_EQ(&treeOf(*a), tree);
  EXPECT_EQ(&treeOf(*kiosModel(mesh)), tree);
  EXPECT_NE(&treeOf(*kiosModel(moved)), &treeOf(*b));
}

// Models that others copy from go, move and are built anew while threads build.
TEST_F(EqualMeshes, InManyThreads) {
  std::atomic<int> wrong{0};
  together(10, [&](int t) {
    std::list<std::shared_ptr<Modeld>> mine;
    for (int i = 0; i < 60; ++i) {
      mine.push_back(i % 5 == 4 ? std::make_shared<Modeld>(*mine.back()) : kiosModel(mesh_));
      wrong += !sameTree(*mine.back(), built_);
      if (i % 5 == t % 5) wrong += wrongAnswers(*mine.back(), mesh_.vertices);
      if (i % 4 == 3) {
        replace(*mine.front(), swayed(mesh_, t), i % 8 == 3, i % 16 == 3);
        if (i % 5 == t % 5) wrong += wrongAnswers(*mine.front(), swayed(mesh_, t));
      }
      if (mine.size() > 3 || i % 4 == 3) mine.pop_front();
    }
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
