// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One model shared by eight threads that do everything const with it: what they get is what one
// thread gets.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include <fcl/geometry/octree/octree.h>

#include "coverage/shape_distance.h"
#include "fcl/managers.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

using fcl::Transform3d;
using testing::Frame;

constexpr int kThreads = 8;

// What nobody writes to while the threads run. A fresh one has prepared nothing.
struct Shared {
  Shared() {
    partners.push_back(scenes::buildModel<kIOSd>(scenes::icosphere(0.6, 2)));
    for (auto& [name, shape] : shapeCases<double>()) partners.push_back(shape.geometry);
    const auto tree = std::make_shared<octomap::OcTree>(0.25);
    for (int i = 0; i < 8; ++i) tree->updateNode(octomap::point3d(0.1f, 0.3f, 0.1f), true);
    partners.push_back(std::make_shared<fcl::OcTreed>(tree));
    // Constructing objects writes the geometries' boxes: here, before there are threads.
    for (std::size_t i = 0; i < 12; ++i) {
      objects.push_back(std::make_unique<fcl::CollisionObjectd>(
          i % 3 == 0 ? partners[0] : std::shared_ptr<fcl::CollisionGeometryd>(model),
          scenes::randomPoses(12, 2.5, 801)[i]));
    }
  }
  const std::shared_ptr<Modeld> model = scenes::buildModel<kIOSd>(scenes::bumpyTorus(600));
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> partners;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
};

using Numbers = std::vector<double>;

void append(Numbers& numbers, const fcl::CollisionResultd& result) {
  numbers.push_back(static_cast<double>(result.numContacts()));
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    for (const double x : {double(contact.b1), contact.penetration_depth, contact.pos[0],
                           contact.pos[1], contact.normal[2]}) {
      numbers.push_back(x);
    }
  }
}

// Everything that is const, over a frame: both orders, all partners, continuous motion, managers of
// the thread's own objects, the traversal nodes.
Numbers everything(const Shared& shared, const Frame& frame) {
  Numbers numbers;
  const fcl::CollisionGeometryd* model = shared.model.get();
  for (const auto& partner : shared.partners) {
    for (const bool first : {true, false}) {
      const auto *a = first ? model : partner.get(), *b = first ? partner.get() : model;
      fcl::CollisionResultd contacts;
      fcl::collide(a, frame.X_WA, b, frame.X_WB, fcl::CollisionRequestd(50, true), contacts);
      append(numbers, contacts);
      fcl::DistanceResultd nearest;
      const fcl::DistanceRequestd request(true);
      numbers.push_back(fcl::distance(a, frame.X_WA, b, frame.X_WB, request, nearest));
      numbers.push_back(nearest.nearest_points[0][0]);
      numbers.push_back(nearest.nearest_points[1][1]);
    }
  }
  fcl::ContinuousCollisionResultd moving;
  fcl::ContinuousCollisionRequestd request;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  request.ccd_motion_type = fcl::CCDM_SCREW;
  numbers.push_back(fcl::continuousCollide(model, frame.X_WA, frame.X_WB, shared.partners[0].get(),
                                           frame.X_WB, frame.X_WA, request, moving));
  numbers.push_back(moving.is_collide);
  const Modeld& m = *shared.model;
  MeshCollisionTraversalNode<double> node;
  fcl::CollisionResultd self;
  initialize(node, m, frame.X_WA, m, frame.X_WA, fcl::CollisionRequestd(20), self);
  fcl::detail::selfCollide<double>(&node);
  append(numbers, self);
  return numbers;
}

// A manager of the thread's own over copies of the shared objects.
Numbers inManager(const Shared& shared) {
  std::vector<fcl::CollisionObjectd> own;
  for (const auto& object : shared.objects) own.push_back(*object);  // copies write no model
  testing::Objects objects;
  for (auto& object : own) objects.push_back(&object);
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects(objects);
  manager.setup();
  fcl::DefaultCollisionData<double> contacts;
  contacts.request.num_max_contacts = testing::kAllContacts;
  manager.collide(&contacts, fcl::DefaultCollisionFunction<double>);
  fcl::DefaultDistanceData<double> distance;
  manager.distance(&distance, fcl::DefaultDistanceFunction<double>);
  return {double(contacts.result.numContacts()), distance.result.min_distance};
}

TEST(SharedModel, EightThreadsGetWhatOneGets) {
  const auto frames = testing::randomFrames(6, 1.2, 802);
  std::vector<Numbers> expected;
  Numbers expected_of_manager;
  {
    const Shared alone;
    for (const Frame& frame : frames) expected.push_back(everything(alone, frame));
    expected_of_manager = inManager(alone);
  }
  const Shared shared;
  std::atomic<int> ready{0}, wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (++ready; ready < kThreads;) std::this_thread::yield();
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::size_t at = (i + t) % frames.size();
        if (everything(shared, frames[at]) != expected[at]) ++wrong;
      }
      if (inManager(shared) != expected_of_manager) ++wrong;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::coverage
