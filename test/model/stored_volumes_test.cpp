// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A user's fitter may return a volume that it keeps. Whatever is
// remembered of a model must not take that for the model's state.

#include <gtest/gtest.h>

#include "model/deform.h"
#include "scenes/foreign_fitter.h"

namespace kios::testing {
namespace {

/// Returns a volume around all that the test's models ever are.
kIOSd reach() {
  std::vector<Vector3d> box;
  for (int i = 0; i < 8; ++i) {
    box.emplace_back((i & 1) != 0 ? 9 : -9, (i & 2) != 0 ? 9 : -9, (i & 4) != 0 ? 9 : -9);
  }
  kIOSd volume;
  fit(box.data(), 8, volume);
  return volume;
}

/// Fits as ours does, but for nodes of at least so many triangles, which get the stored volume.
class DerivedFitter final : public fcl::detail::BVFitter<kIOSd> {
 public:
  explicit DerivedFitter(int least) : least_(least) {}
  kIOSd fit(unsigned int* primitives, int n) override {
    return n >= least_ ? volume_ : fcl::detail::BVFitter<kIOSd>::fit(primitives, n);
  }

 private:
  const int least_;
  const kIOSd volume_ = reach();
};

/// Does so by FCL's interface alone.
class PlainFitter final : public fcl::detail::BVFitterBase<kIOSd> {
 public:
  explicit PlainFitter(int least) : least_(least) {}
  void set(Vector3d* v, fcl::Triangle* t, fcl::BVHModelType type) override {
    fitter_.set(v, t, type);
  }
  void set(Vector3d* v, Vector3d* previous, fcl::Triangle* t, fcl::BVHModelType type) override {
    fitter_.set(v, previous, t, type);
  }
  kIOSd fit(unsigned int* primitives, int n) override {
    return n >= least_ ? volume_ : fitter_.fit(primitives, n);
  }
  void clear() override { fitter_.clear(); }

 private:
  const int least_;
  const kIOSd volume_ = reach();
  scenes::ForeignFitter<kIOSd> fitter_;
};

class StoredVolumes : public ::testing::TestWithParam<bool> {
 protected:
  std::shared_ptr<fcl::detail::BVFitterBase<kIOSd>> fitter(int least) const {
    if (GetParam()) return std::make_shared<DerivedFitter>(least);
    return std::make_shared<PlainFitter>(least);
  }
  std::shared_ptr<Modeld> build(int least) const {
    auto model = std::make_shared<Modeld>();
    model->bv_fitter = fitter(least);
    EXPECT_EQ(model->beginModel(), fcl::BVH_OK);
    EXPECT_EQ(model->addSubModel(mesh_.vertices, mesh_.triangles), fcl::BVH_OK);
    EXPECT_EQ(model->endModel(), fcl::BVH_OK);
    return model;
  }
  /// Every query over the model, and those that remember it, answer for these vertices.
  void expectAnswersOf(const Modeld& model, const std::vector<Vector3d>& vertices) {
    const auto fresh = kiosModel({vertices, mesh_.triangles});
    fcl::DistanceResultd result, expected;
    const fcl::DistanceRequestd request;
    const double d = fcl::distance(fresh.get(), here_, other_.get(), there_, request, expected);
    // Volumes of another fit let the search come upon another of equally near features.
    const double own = fcl::distance(&model, here_, other_.get(), there_, request, result);
    EXPECT_NEAR(own, d, 1e-14);
    fcl::CollisionResultd contacts, all;
    fcl::collide(&model, here_, other_.get(), there_, fcl::CollisionRequestd(kAllContacts),
                 contacts);
    fcl::collide(fresh.get(), here_, other_.get(), there_, fcl::CollisionRequestd(kAllContacts),
                 all);
    EXPECT_EQ(contactPairs(contacts), contactPairs(all));
    const auto closest = scene_.closestPair();
    ASSERT_TRUE(closest.has_value());
    EXPECT_EQ(closest->distance, own);
    EXPECT_EQ(scene_.pairsWithin(1).size(), d <= 1 ? 1U : 0U);
  }

  const Mesh mesh_ = scenes::bumpyTorus(300);
  const std::shared_ptr<Modeld> other_ = kiosModel(scenes::icosphere(0.5, 1));
  const fcl::Transform3d here_ = fcl::Transform3d::Identity(),
                         there_ = fcl::Transform3d(fcl::Translation3d(0, 0, 3));
  SceneDistanced scene_;
};

TEST_P(StoredVolumes, OfChangedModelsAreOthers) {
  const int all = static_cast<int>(mesh_.triangles.size());
  for (const int least : {all, all / 2, 2}) {
    for (const bool refit : {true, false}) {
      for (const bool bottomup : {true, false}) {
        const auto replaced = build(least), updated = build(least);
        for (const auto& model : {replaced, updated}) {
          scene_ = SceneDistanced();
          scene_.add(model, here_);
          scene_.add(other_, there_);
          expectAnswersOf(*model, mesh_.vertices);
          for (const double height : {1.5, 2.5, 0.0, 3.0}) {
            std::vector<Vector3d> vertices = swayed(mesh_, height);
            for (Vector3d& p : vertices) p.z() += height;
            if (model == replaced) {
              replace(*model, vertices, refit, bottomup);
            } else {
              update(*model, vertices, refit, bottomup);
            }
            expectAnswersOf(*model, vertices);
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fitters, StoredVolumes, ::testing::Bool());

// A model of one triangle has a root that is a leaf.
TEST(StoredVolume, OfOneTriangle) {
  Modeld model;
  model.bv_fitter = std::make_shared<DerivedFitter>(1);
  model.beginModel();
  model.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  ASSERT_EQ(model.endModel(), fcl::BVH_OK);
  const auto other = kiosModel(scenes::singleTriangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}));
  const fcl::Transform3d I = fcl::Transform3d::Identity();
  fcl::DistanceResultd result;
  EXPECT_EQ(fcl::distance(&model, I, other.get(), I, fcl::DistanceRequestd(), result), 1);
  for (const double z : {0.5, 0.25, -1.0}) {
    replace(model, {{0, 0, z}, {1, 0, z}, {0, 1, z}}, true, z > 0.4);
    fcl::DistanceResultd moved;
    EXPECT_EQ(fcl::distance(&model, I, other.get(), I, fcl::DistanceRequestd(), moved), 1 - z);
  }
}

}  // namespace
}  // namespace kios::testing
