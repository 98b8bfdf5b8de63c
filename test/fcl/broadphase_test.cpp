// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every broadphase manager of FCL with FCL's default callbacks, against the oracle over all pairs.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <tuple>

#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

// Bodies with a geometry each, so that a contact tells which two they are.
class Scene {
 public:
  Scene(int count, double spread, std::uint64_t seed) {
    const std::vector<Mesh> shapes{scenes::icosphere(0.5, 1), scenes::bumpyTorus(100),
                                   scenes::sheet(1, 1, 3, 3, 0.2),
                                   scenes::randomSoup(20, 0.5, 0.05, 0.5, 9)};
    const auto poses = scenes::randomPoses(count, spread, seed);
    for (int i = 0; i < count; ++i) {
      meshes_.push_back(shapes[i % shapes.size()]);
      bodies_.push_back(
          std::make_unique<fcl::CollisionObjectd>(kiosModel(meshes_.back()), poses[i]));
      index_[bodies_.back()->collisionGeometry().get()] = i;
    }
  }

  int size() const { return static_cast<int>(bodies_.size()); }
  fcl::CollisionObjectd* body(int i) const { return bodies_[i].get(); }
  int indexOf(const fcl::CollisionGeometryd* geometry) const { return index_.at(geometry); }
  Objects range(int begin, int end) const {
    Objects objects;
    for (int i = begin; i < end; ++i) objects.push_back(body(i));
    return objects;
  }
  scenes::MeshOracle oracle(int i, int j) const { return {meshes_[i], meshes_[j]}; }
  double exactDistance(int i, int j) const {
    return oracle(i, j).distance(body(i)->getTransform(), body(j)->getTransform());
  }
  Pairs exactPairs(int i, int j) const {
    return oracle(i, j).collidingPairs(body(i)->getTransform(), body(j)->getTransform());
  }

 private:
  std::vector<Mesh> meshes_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> bodies_;
  std::map<const fcl::CollisionGeometryd*, int> index_;
};

// (body, triangle, body, triangle) with the lower body first.
using Touches = std::set<std::tuple<int, int, int, int>>;

Touches touches(const Scene& scene, const fcl::CollisionResultd& result) {
  Touches found;
  for (std::size_t c = 0; c < result.numContacts(); ++c) {
    const fcl::Contactd& contact = result.getContact(c);
    const int i = scene.indexOf(contact.o1), j = scene.indexOf(contact.o2);
    const int t1 = static_cast<int>(contact.b1), t2 = static_cast<int>(contact.b2);
    if (i < j) found.emplace(i, t1, j, t2);
    if (j < i) found.emplace(j, t2, i, t1);
  }
  return found;
}

// What brute force says of the pairs (i, j) that `wanted` selects.
struct Truth {
  Touches touches;
  double distance = std::numeric_limits<double>::max();
};
Truth truth(const Scene& scene, const std::function<bool(int, int)>& wanted) {
  Truth result;
  for (int i = 0; i < scene.size(); ++i) {
    for (int j = i + 1; j < scene.size(); ++j) {
      if (!wanted(i, j)) continue;
      result.distance = std::min(result.distance, scene.exactDistance(i, j));
      for (const auto& [t1, t2] : scene.exactPairs(i, j)) result.touches.emplace(i, t1, j, t2);
    }
  }
  return result;
}

fcl::DefaultCollisionData<double> allContacts() {
  fcl::DefaultCollisionData<double> data;
  data.request.num_max_contacts = kAllContacts;
  return data;
}

void expectDistance(const Scene& scene, const fcl::DistanceResultd& result, const Truth& expected) {
  EXPECT_NEAR(result.min_distance, expected.distance, 1e-12);
  const int i = scene.indexOf(result.o1), j = scene.indexOf(result.o2);
  EXPECT_NEAR(scene.exactDistance(i, j), expected.distance, 1e-12);
  if (expected.distance == 0) return;
  EXPECT_NEAR((result.nearest_points[0] - result.nearest_points[1]).norm(), expected.distance,
              1e-12);
}

class Broadphase : public ::testing::TestWithParam<double> {};  // the spread of the bodies

TEST_P(Broadphase, SelfQueries) {
  const Scene scene(14, GetParam(), 91);
  const Truth expected = truth(scene, [](int, int) { return true; });
  for (const auto& [name, make] : managers()) {
    SCOPED_TRACE(name);
    const Manager manager = filled(make, scene.range(0, scene.size()));
    auto contacts = allContacts();
    manager->collide(&contacts, fcl::DefaultCollisionFunction<double>);
    EXPECT_EQ(touches(scene, contacts.result), expected.touches);
    fcl::DefaultCollisionData<double> first;
    manager->collide(&first, fcl::DefaultCollisionFunction<double>);
    EXPECT_EQ(first.result.numContacts(), expected.touches.empty() ? 0u : 1u);
    fcl::DefaultDistanceData<double> distance;
    distance.request.enable_nearest_points = true;
    manager->distance(&distance, fcl::DefaultDistanceFunction<double>);
    expectDistance(scene, distance.result, expected);
  }
}

TEST_P(Broadphase, QueriesBetweenManagers) {
  const Scene scene(14, GetParam(), 92);
  const Truth expected = truth(scene, [](int i, int j) { return i < 6 && j >= 6; });
  for (const auto& [name, make] : managers()) {
    SCOPED_TRACE(name);
    const Manager few = filled(make, scene.range(0, 6)), many = filled(make, scene.range(6, 14));
    auto contacts = allContacts();
    few->collide(many.get(), &contacts, fcl::DefaultCollisionFunction<double>);
    EXPECT_EQ(touches(scene, contacts.result), expected.touches);
    fcl::DefaultDistanceData<double> distance;
    distance.request.enable_nearest_points = true;
    few->distance(many.get(), &distance, fcl::DefaultDistanceFunction<double>);
    expectDistance(scene, distance.result, expected);
  }
}

TEST_P(Broadphase, QueriesOfOneObjectAsItMoves) {
  const Scene scene(10, GetParam(), 93);
  for (const Transform3d& X : scenes::randomPoses(3, GetParam(), 94)) {
    scene.body(0)->setTransform(X);
    scene.body(0)->computeAABB();
    const Truth expected = truth(scene, [](int i, int) { return i == 0; });
    for (const auto& [name, make] : managers()) {
      SCOPED_TRACE(name);
      const Manager manager = filled(make, scene.range(1, scene.size()));
      auto contacts = allContacts();
      manager->collide(scene.body(0), &contacts, fcl::DefaultCollisionFunction<double>);
      EXPECT_EQ(touches(scene, contacts.result), expected.touches);
      fcl::DefaultDistanceData<double> distance;
      distance.request.enable_nearest_points = true;
      manager->distance(scene.body(0), &distance, fcl::DefaultDistanceFunction<double>);
      expectDistance(scene, distance.result, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CrowdedAndSparse, Broadphase, ::testing::Values(1.0, 2.0, 12.0));

TEST(BroadphaseMixed, ShapesFarFromTheMeshesCollideAmongThemselves) {
  const Scene scene(8, 1, 95);
  const Truth expected = truth(scene, [](int, int) { return true; });
  ASSERT_FALSE(expected.touches.empty());
  fcl::CollisionObjectd sphere(std::make_shared<fcl::Sphered>(1),
                               Transform3d(Eigen::Translation3d(40, 0, 0)));
  fcl::CollisionObjectd box(std::make_shared<fcl::Boxd>(1, 1, 1),
                            Transform3d(Eigen::Translation3d(41, 0, 0)));
  for (const auto& [name, make] : managers()) {
    SCOPED_TRACE(name);
    Objects objects = scene.range(0, scene.size());
    objects.push_back(&sphere);
    objects.push_back(&box);
    const Manager manager = filled(make, objects);
    auto contacts = allContacts();
    manager->collide(&contacts, fcl::DefaultCollisionFunction<double>);
    std::size_t between_shapes = 0;
    fcl::CollisionResultd between_meshes;
    for (std::size_t c = 0; c < contacts.result.numContacts(); ++c) {
      const fcl::Contactd& contact = contacts.result.getContact(c);
      if (contact.o1->getObjectType() == fcl::OT_GEOM) {
        ++between_shapes;
      } else {
        between_meshes.addContact(contact);
      }
    }
    EXPECT_GE(between_shapes, 1u);
    EXPECT_EQ(touches(scene, between_meshes), expected.touches);
    // A mesh and a shape: through the manager as without it.
    fcl::DefaultDistanceData<double> distance;
    Manager(filled(make, {scene.body(0), &box}))
        ->distance(&distance, fcl::DefaultDistanceFunction<double>);
    fcl::DistanceResultd alone;
    EXPECT_GT(fcl::distance(scene.body(0), &box, fcl::DistanceRequestd(), alone), 0);
    EXPECT_EQ(distance.result.min_distance, alone.min_distance);
  }
}

}  // namespace
}  // namespace kios::testing
