// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What ends a search for the least clearance: ceilings, contact, rounding, what isn't served.
#include "fcl/expect_refused.h"
#include "linkage/joint_ranges.h"
#include "shapes.h"

namespace kios::testing {
namespace {

TEST(JointRangeEnds, CeilingsAndContacts) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
  robot.addLink(0, joint(JointType::kPrismatic, {0, 0, 0}, {0, 1, 0}));
  robot.addBody(1, boxOf(1, 1, 1));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(5, 0.2, 0.1));
  const Joints q0 = joints({0, -0.5}), near = joints({3, 0.5}), in = joints({9, 0.5});
  const JointBox box{{0, -0.5}, {3, 0.5}}, through{{0, -0.5}, {9, 0.5}};
  const auto both = [&](double ceiling, bool contact) {
    RangeRequest request;
    request.ceiling = ceiling;
    return std::vector<RangeResult>{
        leastClearance(robot.linkage, q0, contact ? in : near, request),
        leastClearance(robot.linkage, contact ? through : box, request)};
  };
  for (const RangeResult& result : both(0.9, false)) {
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.lower, 0.9);
    EXPECT_EQ(result.upper, kInf);
    EXPECT_TRUE(result.at.empty());
    EXPECT_EQ(result.body_a, -1);
  }
  for (const RangeResult& result : both(1.1, false)) expectLeast(robot, result, 1, 0.011);
  for (const RangeResult& result : both(1.1, true)) {
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.lower, 0);
    EXPECT_EQ(result.upper, 0);
    const Joints q = placeOf(result);
    EXPECT_EQ(checkMotion(robot.linkage, q, q).verdict, MotionVerdict::kContact);
  }
  // Skins of 0.3 are taken off.
  RangeRequest request = fine(1e-3);
  request.padding = 0.3;
  const RangeResult padded = leastClearance(robot.linkage, q0, near, request);
  EXPECT_NEAR(padded.upper, 0.7, 1e-9);
  EXPECT_GE(padded.lower, 0.7 - 1.1e-3);
  EXPECT_EQ(leastClearance(robot.linkage, q0, in, request).lower, -0.3);
  // Nothing is checked.
  robot.ignorePair(0, 1);
  const RangeResult nothing = leastClearance(robot.linkage, q0, in);
  EXPECT_TRUE(nothing.complete);
  EXPECT_EQ(nothing.lower, kInf);
  EXPECT_TRUE(leastClearances(robot.linkage, box).empty());
}

/// A ball of radius 0.1 on a slide along x, on one along y if in a box, and an obstacle.
RobotCase slide(const BodyGeometry& obstacle, bool crossed,
                const Transform3d& X = shifted(0, 0, 0)) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
  if (crossed) robot.addLink(0, joint(JointType::kPrismatic, {0, 0, 0}, {0, 1, 0}));
  robot.addBody(crossed ? 1 : 0, std::make_shared<fcl::Sphered>(0.1));
  robot.addBody(-1, obstacle, X);
  return robot;
}
std::vector<RangeResult> ofPathAndBox(const RobotCase& robot, double half,
                                      const RangeRequest& request) {
  const Joints q1 = Joints::Constant(robot.linkage.coordinates(), half), q0 = -q1;
  const JointBox box{{q0.begin(), q0.end()}, {q1.begin(), q1.end()}};
  return {leastClearance(robot.linkage, q0, q1, request),
          leastClearance(robot.linkage, box, request),
          leastClearances(robot.linkage, q0, q1, request).at(0),
          leastClearances(robot.linkage, box, request).at(0)};
}

// A ceiling is no proof by itself: at the distance, within rounding of it, and on both sides. The
// clearance is 1 all along.
TEST(JointRangeEnds, CeilingsAtTheDistance) {
  for (const BodyGeometry& floor :
       {BodyGeometry(std::make_shared<fcl::Halfspaced>(Vector3d::UnitZ(), -1.1)),
        BodyGeometry(std::make_shared<fcl::Planed>(Vector3d::UnitZ(), -1.1)),
        BodyGeometry(std::make_shared<fcl::Boxd>(30, 30, 1)), boxOf(30, 30, 1)}) {
    const bool flat =
        floor->getNodeType() == fcl::GEOM_HALFSPACE || floor->getNodeType() == fcl::GEOM_PLANE;
    for (const bool crossed : {false, true}) {
      const RobotCase robot = slide(floor, crossed, shifted(0, 0, flat ? 0 : -1.6));
      for (const double ceiling : {-1.0, 0.0, 0.5, 0.9, 1 - 1e-13, 1.0, 1 + 1e-13, 1.5, kInf}) {
        for (const double padding : {0.0, 0.25}) {
          SCOPED_TRACE(std::to_string(ceiling) + (crossed ? " box" : " path"));
          RangeRequest request = fine(0.01);
          request.ceiling = ceiling;
          request.padding = padding;
          request.max_queries = 20000;
          const double least = 1 - padding;
          for (const RangeResult& result : ofPathAndBox(robot, 0.05, request)) {
            EXPECT_LE(result.lower, least + 1e-9);
            EXPECT_GE(result.upper, least - 1e-9);
            const double known = std::min(ceiling, least);
            const bool narrow = result.lower >= std::min(ceiling, result.upper - 0.0101);
            EXPECT_TRUE(narrow || !result.complete);
            if (std::abs(ceiling - least) > 1e-9) {
              EXPECT_TRUE(result.complete);
            }
            EXPECT_GE(result.lower, known - 0.011);
          }
        }
      }
    }
  }
}

// Parts so near all along that what was seen is enough: nothing need be proven.
TEST(JointRangeEnds, NearerThanTheErrorAllAlong) {
  for (const double gap : {1e-14, 1e-9, 5e-5}) {
    for (const BodyGeometry& floor :
         {boxOf(30, 30, 1), BodyGeometry(std::make_shared<fcl::Boxd>(30, 30, 1))}) {
      for (const bool crossed : {false, true}) {
        const RobotCase robot = slide(floor, crossed, shifted(0, 0, -0.6 - gap));
        for (const RangeResult& result : ofPathAndBox(robot, 5, {})) {
          EXPECT_TRUE(result.complete);
          EXPECT_LE(result.lower, gap + 1e-12);
          EXPECT_LE(result.upper, 2e-4);
          EXPECT_LE(result.queries, 200);
        }
      }
    }
  }
}

// A channel around a body, 0.5 from either wall: no slab parts them, and distances alone prove the
// ceiling.
TEST(JointRangeEnds, CeilingsInAChannel) {
  const Mesh wall = scenes::subdividedBox({1, 8, 4}, 2);
  const Mesh channel =
      scenes::merged({transformed(wall, 1, {-1.5, 0, 0}), transformed(wall, 1, {1.5, 0, 0})});
  for (const bool mesh : {false, true}) {
    RobotCase robot;
    robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {0, 0, 1}));
    robot.addLink(0, joint(JointType::kPrismatic, {0, 0, 0}, {0, 1, 0}));
    robot.addBody(1, mesh ? boxOf(1, 1, 1) : std::make_shared<fcl::Sphered>(0.5));
    robot.addBody(-1, modelOf(channel));
    for (const double ceiling : {0.01, 0.1, 0.4, 0.45}) {
      RangeRequest request;
      request.ceiling = ceiling;
      for (const RangeResult& result : ofPathAndBox(robot, 0.05, request)) {
        EXPECT_TRUE(result.complete);
        EXPECT_EQ(result.lower, ceiling);
        EXPECT_LE(result.queries, 5000);
      }
    }
    for (const RangeResult& result : ofPathAndBox(robot, 0.05, fine(0.01))) {
      EXPECT_TRUE(result.complete);
      EXPECT_LE(result.lower, 0.5);
      EXPECT_NEAR(result.upper, 0.5, 1e-9);
    }
  }
}

// A shape's origin needn't lie in it, nor on its side of a plane.
TEST(JointRangeEnds, ConvexShapesAndPlanes) {
  const auto points = std::make_shared<std::vector<Vector3d>>();
  for (const double z : {1.5, 2.0}) {
    for (const double x : {-0.2, 0.2}) {
      for (const double y : {-0.2, 0.2}) points->emplace_back(x, y, z);
    }
  }
  const auto faces = std::make_shared<std::vector<int>>(std::vector<int>{
      4, 0, 1, 3, 2, 4, 4, 6, 7, 5, 4, 0, 4, 5, 1, 4, 2, 3, 7, 6, 4, 0, 2, 6, 4, 4, 1, 5, 7, 3});
  for (const double side : {1.0, -1.0}) {
    RobotCase robot;
    robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
    robot.addLink(0, joint(JointType::kPrismatic, {0, 0, 0}, {0, 1, 0}));
    robot.addBody(1, std::make_shared<fcl::Convexd>(points, 6, faces));
    robot.addBody(-1, std::make_shared<fcl::Planed>(Vector3d(0, 0, side), side));
    robot.addBody(-1, std::make_shared<fcl::Planed>(Vector3d(0, 0, side), side * 3));
    for (const RangeResult& result : ofPathAndBox(robot, 0.05, fine(0.01))) {
      EXPECT_TRUE(result.complete);
      EXPECT_NEAR(result.upper, 0.5, 1e-9);
      EXPECT_LE(result.lower, 0.5);
      EXPECT_GE(result.lower, 0.5 - 0.01001);
    }
  }
}

// All that turns by one angle is looked at over one turn, wherever its range lies.
TEST(JointRangeEnds, HugeRangesAreOneTurn) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kRevolute, {0, 0, 0}, {0, 0, 2}));  // half a turn is one
  robot.addBody(0, std::make_shared<fcl::Sphered>(0.1), shifted(0.5, 0, 0));
  robot.addBody(-1, boxOf(0.2, 0.2, 0.2), shifted(0, 1, 0));
  for (const auto& [low, high] :
       {std::pair(-1e16, 1e16), std::pair(-1e300, 1e300), std::pair(-kInf, 1e16),
        std::pair(-1e300, 0.5), std::pair(-3.0, 1e300), std::pair(-kInf, kInf)}) {
    const RangeResult result = leastClearance(robot.linkage, JointBox{{low}, {high}}, fine(1e-6));
    expectLeast(robot, result, 0.3, 1e-6, 1e-9);
    EXPECT_LE(result.queries, 10000);
  }
  // Far out a turn is a few steps of doubles; what is said of it holds.
  for (const auto& [low, high] : {std::pair(-kInf, -1e16), std::pair(1e16, kInf)}) {
    const RangeResult result = leastClearance(robot.linkage, JointBox{{low}, {high}}, fine(1e-3));
    EXPECT_LE(result.lower, 0.3);
    EXPECT_GE(result.upper, 0.3 - 1e-9);
  }
}

// Still parts that touch to rounding are told so at once.
TEST(JointRangeEnds, WhatRestsWithinRounding) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kFixed));
  robot.addLink(-1, joint(JointType::kRevolute));
  robot.addBody(0, boxOf(1, 1, 1));
  robot.addBody(1, boxOf(1, 1, 1), shifted(5, 0, 0));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(0, 0, 1 + 1e-14));
  for (const bool first : {false, true}) {
    MotionRequest request;
    request.first_contact = first;
    const MotionResult answer = checkMotion(robot.linkage, joints({0}), joints({1}), request);
    EXPECT_EQ(answer.verdict, MotionVerdict::kUnresolved);
    EXPECT_LE(answer.to - answer.from, request.resolution);
    EXPECT_LE(answer.counts.queries, 10);
    EXPECT_EQ(answer.body_a, 0);
    EXPECT_EQ(answer.body_b, 2);
  }
}

#if FCL_HAVE_OCTOMAP
// A pair that no query serves is neither a proof nor a reason to refuse the others.
TEST(JointRangeEnds, PairsThatAreNotServed) {
  auto tree = std::make_shared<octomap::OcTree>(0.1);
  for (double x = -0.95; x < 1; x += 0.1) {
    for (double y = -0.95; y < 1; y += 0.1) tree->updateNode(x, y, 0.05, true);
  }
  for (const bool crossed : {false, true}) {
    RobotCase robot = slide(
        std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree)), crossed);
    robot.addBody(-1, boxOf(1, 1, 1), shifted(0, 0, 2));
    for (const double ceiling : {0.5, kInf}) {
      RangeRequest request;
      request.ceiling = ceiling;
      const Joints q1 = Joints::Constant(crossed ? 2 : 1, 5), q0 = -q1;
      const JointBox box{{q0.begin(), q0.end()}, {q1.begin(), q1.end()}};
      for (const auto& each : {leastClearances(robot.linkage, q0, q1, request),
                               leastClearances(robot.linkage, box, request)}) {
        ASSERT_EQ(each.size(), 2U);
        EXPECT_FALSE(each[0].complete);
        EXPECT_EQ(each[0].lower, 0);
        EXPECT_EQ(each[0].body_b, 1);
        EXPECT_TRUE(each[1].complete);
      }
      expectRefused([&] { leastClearance(robot.linkage, q0, q1, request); }, "OcTree");
      expectRefused([&] { leastClearance(robot.linkage, box, request); }, "OcTree");
    }
  }
}
#endif

// A ball in a marked box is in contact, though the surfaces are apart all along.
TEST(JointRangeEnds, SolidsInSolids) {
  RobotCase robot;
  const Mesh mesh = scenes::subdividedBox({4, 4, 4}, 2);
  const auto box = makeModel(mesh.vertices, mesh.triangles);
  markSolid(*box);
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
  robot.addBody(0, std::make_shared<fcl::Sphered>(0.1));
  robot.addBody(-1, box);
  const RangeResult result = leastClearance(robot.linkage, joints({-1}), joints({1}));
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.upper, 0);
}

TEST(JointRangeEnds, RefusesWhatIsNoRange) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kRevolute));
  robot.addLink(0, joint(JointType::kPrismatic));
  robot.addBody(1, boxOf(1, 1, 1));
  robot.addBody(-1, boxOf(1, 1, 1), shifted(5, 0, 0));
  const double nan = std::nan("");
  const auto ask = [&](const JointBox& box, const RangeRequest& request = {}) {
    return [&robot, box, request] { leastClearance(robot.linkage, box, request); };
  };
  const JointBox box{{0, 0}, {1, 1}};
  expectRefused(ask({{0}, {1, 1}}), "1 lower and 2 upper ends, but the linkage 2");
  expectRefused(ask({{0, 2}, {1, 1}}), "coordinate 1 is from 2 to 1");
  expectRefused(ask({{nan, 0}, {1, 1}}), "coordinate 0");
  expectRefused(ask({{0, 0}, {1, kInf}}), "coordinate 1 is infinite");
  RangeRequest wrong;
  wrong.rel_err = nan;
  expectRefused(ask(box, wrong), "RangeRequest::rel_err");
  wrong = {};
  wrong.abs_err = -1;
  expectRefused(ask(box, wrong), "RangeRequest::abs_err");
  wrong = {};
  wrong.ceiling = nan;
  expectRefused(ask(box, wrong), "RangeRequest::ceiling");
  wrong = {};
  wrong.max_queries = -1;
  expectRefused(ask(box, wrong), "RangeRequest::max_queries");
  expectRefused([&] { leastClearance(robot.linkage, joints({0}), joints({1, 1})); }, "q0 has 1");
  expectRefused([&] { leastClearance(robot.linkage, joints({0, nan}), joints({1, 1})); }, "NaN");
  robot.ignorePair(0, 1);  // no pair is left
  const auto each = [&](const Joints& q0) {
    return [&robot, q0] { leastClearances(robot.linkage, q0, joints({1, 1})); };
  };
  expectRefused(each(joints({0})), "q0 has 1");
  expectRefused(each(joints({0, nan})), "NaN");
  expectRefused([&] { leastClearances(robot.linkage, JointBox{{0, 0}, {1, kInf}}); }, "infinite");
}

}  // namespace
}  // namespace kios::testing
