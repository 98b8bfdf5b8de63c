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

struct PairAnswer {
  double distance = -1;
  std::intptr_t b1 = -1, b2 = -1;
  Vector3d p0 = Vector3d::Zero(), p1 = Vector3d::Zero();
  Pairs pairs;
  bool operator==(const PairAnswer& other) const {
    return distance == other.distance && b1 == other.b1 && b2 == other.b2 && p0 == other.p0 &&
           p1 == other.p1 && pairs == other.pairs;
  }
};

PairAnswer ask(const Modeld& a, const Modeld& b, const Frame& frame) {
  fcl::DistanceResultd distance;
  fcl::CollisionResultd contacts;
  PairAnswer answer;
  answer.distance =
      fcl::distance(&a, frame.X_WA, &b, frame.X_WB, fcl::DistanceRequestd(true), distance);
  answer.b1 = distance.b1;
  answer.b2 = distance.b2;
  answer.p0 = distance.nearest_points[0];
  answer.p1 = distance.nearest_points[1];
  fcl::collide(&a, frame.X_WA, &b, frame.X_WB, fcl::CollisionRequestd(kAllContacts, true),
               contacts);
  answer.pairs = contactPairs(contacts);
  return answer;
}

TEST(Threads, SharedModelsAnswerAsInOneThread) {
  const Mesh mesh_a = scenes::bumpyTorus(2000), mesh_b = scenes::bumpyTorus(1200);
  const auto frames = randomFrames(80, 1.5, 111);
  std::vector<PairAnswer> expected;
  {
    const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);
    for (const Frame& frame : frames) expected.push_back(ask(*a, *b, frame));
  }
  const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);  // nobody has queried these
  std::atomic<int> wrong{0};
  together(kThreads, [&](int t) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::size_t at = (i + 10 * t) % frames.size();
      if (!(ask(*a, *b, frames[at]) == expected[at])) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

TEST(Threads, QueriesAndBuildsOfOtherModelsDoNotMeet) {
  const Mesh mesh = scenes::bumpyTorus(1000);
  const auto shared = kiosModel(mesh);
  const auto frames = randomFrames(20, 1.5, 112);
  std::vector<PairAnswer> expected;
  for (const Frame& frame : frames) expected.push_back(ask(*shared, *shared, frame));
  std::atomic<int> wrong{0};
  together(kThreads, [&](int t) {
    // Copies share FCL's fitter; half the threads refit theirs between queries.
    const auto own = std::make_shared<Modeld>(*shared);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (t % 2 == 0) {
        own->beginReplaceModel();
        own->replaceSubModel(mesh.vertices);
        own->endReplaceModel(false);
      }
      if (!(ask(*shared, *shared, frames[i]) == expected[i])) ++wrong;
      if (ask(*own, *shared, frames[i]).distance != expected[i].distance) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

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
  // Where nobody has prepared the models, the steps of an advance depend on who asked before.
  const auto& mesh = static_cast<const Modeld&>(*shared.others.at("mesh"));
  prepare(*shared.model);
  prepare(mesh);
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
