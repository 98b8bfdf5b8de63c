// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// engineServes() promises, of root volumes alone, that the engine takes a pair: else which of
// nearly equally near triangles is named would depend on who prepared the models.

#include <gtest/gtest.h>

#include "fcl_kios/fcl_kios.h"
#include "model/prepared.h"
#include "query/pair_search.h"
#include "scenes/cad_shapes.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"
#include "scenes/triangle_families.h"
#include "search/float_frame.h"

namespace kios::testing {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Mesh;

/// Counts pairs at distances at which the engine just serves, and just doesn't.
struct Tally {
  int promised = 0, refused = 0;
};

void expectKept(const Modeld& a, const Modeld& b, const Transform3d& X, Tally& tally) {
  const MeshPair<double> frame(a, Transform3d::Identity(), b, X);
  engine::TreePose pair;
  const auto tree_a = preparedTree(a), tree_b = preparedTree(b);
  const bool served = tree_a && tree_b && engine::makeTreePose(*tree_a, *tree_b, frame.X_AB, pair);
  if (!engineServes(frame)) {
    ++tally.refused;
    return;
  }
  ++tally.promised;
  EXPECT_TRUE(served) << X.translation().transpose();
}

Transform3d farPose(scenes::Random& random) {
  Transform3d X = Transform3d::Identity();
  X.linear() = scenes::rotation(random);
  X.translation() = std::exp2(random.uniform(2, 24)) * scenes::direction(random);
  return X;
}

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> all = {scenes::subdividedBox({1, 1, 1}, 1),
                                        scenes::sheet(1, 0.5, 4, 3, 0), scenes::icosphere(1, 1),
                                        scenes::stripCylinder(12, 0.6, 0.004)};
  return all;
}

TEST(EngineServes, BuiltModels) {
  scenes::Random random(5);
  Tally tally;
  for (int i = 0; i < 2000; ++i) {
    const Mesh& mesh = meshes()[i % meshes().size()];
    const auto a = makeModel<double>(mesh.vertices, mesh.triangles),
               b = makeModel<double>(mesh.vertices, mesh.triangles);
    expectKept(*a, *b, farPose(random), tally);
  }
  EXPECT_GT(tally.promised, 500);
  EXPECT_GT(tally.refused, 200);
}

// An update's root volume holds the vertices before it, too, and a bottom-up refit merges volumes:
// either may be hundreds of times as large as the content.
TEST(EngineServes, UpdatedModels) {
  scenes::Random random(7);
  Tally tally;
  for (int i = 0; i < 2000; ++i) {
    const Mesh& mesh = meshes()[i % meshes().size()];
    const auto a = makeModel<double>(mesh.vertices, mesh.triangles),
               b = makeModel<double>(mesh.vertices, mesh.triangles);
    const Vector3d far = std::exp2(random.uniform(0, 14)) * scenes::direction(random);
    for (Modeld* const model : {a.get(), b.get()}) {
      for (const double by : {std::exp2(random.uniform(0, 10)), 1.0}) {
        std::vector<Vector3d> vertices;
        for (const Vector3d& p : mesh.vertices) vertices.push_back(far + by * p);
        model->beginUpdateModel();
        model->updateSubModel(vertices);
        model->endUpdateModel(true, i % 2 == 0);
      }
    }
    expectKept(*a, *b, farPose(random), tally);
  }
  EXPECT_GT(tally.promised, 500);
  EXPECT_GT(tally.refused, 200);
}

}  // namespace
}  // namespace kios::testing
