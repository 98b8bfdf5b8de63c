// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One linkage asked by eight threads gives the answers of one thread.

#include "linkage/robot_cases.h"
#include "shapes.h"
#include "together.h"

namespace kios::testing {
namespace {

RobotCase robotOf(std::uint64_t seed) {
  Random random(seed);
  RobotCase robot;
  const auto torus = [](int triangles, double size) {
    return modelOf(transformed(scenes::bumpyTorus(triangles), size, Vector3d::Zero()));
  };
  for (int i = 0; i < 5; ++i) {
    robot.addLink(i - 1, randomJoint(random, 0.4));
    robot.addBody(i, torus(400, 0.1));
    if (i > 0) robot.ignorePair(i - 1, i);
  }
  for (int i = 0; i < 8; ++i) robot.addBody(-1, torus(600, 0.15), randomPose(random, 1.5));
  robot.addBody(-1, std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4), randomPose(random, 1));
  return robot;
}

TEST(Threads, OneLinkageAnswersAsInOneThread) {
  constexpr int kPaths = 60;
  const RobotCase alone = robotOf(3), shared = robotOf(3);  // nobody has asked the second
  const int n = alone.linkage.coordinates();
  Random random(5);
  std::vector<std::pair<Joints, Joints>> paths;
  for (int i = 0; i < kPaths; ++i) {
    const Joints q0 = randomJoints(n, 2, random);
    paths.emplace_back(q0, q0 + randomJoints(n, 0.5, random));
  }
  const auto ask = [&](const Linkage& linkage, std::size_t i) {
    MotionRequest request;
    request.first_contact = i % 3 == 0;
    request.min_separation = i % 2 == 0 ? 0 : 0.01;
    return checkMotion(linkage, paths[i].first, paths[i].second, request);
  };
  std::vector<MotionResult> expected;
  int clear = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    expected.push_back(ask(alone.linkage, i));
    clear += expected.back().verdict == MotionVerdict::kClear ? 1 : 0;
  }
  EXPECT_GT(clear, kPaths / 10);
  EXPECT_LT(clear, kPaths * 9 / 10);
  std::atomic<int> wrong{0};
  together(8, [&](int t) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::size_t at = (i + 7 * t) % paths.size();
      const MotionResult answer = ask(shared.linkage, at);
      const MotionResult& one = expected[at];
      if (answer.verdict != one.verdict || answer.from != one.from || answer.to != one.to ||
          answer.body_a != one.body_a || answer.body_b != one.body_b ||
          answer.counts.narrow_queries != one.counts.narrow_queries) {
        ++wrong;
      }
      const Joints& q = paths[at].first;
      if (shared.linkage.pose(2, q).matrix() != alone.linkage.pose(2, q).matrix()) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
