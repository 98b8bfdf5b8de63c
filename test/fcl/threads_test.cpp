// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Const queries of shared models from many threads give the answers of one thread.

#include <gtest/gtest.h>

#include "fcl/managers.h"
#include "fcl/partners.h"
#include "together.h"

namespace kios::testing {
namespace {

constexpr int kThreads = 8;

// A model and all that it may meet, to which nobody writes while the threads run. A fresh one has
// prepared nothing.
struct Shared {
  Shared() {
    // Constructing objects writes the geometries' boxes, so it comes before there are threads.
    const auto poses = scenes::randomPoses(12, 2.5, 801);
    for (std::size_t i = 0; i < 12; ++i) {
      objects.emplace_back(i % 3 == 0 ? others.at("mesh") : Geometry(model), poses[i]);
    }
  }
  const std::shared_ptr<Modeld> model = kiosModel(scenes::bumpyTorus(600));
  const std::map<std::string, Geometry> others = partners();
  std::vector<fcl::CollisionObjectd> objects;
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

// All const calls over a frame: both orders, all partners, continuous motion, the traversal nodes.
Numbers everything(const Shared& shared, const Frame& frame) {
  Numbers numbers;
  const fcl::CollisionGeometryd* model = shared.model.get();
  for (const auto& [name, partner] : shared.others) {
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
  const auto& mesh = static_cast<const Modeld&>(*shared.others.at("mesh"));
  fcl::ContinuousCollisionResultd moving;
  fcl::ContinuousCollisionRequestd request;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  request.ccd_motion_type = fcl::CCDM_SCREW;
  numbers.push_back(fcl::continuousCollide(model, frame.X_WA, frame.X_WB, &mesh, frame.X_WB,
                                           frame.X_WA, request, moving));
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
  std::vector<fcl::CollisionObjectd> own = shared.objects;  // copies write no model
  Objects objects;
  for (auto& object : own) objects.push_back(&object);
  const Manager manager = filled(managers().at("DynamicAABBTree"), objects);
  fcl::DefaultCollisionData<double> contacts;
  contacts.request.num_max_contacts = kAllContacts;
  manager->collide(&contacts, fcl::DefaultCollisionFunction<double>);
  fcl::DefaultDistanceData<double> distance;
  manager->distance(&distance, fcl::DefaultDistanceFunction<double>);
  return {double(contacts.result.numContacts()), distance.result.min_distance};
}

TEST(SharedModel, EightThreadsGetWhatOneGets) {
  const auto frames = randomFrames(6, 1.2, 802);
  std::vector<Numbers> expected;
  Numbers expected_of_manager;
  {
    const Shared alone;
    for (const Frame& frame : frames) expected.push_back(everything(alone, frame));
    expected_of_manager = inManager(alone);
  }
  const Shared shared;
  std::atomic<int> wrong{0};
  together(kThreads, [&](int t) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::size_t at = (i + t) % frames.size();
      if (everything(shared, frames[at]) != expected[at]) ++wrong;
    }
    if (inManager(shared) != expected_of_manager) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
