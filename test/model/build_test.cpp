// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::BVHModel over k-IOS, built by FCL's calls: every splitter, fitter and kind of mesh.

#include <gtest/gtest.h>

#include <cmath>

#include "fcl/mesh_cases.h"
#include "model/bvh_check.h"
#include "paper/all_fits.h"
#include "scenes/foreign_fitter.h"

namespace kios::testing {
namespace {

using fcl::detail::BVFitter;
using fcl::detail::BVSplitter;
using fcl::detail::BVSplitterBase;
using fcl::detail::SplitMethodType;

constexpr SplitMethodType kSplits[] = {fcl::detail::SPLIT_METHOD_MEAN,
                                       fcl::detail::SPLIT_METHOD_MEDIAN,
                                       fcl::detail::SPLIT_METHOD_BV_CENTER};
const std::vector<FitOptions> kFits = testing::allFits();

template <typename S>
void fill(Model<S>& model, const Mesh& mesh) {
  std::vector<fcl::Vector3<S>> vertices;
  for (const Vector3d& p : mesh.vertices) vertices.push_back(p.cast<S>());
  ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
  ASSERT_EQ(model.addSubModel(vertices, mesh.triangles), fcl::BVH_OK);
  ASSERT_EQ(model.endModel(), fcl::BVH_OK);
}

std::vector<Mesh> buildCases() {
  std::vector<Mesh> meshes;
  for (const MeshCase& pair : meshCases()) meshes.insert(meshes.end(), {pair.a, pair.b});
  for (const NamedMesh& named : unitMeshes()) meshes.push_back(named.mesh);
  Mesh concentric;  // all centroids at the origin, exactly
  for (double r = 1; r <= 40; ++r) addTriangle(concentric, {r, 0, r}, {-r, r, 0}, {0, -r, -r});
  meshes.push_back(concentric);
  return meshes;
}

TEST(Build, EverySplitterAndFitterGivesAValidTree) {
  for (const Mesh& mesh : buildCases()) {
    for (const SplitMethodType split : kSplits) {
      for (const FitOptions& fit : kFits) {
        Modeld model;
        model.bv_splitter.reset(new BVSplitter<kIOSd>(split));
        model.bv_fitter.reset(new PaperFitter<double>(fit));
        fill(model, mesh);
        expectValidTree(model);
        Modelf in_float;
        in_float.bv_splitter.reset(new BVSplitter<kIOSf>(split));
        in_float.bv_fitter.reset(new PaperFitter<float>(fit));
        fill(in_float, mesh);
        expectValidTree(in_float);
      }
    }
  }
}

TEST(Build, OffsetAndScaledMeshes) {
  for (const double scale : {1e-100, 1e-6, 1.0, 1e100}) {
    for (const double offset : {0.0, 1e3, 1e9, 1e12}) {
      Mesh mesh = scenes::bumpyTorus(140);
      for (Vector3d& p : mesh.vertices) p = scale * (p + Vector3d(offset, -offset, offset / 2));
      Modeld model;
      fill(model, mesh);
      expectValidTree(model);
    }
  }
}

TEST(Build, FittersOfNoAngleAreRefused) {
  FitOptions options;
  options.angle = 0;
  EXPECT_THROW(PaperFitter<double>{options}, std::invalid_argument);
}

// Crowded at one end, where median, mean and centre are far apart.
TEST(Build, EachSplitterSplitsWhereItSays) {
  constexpr int kCount = 200;
  Mesh mesh;
  for (int i = 0; i < kCount; ++i) {
    const double x = std::pow(i / (kCount - 1.0), 4);  // mean 1/5, so 2/3 of them lie below it
    mesh.vertices.insert(mesh.vertices.end(),
                         {Vector3d(x, 0, 0), Vector3d(x, 1e-3, 0), Vector3d(x, 0, 1e-3)});
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const auto largerPart = [&](SplitMethodType split) {
    Modeld model;
    model.bv_splitter.reset(new BVSplitter<kIOSd>(split));
    fill(model, mesh);
    const int left = model.getBV(model.getBV(0).leftChild()).num_primitives;
    return std::max(left, kCount - left);
  };
  EXPECT_EQ(largerPart(fcl::detail::SPLIT_METHOD_MEDIAN), kCount / 2);
  EXPECT_NEAR(largerPart(fcl::detail::SPLIT_METHOD_MEAN), std::pow(0.2, 0.25) * kCount, 3);
  EXPECT_NEAR(largerPart(fcl::detail::SPLIT_METHOD_BV_CENTER), std::pow(0.5, 0.25) * kCount, 3);
}

TEST(Build, LocalBoxIsThatOfTheVertices) {
  for (const Mesh& mesh : buildCases()) {
    Modeld ours;
    fill(ours, mesh);
    ours.computeLocalAABB();
    const auto theirs = scenes::buildModel<fcl::OBBRSSd>(mesh);
    theirs->computeLocalAABB();
    EXPECT_EQ(ours.aabb_local.min_, theirs->aabb_local.min_);
    EXPECT_EQ(ours.aabb_local.max_, theirs->aabb_local.max_);
    EXPECT_EQ(ours.aabb_center, theirs->aabb_center);
    EXPECT_EQ(ours.aabb_radius, theirs->aabb_radius);
  }
}

TEST(Build, TrianglesOneByOneAndSeveralSubModels) {
  const Mesh mesh = scenes::bumpyTorus(140);
  Modeld model;
  ASSERT_EQ(model.beginModel(0, 0), fcl::BVH_OK);
  for (std::size_t i = 0; i < 70; ++i) {
    const auto c = corners(mesh, i);
    ASSERT_EQ(model.addTriangle(c[0], c[1], c[2]), fcl::BVH_OK);
  }
  ASSERT_EQ(model.addSubModel(mesh.vertices, mesh.triangles), fcl::BVH_OK);
  ASSERT_EQ(model.endModel(), fcl::BVH_OK);
  EXPECT_EQ(model.num_tris, 70 + static_cast<int>(mesh.triangles.size()));
  expectValidTree(model);
}

/// A copy of a model that was begun goes on as the model would, also where nothing was added yet.
TEST(Build, CopiesOfBegunModelsGoOn) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<fcl::Triangle> triangles = {{0, 1, 2}};
  for (const int added : {0, 1, 2}) {
    for (const int way : {0, 1, 2}) {
      Modeld begun;
      ASSERT_EQ(begun.beginModel(added, added), fcl::BVH_OK);
      for (int i = 0; i < added; ++i) begun.addTriangle(corners[0], corners[1], corners[2]);
      Modeld copy(begun);
      for (int i = 0; way == 0 && i < 9; ++i) copy.addTriangle(corners[0], corners[1], corners[2]);
      for (int i = 0; way == 1 && i < 9; ++i) copy.addVertex(corners[i % 3]);
      for (int i = 0; way == 2 && i < 9; ++i) copy.addSubModel(corners, triangles);
      ASSERT_EQ(copy.endModel(), fcl::BVH_OK);
      EXPECT_EQ(copy.num_vertices, 3 * added + (way == 1 ? 9 : 27));
      const bool cloud = way == 1 && added == 0;  // whose points get triangles
      EXPECT_EQ(copy.num_tris, cloud ? 9 : added + (way == 1 ? 0 : 9));
      for (int i = 0; i < copy.num_vertices; ++i) EXPECT_EQ(copy.vertices[i], corners[i % 3]);
    }
  }
}

/// Left child's triangles; the right one has the rest.
int leftCount(const Modeld& model) {
  return model.getBV(model.getBV(0).leftChild()).num_primitives;
}

TEST(Build, ModelsSplitByCostUnlessTheyAreTold) {
  // Two parts far apart, one of far more triangles: the mean of the centroids lies in it.
  const Mesh large = scenes::bumpyTorus(1000), small = scenes::icosphere(1, 1);
  const Mesh mesh = scenes::merged({large, transformed(small, 1, {4, 0, 0})});
  Modeld by_cost, by_mean;
  by_mean.bv_splitter.reset(new BVSplitter<kIOSd>(fcl::detail::SPLIT_METHOD_MEAN));
  fill(by_cost, mesh);
  fill(by_mean, mesh);
  const int part = static_cast<int>(small.triangles.size());
  const int left = leftCount(by_cost);
  EXPECT_TRUE(left == part || left == by_cost.num_tris - part) << left;
  EXPECT_NE(leftCount(by_mean), left);
}

// A splitter as a user may write it.
class SplitAtCenterAlongX final : public BVSplitterBase<kIOSd> {
 public:
  void set(Vector3d*, fcl::Triangle*, fcl::BVHModelType) override {}
  void computeRule(const kIOSd& bv, unsigned int*, int) override { x_ = bv.center()[0]; }
  bool apply(const Vector3d& q) const override { return q[0] > x_; }
  void clear() override {}

 private:
  double x_ = 0;
};

TEST(Build, UsersFittersAndSplittersMix) {
  const MeshCase pair = meshCases().front();
  const auto plain_a = kiosModel(pair.a), plain_b = kiosModel(pair.b);
  for (const bool own_fitter : {false, true}) {
    for (const bool own_splitter : {false, true}) {
      Modeld a, b;
      for (Modeld* model : {&a, &b}) {
        if (own_fitter) model->bv_fitter = std::make_shared<scenes::ForeignFitter<kIOSd>>();
        if (own_splitter) model->bv_splitter = std::make_shared<SplitAtCenterAlongX>();
      }
      fill(a, pair.a);
      fill(b, pair.b);
      expectValidTree(a);
      expectValidTree(b);
      if (own_fitter && !own_splitter) {
        EXPECT_EQ(a.getBV(0).num_primitives, a.num_tris);
      }
      for (const Frame& frame : randomFrames(20, pair.spread, 51)) {
        fcl::DistanceResultd result, expected;
        const fcl::DistanceRequestd request;
        const double extent = scenes::extent(pair.a) + scenes::extent(pair.b);
        EXPECT_NEAR(
            fcl::distance(&a, frame.X_WA, &b, frame.X_WB, request, result),
            fcl::distance(plain_a.get(), frame.X_WA, plain_b.get(), frame.X_WB, request, expected),
            16 * std::numeric_limits<double>::epsilon() * extent);
      }
    }
  }
}

// The median of equal heights must not leave one side empty for ever.
TEST(Build, DepthOfDegenerateMeshesIsLogarithmic) {
  const Mesh same = repeated(1 << 12);
  for (const SplitMethodType split : kSplits) {
    Modeld model;
    model.bv_splitter.reset(new BVSplitter<kIOSd>(split));
    fill(model, same);
    int depth = 0;
    for (int node = 0; !model.getBV(node).isLeaf(); node = model.getBV(node).rightChild()) ++depth;
    EXPECT_LE(depth, 13);
  }
}

}  // namespace
}  // namespace kios::testing
