// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The search for near pairs of a robot: none may be lost, at any scale, and few found in vain.

#include "linkage/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkage/robot_cases.h"
#include "not_finite.h"
#include "volume/float_lanes.h"

namespace kios::testing {
namespace {

using articulated::ObstacleBox;
using articulated::ObstacleTree;

long double distanceTo(const Vector3d& p, const ObstacleBox& box) {
  long double square = 0;
  for (int i = 0; i < 3; ++i) {
    const long double x = p[i];
    const long double off = std::max({box.low[i] - x, x - box.high[i], 0.0L});
    square += off * off;
  }
  return std::sqrt(square);
}

TEST(ObstacleTree, FindsAllThatIsNear) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double scale = kFloatScales[i % 8];
    const int count = i % 7 == 0 ? static_cast<int>(random.uniform(0, 6))
                                 : static_cast<int>(std::pow(300, random.unit()));
    std::vector<ObstacleBox> boxes;
    for (int k = 0; k < count; ++k) {
      ObstacleBox box = {{}, {}, 3 * k + 1};
      const Vector3d low = pointWithin(random, scale),
                     size = pointWithin(random, 0.2 * scale).cwiseAbs();
      const bool unbounded = random.unit() < 0.01;
      for (int c = 0; c < 3; ++c) {
        box.low[c] = unbounded ? -kInfinity : low[c];
        box.high[c] = unbounded ? kInfinity : low[c] + size[c];
      }
      boxes.push_back(box);
    }
    const ObstacleTree tree(boxes);
    Vector3d p = pointWithin(random, 1.3 * scale);
    if (!boxes.empty() && i % 9 == 0 && boxes[0].high[0] < kInfinity) {  // beside a face
      p = {boxes[0].low[0] * (1 + 1e-9), boxes[0].low[1], boxes[0].high[2]};
    }
    double far = scale * std::pow(10, random.uniform(-4, 0.3));
    // Just near enough, where rounding could lose it.
    if (!boxes.empty() && i % 3 == 0) far = static_cast<double>(distanceTo(p, boxes[0]));
    std::vector<int> found;
    tree.forNear(p, far, [&](int body) {
      found.push_back(body);
      return false;
    });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::unique(found.begin(), found.end()), found.end()) << "found twice";
    for (const ObstacleBox& box : boxes) {
      const bool is_found = std::binary_search(found.begin(), found.end(), box.body);
      const long double distance = distanceTo(p, box);
      if (distance <= far) {
        EXPECT_TRUE(is_found) << i;
      }
      if (scale > 1e-17 && scale < 1e17 && distance > far + kVain * (scale + far)) {
        EXPECT_FALSE(is_found) << i;
      }
    }
  }
}

// Obstacles that come after a path was asked about, and pairs that are allowed, in any order.
TEST(NearPairs, AreThoseToBeChecked) {
  const BodyGeometry box = modelOf(scenes::subdividedBox({0.2, 0.2, 0.2}, 2));
  const auto shifted = [](double x) {
    Transform3d X = Transform3d::Identity();
    X.translation().x() = x;
    return X;
  };
  RobotCase robot;
  Joint joint;
  joint.type = JointType::kPrismatic;
  joint.axis = Vector3d::UnitX();
  robot.addLink(-1, joint);
  robot.addLink(-1, joint);
  const int a = robot.addBody(0, box), b = robot.addBody(1, box, shifted(5));
  const Joints q0 = Joints::Zero(2), q1 = (Joints(2) << 0, 0.01).finished();
  const auto ask = [&] { return checkMotion(robot.linkage, q0, q1); };
  EXPECT_EQ(ask().counts.pairs, 1);
  const int near = robot.addBody(-1, box, shifted(0.1)), far = robot.addBody(-1, box, shifted(9));
  EXPECT_EQ(ask().counts.pairs, 5);
  MotionAnswer answer = ask();
  EXPECT_EQ(answer.verdict, MotionVerdict::kContact);
  EXPECT_EQ(answer.body_a, a);
  EXPECT_EQ(answer.body_b, near);
  robot.allow(near, a);
  robot.allow(a, near);
  robot.allow(near, far);
  EXPECT_EQ(ask().counts.pairs, 4);
  EXPECT_EQ(ask().verdict, MotionVerdict::kClear);
  const Linkage copy = robot.linkage;
  const int last = robot.addBody(-1, box, shifted(5.15));
  answer = ask();
  EXPECT_EQ(answer.verdict, MotionVerdict::kContact);
  EXPECT_EQ(answer.body_a, b);
  EXPECT_EQ(answer.body_b, last);
  EXPECT_EQ(checkMotion(copy, q0, q1).verdict, MotionVerdict::kClear);
  robot.allow(b, a);
  robot.allow(a, b);
  EXPECT_EQ(ask().counts.pairs, 5);
}

}  // namespace
}  // namespace kios::testing
