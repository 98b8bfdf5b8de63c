// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every broadphase manager of FCL with FCL's default callbacks: scenes of meshes, shapes and an
// octree against queries of all pairs.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

#include <fcl/geometry/octree/octree.h>

#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

fcl::DefaultCollisionData<double> allContacts() {
  fcl::DefaultCollisionData<double> data;
  data.request.num_max_contacts = kAllContacts;
  return data;
}

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

// Pairs of geometries with the triangles or cells that meet; managers may name them in either
// order, and twice.
using Touches = std::set<std::pair<GeometryPair, std::pair<std::intptr_t, std::intptr_t>>>;

Touches touchesOf(const fcl::CollisionResultd& result) {
  Touches touches;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const fcl::Contactd& c = result.getContact(i);
    const bool in_order = c.o1 < c.o2;
    touches.emplace(ordered(c.o1, c.o2), std::pair(in_order ? c.b1 : c.b2, in_order ? c.b2 : c.b1));
  }
  return touches;
}

struct MixedAnswer {
  Touches touching;
  std::map<GeometryPair, double> distances;
  double distance = std::numeric_limits<double>::max();
};

MixedAnswer bruteForce(const Objects& objects,
                       const std::function<bool(std::size_t, std::size_t)>& wanted) {
  MixedAnswer answer;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      if (!wanted(i, j)) continue;
      const fcl::CollisionObjectd *a = objects[i], *b = objects[j];
      const GeometryPair pair = ordered(a->collisionGeometry().get(), b->collisionGeometry().get());
      fcl::CollisionResultd contacts;
      fcl::collide(a, b, fcl::CollisionRequestd(kAllContacts), contacts);
      answer.touching.merge(touchesOf(contacts));
      fcl::DistanceResultd distance;
      answer.distances[pair] = fcl::distance(a, b, fcl::DistanceRequestd(), distance);
      answer.distance = std::min(answer.distance, answer.distances[pair]);
    }
  }
  return answer;
}

// `query` asks a manager with the data that it is given.
template <typename Query>
void expectAnswer(const Query& query, const MixedAnswer& expected) {
  auto contacts = allContacts();
  fcl::DefaultCollisionData<double> first;
  fcl::DefaultDistanceData<double> distance, again;
  distance.request.enable_nearest_points = true;
  query(&contacts, &distance);
  query(&first, &again);
  EXPECT_EQ(first.result.numContacts(), expected.touching.empty() ? 0U : 1U);
  EXPECT_EQ(touchesOf(contacts.result), expected.touching);
  // FCL's distance of two shapes that overlap is some number below 0.
  const double d = distance.result.min_distance;
  EXPECT_TRUE(expected.distance <= 0 ? d <= 0 : std::abs(d - expected.distance) <= 1e-6)
      << d << " for " << expected.distance;
  if (expected.distance <= 0) return;
  const auto& [p, q] = distance.result.nearest_points;
  EXPECT_NEAR((p - q).norm(), d, 1e-6);
  EXPECT_NEAR(expected.distances.at(ordered(distance.result.o1, distance.result.o2)), d, 1e-6);
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
      for (const auto& [pair, ids] : self.touching) {
        any_shapes_touch = any_shapes_touch || (pair.first->getObjectType() == fcl::OT_GEOM &&
                                                pair.second->getObjectType() == fcl::OT_GEOM);
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
