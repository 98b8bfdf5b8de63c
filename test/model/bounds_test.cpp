// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Boxes of models that deform: FCL leaves them stale, refreshBounds() mends them, in every manager.

#include <gtest/gtest.h>

#include "fcl/managers.h"
#include "model/deform.h"

namespace kios::testing {
namespace {

// Three objects share a bar that grows along x until it reaches the ball at x = 6.
class Bounds : public ::testing::Test {
 protected:
  static constexpr double kReach = 6;

  static std::vector<Vector3d> stretched(const Mesh& mesh, double factor) {
    std::vector<Vector3d> vertices = mesh.vertices;
    for (Vector3d& p : vertices) p[0] *= factor;
    return vertices;
  }

  static Transform3d at(double x, double y) { return Transform3d(Eigen::Translation3d(x, y, 0)); }

  Objects all() { return {&bar1_, &ball_, &bar2_, &bar3_, &far_}; }

  struct Seen {
    std::size_t contacts;
    double distance;
  };
  static Seen ask(fcl::BroadPhaseCollisionManagerd& manager) {
    fcl::DefaultCollisionData<double> contacts;
    contacts.request.num_max_contacts = kAllContacts;
    manager.collide(&contacts, fcl::DefaultCollisionFunction<double>);
    fcl::DefaultDistanceData<double> distance;
    manager.distance(&distance, fcl::DefaultDistanceFunction<double>);
    return {contacts.result.numContacts(), distance.result.min_distance};
  }
  // Brute force over the pairs of objects.
  Seen truth() {
    Seen seen{0, std::numeric_limits<double>::max()};
    const Objects objects = all();
    for (std::size_t i = 0; i < objects.size(); ++i) {
      for (std::size_t j = i + 1; j < objects.size(); ++j) {
        fcl::CollisionResultd contacts;
        fcl::collide(objects[i], objects[j], fcl::CollisionRequestd(kAllContacts), contacts);
        seen.contacts += contacts.numContacts();
        fcl::DistanceResultd distance;
        seen.distance = std::min(seen.distance, fcl::distance(objects[i], objects[j],
                                                              fcl::DistanceRequestd(), distance));
      }
    }
    return seen;
  }

  const Mesh mesh_ = scenes::subdividedBox({1, 0.2, 0.2}, 3);
  const std::shared_ptr<Modeld> bar_ = kiosModel(mesh_);
  const std::shared_ptr<Modeld> sphere_ = kiosModel(scenes::icosphere(0.5, 1));
  fcl::CollisionObjectd bar1_{bar_, at(0, 0)}, bar2_{bar_, at(0, 3)},
      bar3_{bar_, at(0, -3) * scenes::randomPoses(1, 0, 5)[0]};
  fcl::CollisionObjectd ball_{sphere_, at(kReach, 0)}, far_{sphere_, at(-3, 6)};
};

TEST_F(Bounds, EveryManagerIsStaleWithoutAndRightWith) {
  for (const bool by_update : {false, true}) {
    const auto deform = by_update ? update : replace;
    for (const auto& [name, make] : managers()) {
      SCOPED_TRACE(name + (by_update ? " after update" : " after replace"));
      deform(*bar_, mesh_.vertices, true, false);
      refreshBounds<double>(*bar_, all());
      const Manager manager = filled(make, all());
      EXPECT_EQ(ask(*manager).contacts, 0u);

      deform(*bar_, stretched(mesh_, 2.2 * kReach), true, true);
      const Seen expected = truth();
      ASSERT_GT(expected.contacts, 0u);
      manager->update();  // of no use: the objects' boxes are the old ones
      const Seen stale = ask(*manager);
      EXPECT_EQ(stale.contacts, 0u);

      refreshBounds(*bar_, *manager);
      const Seen fresh = ask(*manager);
      EXPECT_EQ(fresh.contacts, expected.contacts);
      EXPECT_EQ(fresh.distance, expected.distance);

      // And back, by the form that leaves the manager to its user.
      deform(*bar_, mesh_.vertices, true, false);
      refreshBounds<double>(*bar_, all());
      if (name == "SaP") continue;  // its update() is wrong for boxes that change size
      manager->update();
      EXPECT_EQ(ask(*manager).contacts, 0u);
      EXPECT_EQ(ask(*manager).distance, truth().distance);
    }
  }
}

// Objects of two managers: the model is refreshed twice, each manager's objects once.
TEST_F(Bounds, BetweenTwoManagers) {
  for (const auto& [name, make] : managers()) {
    SCOPED_TRACE(name);
    replace(*bar_, mesh_.vertices, true, false);
    refreshBounds<double>(*bar_, all());
    const Manager left = filled(make, {&bar1_, &bar2_}), right = filled(make, {&ball_, &bar3_});
    replace(*bar_, stretched(mesh_, 2.2 * kReach), true, true);
    refreshBounds(*bar_, *left);
    refreshBounds(*bar_, *right);
    fcl::DefaultCollisionData<double> data;
    data.request.num_max_contacts = kAllContacts;
    left->collide(right.get(), &data, fcl::DefaultCollisionFunction<double>);
    // The interval tree tells of each pair twice, over any volume.
    std::set<std::pair<std::intptr_t, std::intptr_t>> pairs;
    for (std::size_t i = 0; i < data.result.numContacts(); ++i) {
      pairs.emplace(data.result.getContact(i).b1, data.result.getContact(i).b2);
    }
    EXPECT_EQ(pairs.size(), truth().contacts);
  }
}

// FCL's own volumes are served alike, and shapes, and float.
TEST_F(Bounds, OfAnyGeometry) {
  const auto obbrss = scenes::buildModel<fcl::OBBRSSd>(mesh_);
  fcl::CollisionObjectd holder(obbrss), other(sphere_);
  obbrss->beginReplaceModel();
  obbrss->replaceSubModel(stretched(mesh_, 10));
  obbrss->endReplaceModel();
  EXPECT_LT(holder.getAABB().max_[0], 1);
  const fcl::AABBd before = other.getAABB();
  refreshBounds<double>(*obbrss, {&other, &holder});
  EXPECT_EQ(holder.getAABB().max_[0], 5);
  EXPECT_EQ(obbrss->aabb_local.max_[0], 5);
  EXPECT_TRUE(other.getAABB().equal(before));

  const auto sphere = std::make_shared<fcl::Spheref>(1);
  fcl::CollisionObjectf ball(sphere);
  sphere->radius = 3;
  refreshBounds<float>(*sphere, {&ball});
  EXPECT_EQ(ball.getAABB().max_[2], 3);
}

}  // namespace
}  // namespace kios::testing
