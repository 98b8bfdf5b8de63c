// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Motions raise no floating-point flags.
#include "continuous/moving_meshes.h"
#include "fcl/partners.h"
#include "floating_point_flags.h"
#include "scenes/cad_shapes.h"

namespace kios::testing {
namespace {

TEST(MotionTraps, MovingObjects) {
  Flags flags;
  const Geometry torus = kiosModel(scenes::bumpyTorus(200));
  for (const auto& [name, other] : partners()) {
    for (const auto type : kMotionTypes) {
      for (int i = 0; i < 6; ++i) {
        const auto poses = scenes::randomPoses(4, i < 3 ? 2.0 : 0.4, 10 * i);
        flags.during(name + ": continuousCollide", [&] {
          fcl::ContinuousCollisionResultd result;
          fcl::continuousCollide(torus.get(), poses[0], poses[1], other.get(), poses[2], poses[3],
                                 requestFor(type, 1e-3), result);
        });
      }
      flags.during(name + ": continuousCollide, still", [&] {
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(torus.get(), at(0, 0, 0), at(0, 0, 0), other.get(), at(3, 0, 0),
                               at(3, 0, 0), requestFor(type, 1e-3), result);
      });
    }
  }
}

TEST(MotionTraps, Linkages) {
  Flags flags;
  for (const auto& [name, other] : partners()) {
    const bool flat = name == "plane" || name == "halfspace";
    Linkage robot;
    int link = -1;
    for (int i = 0; i < 4; ++i) {
      Joint joint;
      joint.type = i == 2   ? JointType::kPrismatic
                   : i == 3 ? JointType::kFixed
                            : JointType::kRevolute;
      joint.X_PJ = at(0.3 * i, 0.1, 0.4);
      joint.axis = Vector3d(i, 1, -0.5);
      link = robot.addLink(link, joint);
      robot.addBody(link, kiosModel(scenes::stripCylinder(12, 0.5, 0.05)));
    }
    if (!flat && name != "octree") robot.addBody(link, other, at(0, 0, 0.2));
    robot.addBody(-1, other, at(1.2, 0.4, 0.9));
    scenes::Random random(3);
    for (int i = 0; i < 15; ++i) {
      Eigen::VectorXd q0(3), q1(3);
      for (int k = 0; k < 3; ++k) {
        q0[k] = random.uniform(-2, 2);
        q1[k] = i % 4 == 3 ? q0[k] : q0[k] + random.uniform(-0.5, 0.5);
        if (i >= 12) q1[k] = random.uniform(-1, 1) * (i == 12 ? 1e5 : i == 13 ? 1e40 : 0x1p300);
      }
      for (const bool first : {false, true}) {
        MotionRequest request;
        request.first_contact = first;
        request.resolution = 0x1p-10;
        request.max_queries = 1000;
        if (i % 3 == 1) request.min_separation = 0.05;
        flags.during(name + ": checkMotion", [&] { checkMotion(robot, q0, q1, request); });
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
