// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry that FCL's calls take, or don't, in every state of a model, and whatever is done then:
// copies, refits, builds, conversions. The address sanitizer sees what is written past an array.

#include <gtest/gtest.h>

#include "fcl/expect_refused.h"
#include "model/bvh_check.h"
#include "model/deform.h"

namespace kios::testing {
namespace {

class AddedGeometry : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::internal::CaptureStderr(); }  // FCL's warnings
  void TearDown() override { ::testing::internal::GetCapturedStderr(); }

  std::shared_ptr<Modeld> updated() const {
    auto model = std::make_shared<Modeld>(*kiosModel(mesh_));
    update(*model, swayed(mesh_, 1), true, true);
    return model;
  }
  static std::vector<Vector3d> verticesOf(const Modeld& model) {
    return {model.vertices, model.vertices + model.num_vertices};
  }
  static std::vector<fcl::Triangle> trianglesOf(const Modeld& model) {
    return {model.tri_indices, model.tri_indices + model.num_tris};
  }
  double distance(const Modeld& model) const {
    fcl::DistanceResultd result;
    return fcl::distance(&model, here_, other_.get(), there_, fcl::DistanceRequestd(), result);
  }
  /// The model has a whole tree over its vertices, and answers as one that is built from them.
  void expectRight(const Modeld& model) const {
    expectValidTree(model);
    const auto fresh = kiosModel({verticesOf(model), trianglesOf(model)});
    EXPECT_EQ(distance(model), distance(*fresh));
    fcl::CollisionResultd contacts, expected;
    const fcl::CollisionRequestd request(kAllContacts);
    fcl::collide(&model, here_, other_.get(), near_, request, contacts);
    fcl::collide(fresh.get(), here_, other_.get(), near_, request, expected);
    EXPECT_EQ(contactPairs(contacts), contactPairs(expected));
  }
  void expectRefused(const Modeld& model) const {
    EXPECT_THROW(distance(model), std::invalid_argument);
    EXPECT_THROW(validate(model), std::invalid_argument);
    EXPECT_THROW(prepare(model), std::invalid_argument);
  }

  /// Ways to add: one triangle, many, a few vertices alone.
  static constexpr int kWays = 3;
  void add(Modeld& model, int way) const {
    if (way == 0) {
      EXPECT_EQ(model.addTriangle({0, 0, 2}, {1, 0, 2}, {0, 1, 2}), fcl::BVH_OK);
    } else if (way == 1) {
      std::vector<Vector3d> vertices = mesh_.vertices;
      for (Vector3d& p : vertices) p.z() += 2;
      EXPECT_EQ(model.addSubModel(vertices, mesh_.triangles), fcl::BVH_OK);
    } else {
      EXPECT_EQ(model.addSubModel(std::vector<Vector3d>(7, Vector3d(0.1, 0.2, 0.3))), fcl::BVH_OK);
    }
  }

  const Mesh mesh_ = scenes::bumpyTorus(200);
  const std::shared_ptr<Modeld> other_ = kiosModel(scenes::icosphere(0.5, 2));
  const fcl::Transform3d here_ = fcl::Transform3d::Identity(),
                         near_ = fcl::Transform3d(fcl::Translation3d(0.5, 0.3, 1)),
                         there_ = fcl::Transform3d(fcl::Translation3d(3, 2, 6));
};

TEST_F(AddedGeometry, ServesAfterEveryRefitAndBuild) {
  for (int way = 0; way < kWays; ++way) {
    for (const bool refit : {true, false}) {
      for (const bool bottomup : {true, false}) {
        const auto model = updated();
        add(*model, way);
        expectRefused(*model);
        for (int turn = 0; turn < 3; ++turn) {
          std::vector<Vector3d> vertices = verticesOf(*model);
          for (Vector3d& p : vertices) p.x() += 0.01;
          update(*model, vertices, refit, bottomup);
          EXPECT_EQ(verticesOf(*model), vertices);
          expectRight(*model);
          verticesChanged(*model);
          expectRight(*model);
          if (turn == 0) {
            add(*model, (way + 1) % kWays);
            expectRefused(*model);
          }
        }
      }
    }
  }
}

TEST_F(AddedGeometry, IsCopied) {
  for (int way = 0; way < kWays; ++way) {
    const auto model = updated();
    add(*model, way);
    Modeld copy(*model), again(copy);
    for (Modeld* const m : {&copy, &again}) {
      EXPECT_EQ(verticesOf(*m), verticesOf(*model));
      EXPECT_EQ(m->num_tris, model->num_tris);
      expectRefused(*m);
      update(*m, verticesOf(*m), way != 1, true);
      expectRight(*m);
      const Modeld built(*m);
      expectRight(built);
    }
  }
}

// In the middle of an update, of a replacement, and of a build.
TEST_F(AddedGeometry, IsTakenUpWhileAModelChanges) {
  for (int way = 0; way < kWays; ++way) {
    const auto updating = updated(), replacing = std::make_shared<Modeld>(*kiosModel(mesh_));
    ASSERT_EQ(updating->beginUpdateModel(), fcl::BVH_OK);
    ASSERT_EQ(replacing->beginReplaceModel(), fcl::BVH_OK);
    ASSERT_EQ(updating->updateVertex(mesh_.vertices[0]), fcl::BVH_OK);
    ASSERT_EQ(replacing->replaceVertex(mesh_.vertices[0]), fcl::BVH_OK);
    Modeld copy(*updating);  // goes on where the model is
    add(*updating, way);
    add(*replacing, way);
    const std::vector<Vector3d> rest(mesh_.vertices.begin() + 1, mesh_.vertices.end());
    ASSERT_EQ(copy.updateSubModel(rest), fcl::BVH_OK);
    ASSERT_EQ(copy.endUpdateModel(), fcl::BVH_OK);
    EXPECT_EQ(verticesOf(copy), mesh_.vertices);
    ASSERT_EQ(updating->updateSubModel(rest), fcl::BVH_OK);
    ASSERT_EQ(replacing->replaceSubModel(rest), fcl::BVH_OK);
    EXPECT_EQ(updating->endUpdateModel(), fcl::BVH_ERR_INCORRECT_DATA);
    EXPECT_EQ(replacing->endReplaceModel(), fcl::BVH_ERR_INCORRECT_DATA);
    expectRefused(*updating);
    expectRefused(*replacing);
    const auto added = verticesOf(*replacing);
    const std::vector<Vector3d> last(
        added.begin() + static_cast<std::ptrdiff_t>(mesh_.vertices.size()), added.end());
    ASSERT_EQ(updating->updateSubModel(last), fcl::BVH_OK);
    ASSERT_EQ(replacing->replaceSubModel(last), fcl::BVH_OK);
    ASSERT_EQ(updating->endUpdateModel(), fcl::BVH_OK);
    ASSERT_EQ(replacing->endReplaceModel(), fcl::BVH_OK);
    expectRight(*updating);
    expectRight(*replacing);
  }
}

// As many triangles as the cloud has points would make a tree of just as many nodes.
TEST_F(AddedGeometry, ToAPointCloud) {
  Modeld cloud;
  ASSERT_EQ(cloud.beginModel(), fcl::BVH_OK);
  ASSERT_EQ(cloud.addSubModel(mesh_.vertices), fcl::BVH_OK);
  ASSERT_EQ(cloud.endModel(), fcl::BVH_OK);
  update(cloud, mesh_.vertices, true, true);
  std::vector<fcl::Triangle> triangles(mesh_.vertices.size(), fcl::Triangle(0, 1, 2));
  ASSERT_EQ(cloud.addSubModel({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles), fcl::BVH_OK);
  expectRefused(cloud);
  update(cloud, verticesOf(cloud), true, true);
  expectRight(cloud);
}

TEST_F(AddedGeometry, IsRefusedWhereNothingWasBegun) {
  Modeld fresh, built(*kiosModel(mesh_)), reset(built);
  EXPECT_EQ(reset.beginModel(), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
  for (Modeld* const model : {&fresh, &reset, &built}) {
    const int before = model->num_vertices;
    EXPECT_EQ(model->addVertex({0, 0, 0}), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
              fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->addSubModel(mesh_.vertices), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->addSubModel(mesh_.vertices, mesh_.triangles),
              fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->replaceVertex({0, 0, 0}), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->updateVertex({0, 0, 0}), fcl::BVH_ERR_BUILD_OUT_OF_SEQUENCE);
    EXPECT_EQ(model->num_vertices, before);
  }
  expectRight(built);
}

// FCL writes past its array where more vertices are given than there are.
TEST_F(AddedGeometry, NoMoreVerticesAreTakenThanThereAre) {
  std::vector<Vector3d> more = mesh_.vertices;
  more.emplace_back(0, 0, 0);
  for (const bool is_update : {true, false}) {
    Modeld model(*kiosModel(mesh_));
    const auto give = [&](const std::vector<Vector3d>& v) {
      return is_update ? model.updateSubModel(v) : model.replaceSubModel(v);
    };
    const auto giveOne = [&] {
      return is_update ? model.updateVertex({0, 0, 0}) : model.replaceVertex({0, 0, 0});
    };
    const auto giveThree = [&] {
      return is_update ? model.updateTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})
                       : model.replaceTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    };
    ASSERT_EQ(is_update ? model.beginUpdateModel() : model.beginReplaceModel(), fcl::BVH_OK);
    EXPECT_EQ(give(more), fcl::BVH_ERR_INCORRECT_DATA);
    EXPECT_EQ(give({mesh_.vertices.begin(), mesh_.vertices.end() - 1}), fcl::BVH_OK);
    EXPECT_EQ(giveThree(), fcl::BVH_ERR_INCORRECT_DATA);
    EXPECT_EQ(give({mesh_.vertices.back()}), fcl::BVH_OK);
    EXPECT_EQ(giveOne(), fcl::BVH_ERR_INCORRECT_DATA);
    EXPECT_EQ(give(mesh_.vertices), fcl::BVH_ERR_INCORRECT_DATA);
    ASSERT_EQ(is_update ? model.endUpdateModel() : model.endReplaceModel(), fcl::BVH_OK);
    EXPECT_EQ(verticesOf(model), mesh_.vertices);
    expectRight(model);
  }
}

// One of the model's own vertices may be what is added, while the array moves.
TEST_F(AddedGeometry, OfTheModelsOwn) {
  Modeld model;
  ASSERT_EQ(model.beginModel(1, 1), fcl::BVH_OK);
  model.addVertex({1, 2, 3});
  for (int i = 0; i < 40; ++i) {
    ASSERT_EQ(model.addVertex(model.vertices[0]), fcl::BVH_OK);
    ASSERT_EQ(model.addTriangle(model.vertices[0], model.vertices[1], model.vertices[0]),
              fcl::BVH_OK);
  }
  for (const Vector3d& p : verticesOf(model)) EXPECT_EQ(p, Vector3d(1, 2, 3));
}

TEST_F(AddedGeometry, IndicesOutOfRangeAreRefused) {
  for (const std::size_t wrong : {mesh_.vertices.size(), std::size_t{1} << 40, ~std::size_t{0}}) {
    std::vector<fcl::Triangle> triangles = mesh_.triangles;
    triangles[5].set(0, wrong, 1);
    Modeld model;
    ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
    ASSERT_EQ(model.addSubModel(mesh_.vertices, triangles), fcl::BVH_OK);
    EXPECT_THROW(model.endModel(), std::invalid_argument);
    expectRefused(model);
    const auto added = updated();
    ASSERT_EQ(added->addSubModel(mesh_.vertices, triangles), fcl::BVH_OK);
    ASSERT_EQ(added->beginUpdateModel(), fcl::BVH_OK);
    ASSERT_EQ(added->updateSubModel(verticesOf(*added)), fcl::BVH_OK);
    EXPECT_THROW(added->endUpdateModel(), std::invalid_argument);
    expectRefused(*added);
    const Modeld copy(*added);
    expectRefused(copy);
  }
}

// A build that a vertex ended leaves half a tree, which no refit may walk.
TEST_F(AddedGeometry, AFailedBuildIsBuiltAgain) {
  for (const bool bottomup : {true, false}) {
    Modeld model(*kiosModel(mesh_));
    model.bv_splitter.reset(new fcl::detail::BVSplitter<kIOSd>(fcl::detail::SPLIT_METHOD_MEAN));
    std::vector<Vector3d> vertices = swayed(mesh_, 1);
    vertices.back().x() = std::nan("");
    ASSERT_EQ(model.beginReplaceModel(), fcl::BVH_OK);
    ASSERT_EQ(model.replaceSubModel(vertices), fcl::BVH_OK);
    EXPECT_THROW(model.endReplaceModel(false), std::invalid_argument);
    model.vertices[model.num_vertices - 1] = mesh_.vertices.back();
    ASSERT_EQ(model.endReplaceModel(true, bottomup), fcl::BVH_OK);
    expectRight(model);
  }
}

TEST_F(AddedGeometry, OfForeignModelsIsNotConverted) {
  const auto model = scenes::buildModel<fcl::OBBRSSd>(mesh_);
  model->beginUpdateModel();
  model->updateSubModel(mesh_.vertices);
  model->endUpdateModel();
  ASSERT_EQ(model->addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), fcl::BVH_OK);
  testing::expectRefused([&] { toKIOS(*model); }, "build it anew from beginModel()");
}

}  // namespace
}  // namespace kios::testing
