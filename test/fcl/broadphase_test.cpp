// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every broadphase manager of FCL with FCL's default callbacks: scenes of meshes against the oracle
// over all pairs, scenes of meshes, shapes and an octree against queries of all pairs.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <tuple>

#include <fcl/geometry/octree/octree.h>

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

// The answer of the oracle for the pairs (i, j) that `wanted` selects.
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

using GeometryPair = std::pair<const fcl::CollisionGeometryd*, const fcl::CollisionGeometryd*>;

GeometryPair ordered(const fcl::CollisionGeometryd* a, const fcl::CollisionGeometryd* b) {
  return a < b ? GeometryPair(a, b) : GeometryPair(b, a);
}

// Eight meshes about the origin with a box, a capsule and an octree among them; two shapes that
// overlap if `crowded`.
std::vector<fcl::CollisionObjectd> mixedScene(double spread, bool crowded) {
  std::vector<fcl::CollisionObjectd> objects;
  const auto poses = scenes::randomPoses(8, spread, 701);
  for (int i = 0; i < 8; ++i) {
    const Mesh mesh = i % 2 == 0 ? scenes::icosphere(0.4, 1) : scenes::bumpyTorus(100);
    objects.emplace_back(kiosModel(mesh), poses[i]);
  }
  const auto at = [&](double x, double y) {
    return Transform3d(Eigen::Translation3d(spread * x, spread * y, 0));
  };
  objects.emplace_back(std::make_shared<fcl::Boxd>(0.6, 0.5, 0.4), at(0.9, 0));
  objects.emplace_back(std::make_shared<fcl::Capsuled>(0.2, 0.5), at(-0.9, 0.3));
  if (crowded) objects.emplace_back(std::make_shared<fcl::Sphered>(0.3), at(0.9, 0.1));
  const auto cells = std::make_shared<octomap::OcTree>(0.25);
  for (int i = 0; i < 4; ++i) {
    for (int n = 0; n < 8; ++n) cells->updateNode(octomap::point3d(0.3F * i, 0.1F, 0), true);
  }
  objects.emplace_back(std::make_shared<fcl::OcTreed>(cells), at(0, -0.9));
  return objects;
}

struct MixedAnswer {
  std::set<GeometryPair> touching;
  double distance = std::numeric_limits<double>::max();
};

MixedAnswer bruteForce(const Objects& objects,
                       const std::function<bool(std::size_t, std::size_t)>& wanted) {
  MixedAnswer answer;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      if (!wanted(i, j)) continue;
      const fcl::CollisionObjectd *a = objects[i], *b = objects[j];
      fcl::CollisionResultd contacts;
      if (fcl::collide(a, b, fcl::CollisionRequestd(), contacts) > 0) {
        answer.touching.insert(ordered(a->collisionGeometry().get(), b->collisionGeometry().get()));
      }
      fcl::DistanceResultd distance;
      answer.distance =
          std::min(answer.distance, fcl::distance(a, b, fcl::DistanceRequestd(), distance));
    }
  }
  return answer;
}

// `query` asks a manager with the data that it is given.
template <typename Query>
void expectAnswer(const Query& query, const MixedAnswer& expected) {
  auto contacts = allContacts();
  fcl::DefaultDistanceData<double> distance;
  query(&contacts, &distance);
  std::set<GeometryPair> touching;
  for (std::size_t i = 0; i < contacts.result.numContacts(); ++i) {
    const auto& contact = contacts.result.getContact(i);
    touching.insert(ordered(contact.o1, contact.o2));
  }
  EXPECT_EQ(touching, expected.touching);
  // FCL's distance of two shapes that overlap is some number below 0.
  const double d = distance.result.min_distance;
  EXPECT_TRUE(expected.distance <= 0 ? d <= 0 : std::abs(d - expected.distance) <= 1e-6)
      << d << " for " << expected.distance;
}

TEST(BroadphaseMixed, MeshesShapesAndAnOctree) {
  const auto collide = fcl::DefaultCollisionFunction<double>;
  const auto nearest = fcl::DefaultDistanceFunction<double>;
  bool any_apart = false, any_shapes_touch = false;
  for (const double spread : {1.5, 3.0, 8.0}) {
    std::vector<fcl::CollisionObjectd> scene = mixedScene(spread, spread == 1.5);
    for (const auto& [name, make] : managers()) {
      SCOPED_TRACE(name);
      Objects all;
      for (fcl::CollisionObjectd& object : scene) all.push_back(&object);
      // FCL's box of an octree is that of all its keys, thousands of units: too many cells to hash.
      if (name == "SpatialHashing") all.pop_back();
      const MixedAnswer self = bruteForce(all, [](std::size_t, std::size_t) { return true; });
      any_apart = any_apart || self.distance > 0;
      for (const auto& [a, b] : self.touching) {
        any_shapes_touch = any_shapes_touch || (a->getObjectType() == fcl::OT_GEOM &&
                                                b->getObjectType() == fcl::OT_GEOM);
      }
      const Manager every = filled(make, all);
      expectAnswer(
          [&](auto* c, auto* d) {
            every->collide(c, collide);
            every->distance(d, nearest);
          },
          self);
      const auto middle = all.begin() + 5;
      const Manager few = filled(make, {all.begin(), middle});
      const Manager many = filled(make, {middle, all.end()});
      expectAnswer(
          [&](auto* c, auto* d) {
            few->collide(many.get(), c, collide);
            few->distance(many.get(), d, nearest);
          },
          bruteForce(all, [](std::size_t i, std::size_t j) { return i < 5 && j >= 5; }));
      const Manager others = filled(make, {all.begin() + 1, all.end()});
      expectAnswer(
          [&](auto* c, auto* d) {
            others->collide(all[0], c, collide);
            others->distance(all[0], d, nearest);
          },
          bruteForce(all, [](std::size_t i, std::size_t) { return i == 0; }));
      // A mesh and a shape: through the manager as without it, bit by bit.
      fcl::DefaultDistanceData<double> distance;
      filled(make, {all[0], all[8]})->distance(&distance, nearest);
      fcl::DistanceResultd alone;
      fcl::distance(all[0], all[8], fcl::DistanceRequestd(), alone);
      EXPECT_EQ(distance.result.min_distance, alone.min_distance);
    }
  }
  EXPECT_TRUE(any_apart && any_shapes_touch);
}

}  // namespace
}  // namespace kios::testing
