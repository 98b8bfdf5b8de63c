// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One linkage asked by eight threads gives the answers of one thread.

#include "linkage/robot_cases.h"
#include "together.h"

namespace kios::testing {
namespace {

RobotCase robotOf(std::uint64_t seed) {
  Random random(seed);
  RobotCase robot;
  for (int i = 0; i < 5; ++i) {
    Joint joint;
    joint.type = i == 3 ? JointType::kPrismatic : JointType::kRevolute;
    joint.X_PJ = randomPose(random, 0.4);
    joint.axis = inBall(random);
    robot.addLink(i - 1, joint);
    Mesh mesh = scenes::bumpyTorus(400);
    for (Vector3d& p : mesh.vertices) p *= 0.1;
    robot.addBody(i, modelOf(mesh));
    if (i > 0) robot.ignorePair(i - 1, i);
  }
  for (int i = 0; i < 8; ++i) {
    Mesh mesh = scenes::bumpyTorus(600);
    for (Vector3d& p : mesh.vertices) p *= 0.15;
    robot.addBody(-1, modelOf(mesh), randomPose(random, 1));
  }
  robot.addBody(-1, std::make_shared<fcl::Boxd>(0.2, 0.3, 0.4), randomPose(random, 1));
  return robot;
}

TEST(Threads, OneLinkageAnswersAsInOneThread) {
  constexpr int kPaths = 60;
  Random random(5);
  std::vector<std::pair<Joints, Joints>> paths;
  for (int i = 0; i < kPaths; ++i) {
    Joints q0(5), step(5);
    for (double& x : q0) x = random.uniform(-2, 2);
    for (double& x : step) x = random.uniform(-0.5, 0.5);
    paths.emplace_back(q0, q0 + step);
  }
  const auto ask = [&](const Linkage& linkage, std::size_t i) {
    MotionRequest request;
    request.first_contact = i % 3 == 0;
    request.min_separation = i % 2 == 0 ? 0 : 0.01;
    return checkMotion(linkage, paths[i].first, paths[i].second, request);
  };
  const RobotCase alone = robotOf(3), shared = robotOf(3);  // nobody has asked the second
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
