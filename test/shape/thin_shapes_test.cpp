// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Shapes that are segments, disks, sheets or points, or thinner than floats tell from these, beside
// meshes with vertices on their axes: a prepared model's answers are those of FCL's tree.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

std::vector<std::unique_ptr<fcl::CollisionGeometryd>> thinShapes() {
  std::vector<std::unique_ptr<fcl::CollisionGeometryd>> shapes;
  const double lengths[] = {0, 1e-320, 1e-46, 1e-42, 1e-30, 1e-12, 0.3};
  for (const double r : lengths) {
    shapes.push_back(std::make_unique<fcl::Sphered>(r));
    for (const double l : lengths) {
      shapes.push_back(std::make_unique<fcl::Coned>(r, l));
      shapes.push_back(std::make_unique<fcl::Cylinderd>(r, l));
      shapes.push_back(std::make_unique<fcl::Capsuled>(r, l));
      shapes.push_back(std::make_unique<fcl::Boxd>(r, l, 0.2));
      shapes.push_back(std::make_unique<fcl::Ellipsoidd>(0.2, r, l));
    }
  }
  return shapes;
}

Transform3d poseOf(int i, scenes::Random& random) {
  Transform3d X = Transform3d::Identity();
  if (i % 2 == 0) {  // along an axis of the shape, either way
    X.translation()[i / 2 % 3] = (i % 4 == 0 ? 1 : -1) * random.uniform(0, 2);
  } else {
    X.translation() = Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    X.linear() = Eigen::AngleAxisd(random.uniform(-3, 3), Vector3d(0.6, 0, 0.8)).matrix();
  }
  return X;
}

struct Answer {
  double distance;
  bool touch;
};

Answer ask(const Modeld& model, const Transform3d& X, const fcl::CollisionGeometryd& shape) {
  fcl::DistanceResultd distance;
  fcl::CollisionResultd contacts;
  fcl::distance(&model, X, &shape, Transform3d::Identity(), fcl::DistanceRequestd(), distance);
  fcl::collide(&model, X, &shape, Transform3d::Identity(), fcl::CollisionRequestd(), contacts);
  return {distance.min_distance, contacts.isCollision()};
}

TEST(ThinShapes, AnswersDontDependOnThePreparedTree) {
  constexpr int kPoses = 24;
  const auto shapes = thinShapes();
  for (const scenes::Mesh& mesh :
       {scenes::subdividedBox({0.1, 0.2, 0.3}, 2),
        scenes::singleTriangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0.05})}) {
    // Models that were asked nothing yet; equal ones would share a tree that one of them has.
    std::vector<Transform3d> poses;
    std::vector<Answer> answers;
    scenes::Random random(4);
    for (const auto& shape : shapes) {
      for (int i = 0; i < kPoses; ++i) {
        poses.push_back(poseOf(i, random));
        answers.push_back(ask(*makeModel(mesh.vertices, mesh.triangles), poses.back(), *shape));
        EXPECT_LT(answers.back().distance, 4);
      }
    }
    const auto model = makeModel(mesh.vertices, mesh.triangles);
    prepare(*model);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      SCOPED_TRACE(k);
      const Answer answer = ask(*model, poses[k], *shapes[k / kPoses]);
      EXPECT_EQ(answer.distance, answers[k].distance);
      EXPECT_EQ(answer.touch, answers[k].touch);
    }
  }
}

}  // namespace
}  // namespace kios::testing
