// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Motions of and in marked solids: what lies in one is in contact, as fcl::collide says, though no
// surfaces meet.

#include "linkage/robot_cases.h"
#include "shapes.h"

namespace kios::testing {
namespace {

BodyGeometry meshBox(const Vector3d& size, bool solid) {
  const Mesh mesh = scenes::subdividedBox(size, 2);
  const auto model = makeModel(mesh.vertices, mesh.triangles);
  if (solid) markSolid(*model);
  return model;
}

/// Returns a box with a cavity, or with another box in it, beside it or around it: two components.
BodyGeometry twoBoxes(const Vector3d& outer, const Vector3d& inner, const Vector3d& place,
                      bool cavity) {
  Mesh second = transformed(scenes::subdividedBox(inner, 1), 1, place);
  for (fcl::Triangle& t : second.triangles) {
    if (cavity) t.set(t[0], t[2], t[1]);
  }
  const Mesh mesh = scenes::merged({scenes::subdividedBox(outer, 1), second});
  const auto model = makeModel(mesh.vertices, mesh.triangles);
  markSolid(*model);
  return model;
}

std::vector<BodyGeometry> smallBodies(double size) {
  return {meshBox({size, size, size}, true), std::make_shared<fcl::Sphered>(0.5 * size),
          std::make_shared<fcl::Capsuled>(0.3 * size, 0.4 * size),
          std::make_shared<fcl::Boxd>(size, size, size),
          std::make_shared<fcl::Coned>(0.4 * size, size)};
}

/// Bodies 0 and 1 on the way from q0 to q1: the first contact, if any, is at its start.
void expectVerdicts(const RobotCase& robot, const Joints& q0, const Joints& q1, bool contact) {
  for (const double separation : {0.0, 0.01}) {
    for (const bool first : {false, true}) {
      MotionRequest request;
      request.first_contact = first;
      request.min_separation = separation;
      const MotionResult answer = checkMotion(robot.linkage, q0, q1, request);
      ASSERT_EQ(answer.verdict, contact ? MotionVerdict::kContact : MotionVerdict::kClear)
          << first << " " << separation;
      if (!contact) continue;
      const Joints q = between(q0, q1, answer.to);
      EXPECT_TRUE(robot.meet(0, robot.linkage.pose(0, q), 1, robot.linkage.pose(1, q), separation));
      if (first) {
        EXPECT_EQ(answer.to, 0);
      }
    }
  }
}

void expectVerdicts(const RobotCase& robot, double from, double to, bool contact) {
  expectVerdicts(robot, Joints::Constant(1, from), Joints::Constant(1, to), contact);
}

TEST(MotionsOfSolids, WhatMovesWithinOneIsInContact) {
  for (const BodyGeometry& body : smallBodies(0.2)) {
    for (const bool swapped : {false, true}) {
      expectVerdicts(slider(body, meshBox({2, 2, 2}, true), swapped), -0.5, 0.5, true);
      expectVerdicts(slider(body, meshBox({2, 2, 2}, true), swapped), 1.2, 3, false);
      if (body->getObjectType() == fcl::OT_GEOM) continue;
      expectVerdicts(slider(body, meshBox({2, 2, 2}, false), swapped), -0.5, 0.5, false);
      // The solid moves, and what is in it stands still.
      expectVerdicts(slider(meshBox({2, 2, 2}, true), body, swapped), -0.5, 0.5, true);
    }
  }
  for (const BodyGeometry& body : smallBodies(0.2)) {  // a mesh that isn't marked has no inside
    expectVerdicts(slider(body, meshBox({2, 2, 2}, false), false), -0.5, 0.5, false);
  }
}

TEST(MotionsOfSolids, ComponentsAndCavities) {
  for (const BodyGeometry& body : smallBodies(0.2)) {
    const BodyGeometry hollow = twoBoxes({4, 4, 4}, {2, 2, 2}, Vector3d::Zero(), true);
    expectVerdicts(slider(body, hollow, false), -0.5, 0.5, false);
    expectVerdicts(slider(body, hollow, false), 1.2, 1.7, true);
    const BodyGeometry two = twoBoxes({1, 1, 1}, {1, 1, 1}, {5, 0, 0}, false);
    expectVerdicts(slider(body, two, false), -0.2, 0.2, true);
    expectVerdicts(slider(body, two, true), 4.8, 5.2, true);
    expectVerdicts(slider(body, two, false), 1, 4, false);
  }
  // One component of the body that moves is in the obstacle, the other far from it.
  const BodyGeometry dumbbell = twoBoxes({0.2, 0.2, 0.2}, {0.2, 0.2, 0.2}, {0, 0, 5}, false);
  expectVerdicts(slider(dumbbell, meshBox({2, 2, 2}, true), false), -0.5, 0.5, true);
}

TEST(MotionsOfSolids, ContinuousCollisionSeesThemToo) {
  const BodyGeometry solid = meshBox({2, 2, 2}, true), soup = meshBox({2, 2, 2}, false);
  for (const BodyGeometry& body : smallBodies(0.2)) {
    for (const auto type : {fcl::CCDM_TRANS, fcl::CCDM_LINEAR, fcl::CCDM_SCREW, fcl::CCDM_SPLINE}) {
      for (const bool swapped : {false, true}) {
        fcl::ContinuousCollisionRequestd request;
        request.ccd_motion_type = type;
        const auto ask = [&](const BodyGeometry& obstacle, const Transform3d& from,
                             const Transform3d& to) {
          fcl::ContinuousCollisionResultd result;
          const Transform3d still = Transform3d::Identity();
          const double time = swapped
                                  ? fcl::continuousCollide(obstacle.get(), still, still, body.get(),
                                                           from, to, request, result)
                                  : fcl::continuousCollide(body.get(), from, to, obstacle.get(),
                                                           still, still, request, result);
          EXPECT_EQ(time, result.time_of_contact);
          EXPECT_EQ(result.is_collide, time < 1);
          return time;
        };
        EXPECT_EQ(ask(solid, shifted(-0.5, 0, 0), shifted(0.5, 0, 0)), 0);
        EXPECT_EQ(ask(solid, shifted(0, 0, 0), shifted(0, 0, 0)), 0);
        EXPECT_EQ(ask(solid, shifted(0, 0, 0), shifted(5, 0, 0)), 0);
        EXPECT_EQ(ask(soup, shifted(-0.5, 0, 0), shifted(0.5, 0, 0)), 1);
        EXPECT_EQ(ask(solid, shifted(1.5, 0, 0), shifted(5, 0, 0)), 1);
        EXPECT_GT(ask(solid, shifted(5, 0, 0), shifted(0, 0, 0)), 0.5);
      }
    }
  }
}

TEST(MotionsOfSolids, OneThatWasOpenedIsRefused) {
  Mesh soup = scenes::soup(scenes::subdividedBox({2, 2, 2}, 1));
  const auto model = makeModel(soup.vertices, soup.triangles);
  markSolid(*model);
  soup.vertices[0] *= 1.5;
  model->beginReplaceModel();
  model->replaceSubModel(soup.vertices);
  model->endReplaceModel();
  const RobotCase robot = slider(meshBox({0.2, 0.2, 0.2}, true), model, false);
  EXPECT_THROW(checkMotion(robot.linkage, Joints::Zero(1), Joints::Ones(1)), std::invalid_argument);
}

// A pair that the path doesn't move, on a slide that it does.
TEST(MotionsOfSolids, WhatNothingMovesLiesInIt) {
  for (const double far : {0.0, 5.0}) {
    RobotCase robot;
    robot.addLink(-1, joint(JointType::kPrismatic));
    robot.addLink(0, joint(JointType::kPrismatic));
    robot.addBody(0, meshBox({2, 2, 2}, true));
    robot.addBody(1, meshBox({0.5, 0.5, 0.5}, true), shifted(far, 0.1, 0));
    expectVerdicts(robot, Joints::Zero(2), Eigen::Vector2d(3, 0), far == 0);
  }
}

}  // namespace
}  // namespace kios::testing
