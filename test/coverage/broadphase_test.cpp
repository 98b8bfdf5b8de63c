// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every manager over scenes of meshes, shapes and an octree, over any volume, with FCL's default
// callbacks, against brute force over the pairs.

#include <set>

#include <fcl/geometry/octree/octree.h>

#include "coverage/tally.h"
#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

using fcl::Transform3d;
using testing::Manager;
using testing::Objects;
using PairOfObjects = std::pair<const fcl::CollisionGeometryd*, const fcl::CollisionGeometryd*>;

// Eight meshes about the origin; a box, a capsule and an octree among them, apart from each other.
template <typename BV>
class Scene {
 public:
  explicit Scene(double spread) {
    const auto poses = scenes::randomPoses(8, spread, 701);
    const std::vector<scenes::Mesh> meshes{scenes::icosphere(0.4, 1), scenes::bumpyTorus(100)};
    for (int i = 0; i < 8; ++i) add(scenes::buildModel<BV>(meshes[i % 2]), poses[i]);
    const auto at = [&](double x, double y) {
      return Transform3d(Eigen::Translation3d(spread * x, spread * y, 0));
    };
    add(std::make_shared<fcl::Boxd>(0.6, 0.5, 0.4), at(0.9, 0));
    add(std::make_shared<fcl::Capsuled>(0.2, 0.5), at(-0.9, 0.3));
    const auto tree = std::make_shared<octomap::OcTree>(0.25);
    for (int i = 0; i < 4; ++i) {
      for (int n = 0; n < 8; ++n) tree->updateNode(octomap::point3d(0.3f * i, 0.1f, 0), true);
    }
    add(std::make_shared<fcl::OcTreed>(tree), at(0, -0.9));
  }
  Objects range(std::size_t begin, std::size_t end) const {
    Objects objects;
    for (std::size_t i = begin; i < end; ++i) objects.push_back(objects_[i].get());
    return objects;
  }
  std::size_t size() const { return objects_.size(); }

 private:
  void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, const Transform3d& X) {
    objects_.push_back(std::make_unique<fcl::CollisionObjectd>(geometry, X));
  }
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
};

PairOfObjects ordered(const fcl::CollisionGeometryd* a, const fcl::CollisionGeometryd* b) {
  return a < b ? PairOfObjects(a, b) : PairOfObjects(b, a);
}

struct Answer {
  std::set<PairOfObjects> touching;
  double distance = std::numeric_limits<double>::max();
};

template <typename Wanted>
Answer bruteForce(const Objects& objects, const Wanted& wanted) {
  Answer answer;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      if (!wanted(i, j)) continue;
      fcl::CollisionResultd contacts;
      if (fcl::collide(objects[i], objects[j], fcl::CollisionRequestd(), contacts) > 0) {
        answer.touching.insert(
            ordered(objects[i]->collisionGeometry().get(), objects[j]->collisionGeometry().get()));
      }
      fcl::DistanceResultd distance;
      answer.distance = std::min(answer.distance, fcl::distance(objects[i], objects[j],
                                                                fcl::DistanceRequestd(), distance));
    }
  }
  return answer;
}

template <typename Query>
Answer asked(const Query& query) {
  fcl::DefaultCollisionData<double> contacts;
  contacts.request.num_max_contacts = testing::kAllContacts;
  fcl::DefaultDistanceData<double> distance;
  query(&contacts, &distance);
  Answer answer;
  for (std::size_t i = 0; i < contacts.result.numContacts(); ++i) {
    const auto& contact = contacts.result.getContact(i);
    answer.touching.insert(ordered(contact.o1, contact.o2));
  }
  answer.distance = distance.result.min_distance;
  return answer;
}

template <typename BV>
void checkAnswer(const std::string& row, const Answer& answer, const Answer& truth) {
  check<BV>(row + " collide", answer.touching == truth.touching);
  // At overlap FCL stops at the first pair, whose number below 0 says no more than 0.
  const bool overlap = truth.distance <= 0;
  check<BV>(row + " distance",
            overlap ? answer.distance <= 0 : std::abs(answer.distance - truth.distance) <= 1e-6);
}

template <typename BV>
class Broadphase : public ::testing::Test {};
TYPED_TEST_SUITE(Broadphase, DoubleVolumes);

TYPED_TEST(Broadphase, MeshesShapesAndAnOctree) {
  const auto collide = fcl::DefaultCollisionFunction<double>;
  const auto nearest = fcl::DefaultDistanceFunction<double>;
  bool any_overlap = false, any_apart = false;
  for (const double spread : {1.5, 3.0, 8.0}) {
    const Scene<TypeParam> scene(spread);
    for (const auto& [name, make] : testing::managers()) {
      // FCL's box of an octree is that of all its keys, thousands of units: too many cells to hash.
      const std::size_t n = scene.size() - (name == "SpatialHashing" ? 1 : 0), half = 5;
      const Objects all = scene.range(0, n);
      const Answer self = bruteForce(all, [](std::size_t, std::size_t) { return true; });
      const Answer cross =
          bruteForce(all, [&](std::size_t i, std::size_t j) { return i < half && j >= half; });
      const Answer one = bruteForce(all, [](std::size_t i, std::size_t) { return i == 0; });
      any_overlap = any_overlap || self.distance <= 0;
      any_apart = any_apart || self.distance > 0;
      const Manager every = testing::filled(make, all);
      checkAnswer<TypeParam>(name + " self", asked([&](auto* c, auto* d) {
                               every->collide(c, collide);
                               every->distance(d, nearest);
                             }),
                             self);
      const Manager few = testing::filled(make, scene.range(0, half));
      const Manager many = testing::filled(make, scene.range(half, n));
      checkAnswer<TypeParam>(name + " cross", asked([&](auto* c, auto* d) {
                               few->collide(many.get(), c, collide);
                               few->distance(many.get(), d, nearest);
                             }),
                             cross);
      const Manager others = testing::filled(make, scene.range(1, n));
      checkAnswer<TypeParam>(name + " object", asked([&](auto* c, auto* d) {
                               others->collide(all[0], c, collide);
                               others->distance(all[0], d, nearest);
                             }),
                             one);
    }
  }
  EXPECT_TRUE(any_overlap && any_apart);
}

}  // namespace
}  // namespace kios::coverage
