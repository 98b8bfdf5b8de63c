// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Const queries of shared models from many threads give what one thread gives.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "fcl/mesh_cases.h"

namespace kios::testing {
namespace {

struct Answer {
  double distance = -1;
  std::intptr_t b1 = -1, b2 = -1;
  Vector3d p0 = Vector3d::Zero(), p1 = Vector3d::Zero();
  Pairs pairs;
  bool operator==(const Answer& other) const {
    return distance == other.distance && b1 == other.b1 && b2 == other.b2 && p0 == other.p0 &&
           p1 == other.p1 && pairs == other.pairs;
  }
};

Answer ask(const Modeld& a, const Modeld& b, const Frame& frame) {
  fcl::DistanceResultd distance;
  fcl::CollisionResultd contacts;
  Answer answer;
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
  constexpr int kThreads = 8;
  const Mesh mesh_a = scenes::bumpyTorus(2000), mesh_b = scenes::bumpyTorus(1200);
  const auto frames = randomFrames(80, 1.5, 111);
  std::vector<Answer> expected;
  {
    const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);
    for (const Frame& frame : frames) expected.push_back(ask(*a, *b, frame));
  }
  const auto a = kiosModel(mesh_a), b = kiosModel(mesh_b);  // nobody has queried these
  std::atomic<int> ready{0}, wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (++ready; ready < kThreads;) std::this_thread::yield();
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::size_t at = (i + 10 * t) % frames.size();
        if (!(ask(*a, *b, frames[at]) == expected[at])) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Threads, QueriesAndBuildsOfOtherModelsDoNotMeet) {
  const Mesh mesh = scenes::bumpyTorus(1000);
  const auto shared = kiosModel(mesh);
  const auto frames = randomFrames(20, 1.5, 112);
  std::vector<Answer> expected;
  for (const Frame& frame : frames) expected.push_back(ask(*shared, *shared, frame));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
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
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
