// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Prepared trees are shared without locks, and never changed while several models hold them.

#include <gtest/gtest.h>

#include <atomic>

#include "fcl/mesh_cases.h"
#include "scenes/random.h"
#include "together.h"

namespace kios::testing {
namespace {

constexpr int kThreads = 8;

struct Answer {
  double distance = -1;
  std::intptr_t a = -1, b = -1;
  Pairs contacts;
  /// At distance 0 any pair that intersects may be named.
  bool same(const Answer& o) const {
    return distance == o.distance && (distance == 0 || (a == o.a && b == o.b)) &&
           contacts == o.contacts;
  }
  /// With the same pair at distance 0.
  bool equals(const Answer& o) const { return same(o) && a == o.a && b == o.b; }
};

Answer ask(const Modeld& a, const Modeld& b, const Frame& frame) {
  fcl::DistanceResultd distance;
  fcl::CollisionResultd contacts;
  Answer answer;
  // With points: at distance 0 the pair is the same, then, whoever asked first.
  answer.distance =
      distanceMeshes(a, frame.X_WA, b, frame.X_WB, fcl::DistanceRequestd(true), distance);
  collideMeshes(a, frame.X_WA, b, frame.X_WB, fcl::CollisionRequestd(kAllContacts), contacts);
  answer.a = distance.b1;
  answer.b = distance.b2;
  answer.contacts = contactPairs(contacts);
  return answer;
}

std::vector<Vector3d> shifted(const Mesh& mesh, double by) {
  std::vector<Vector3d> vertices = mesh.vertices;
  for (Vector3d& p : vertices) p += Vector3d(by, 0.5 * by, 0);
  return vertices;
}

class EngineThreads : public ::testing::Test {
 protected:
  std::vector<Answer> answers(const Modeld& a, const Modeld& b) const {
    std::vector<Answer> result;
    for (const Frame& frame : frames_) result.push_back(ask(a, b, frame));
    return result;
  }

  const Mesh mesh_ = scenes::bumpyTorus(600), other_mesh_ = scenes::icosphere(0.5, 2);
  const std::vector<Frame> frames_ = randomFrames(10, 1.3, 91);
};

// Copies hold one tree until they are refitted, while others are asked.
TEST_F(EngineThreads, RefittedCopiesAndQueriesDoNotMeet) {
  const auto original = kiosModel(mesh_), other = kiosModel(other_mesh_);
  constexpr int kStates = 4;
  std::vector<std::vector<Answer>> expected;
  for (int state = 0; state < kStates; ++state) {
    expected.push_back(answers(*kiosModel({shifted(mesh_, 0.1 * state), mesh_.triangles}), *other));
  }
  std::atomic<int> wrong{0};
  together(12, [&](int t) {
    Modeld own(*original);
    for (int i = 0; i < 12; ++i) {
      const std::size_t at = static_cast<std::size_t>(i + t) % frames_.size();
      if (t % 3 == 0) {
        const int state = (i + t) % kStates;
        own.beginReplaceModel();
        own.replaceSubModel(shifted(mesh_, 0.1 * state));
        own.endReplaceModel(true, i % 2 == 0);
        const Answer answer = ask(own, *other, frames_[at]);
        wrong += !answer.same(expected[static_cast<std::size_t>(state)][at]);
        if (i % 4 == 3) verticesChanged(own);
      } else if (t % 3 == 1) {
        wrong += !ask(own, *other, frames_[at]).equals(expected[0][at]);
      } else {
        wrong += !ask(*original, *other, frames_[at]).equals(expected[0][at]);
        prepare(*original);
        wrong += preparedBytes(*original) == 0;
      }
    }
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
