// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arms.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "cad_shapes.h"
#include "placement.h"
#include "random.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

// A link along z, of this length: its own joint's housing at the foot, lying along z or across it,
// a block with a bore, and a flange towards the next joint.
Mesh cadLink(double length, double radius, int segments, bool across) {
  const double housing = 2.6 * radius;
  const Transform3d X_housing =
      across ? Transform3d(turn(kPi / 2, Vector3d::UnitX()) * shift(0, 0, -housing / 2))
             : Transform3d::Identity();
  const double block = 0.45 * length;
  const Transform3d X_block =
      shift(0, 0, 0.55 * length) * turn(kPi / 2, Vector3d::UnitY()) * turn(0.3, Vector3d::UnitX());
  return merged({
      moved(X_housing, flangedCylinder(radius, housing, segments)),
      moved(X_block, boredBlock({block, 1.7 * radius, 1.3 * radius}, 0.15 * radius, 0.1 * radius,
                                0.5 * radius, segments)),
      moved(shift(0, 0, 0.75 * length), flangedCylinder(0.75 * radius, 0.2 * length, segments)),
  });
}

}  // namespace

std::vector<Transform3d> robotPoses(const Robot& robot, const Transform3d& X_WB,
                                    const std::vector<double>& angles) {
  if (angles.size() + 1 != robot.links.size()) {
    throw std::invalid_argument("robotPoses: one angle for each link but the base");
  }
  std::vector<Transform3d> frames, poses;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    Transform3d X_WL = (i == 0 ? X_WB : frames[robot.parents[i]]) * link.X_PL;
    if (i > 0) X_WL = X_WL * turn(angles[i - 1], Vector3d::UnitZ());
    frames.push_back(X_WL);
    poses.push_back(X_WL * link.X_LM);
  }
  return poses;
}

std::vector<std::vector<double>> jointMotion(const Robot& robot, int frames, bool smooth,
                                             std::uint64_t seed) {
  constexpr double kTurnsPerFrame = 3.0 / 400;
  struct Swing {
    double turns_per_frame;
    double phase;
    double share;
  };
  Random random(seed);
  std::vector<std::vector<double>> motion(frames);
  if (!smooth) {
    for (auto& angles : motion) {
      for (std::size_t joint = 0; joint < robot.centres.size(); ++joint) {
        angles.push_back(robot.centres[joint] + robot.amplitudes[joint] * random.uniform(-1, 1));
      }
    }
    return motion;
  }
  for (std::size_t joint = 0; joint < robot.centres.size(); ++joint) {
    Swing swings[2];
    for (Swing& swing : swings) {
      const bool slow = &swing == swings;
      swing.turns_per_frame = kTurnsPerFrame * random.uniform(0.6, 1.4) * (slow ? 1 : 2.3);
      swing.phase = random.uniform(0, 2 * kPi);
      swing.share = slow ? 0.75 : 0.25;
    }
    for (int frame = 0; frame < frames; ++frame) {
      double angle = robot.centres[joint];
      for (const Swing& swing : swings) {
        angle += robot.amplitudes[joint] * swing.share *
                 std::sin(2 * kPi * swing.turns_per_frame * frame + swing.phase);
      }
      motion[frame].push_back(angle);
    }
  }
  return motion;
}

void addToChain(Robot& arm, double reach, double centre, double amplitude, const Transform3d& X_UM,
                Mesh mesh) {
  const bool across = arm.links.size() % 2 == 1;
  Link link;
  if (!arm.links.empty()) {
    link.X_PL = across ? Transform3d(shift(0, 0, reach) * turn(-kPi / 2, Vector3d::UnitX()))
                       : Transform3d(shift(0, -reach, 0) * turn(kPi / 2, Vector3d::UnitX()));
    arm.centres.push_back(centre);
    arm.amplitudes.push_back(amplitude);
  }
  link.X_LM = across ? Transform3d(turn(kPi / 2, Vector3d::UnitX()) * X_UM) : X_UM;
  link.mesh = std::move(mesh);
  arm.parents.push_back(static_cast<int>(arm.links.size()) - 1);
  arm.links.push_back(std::move(link));
}

Transform3d facing(double distance) {
  Transform3d X = shift(distance, 0, 0);
  X.linear() = Vector3d(-1, -1, 1).asDiagonal();
  return X;
}

Robot cadArm() {
  constexpr double kLengths[] = {0.25, 0.22, 0.26, 0.24, 0.22, 0.18, 0.13};
  constexpr double kRadii[] = {0.075, 0.065, 0.06, 0.055, 0.05, 0.045, 0.04};
  constexpr int kSegments[] = {96, 80, 64, 80, 48, 40, 32};
  constexpr double kCentres[] = {0, 0.6, 0, 0.8, 0, 0.5, 0};  // leaning towards +x
  constexpr double kAmplitudes[] = {0, 0.5, 1.5, 0.6, 1.5, 0.8, 1.5};
  Robot arm;
  for (int i = 0; i < 7; ++i) {
    addToChain(arm, i > 0 ? kLengths[i - 1] : 0, kCentres[i], kAmplitudes[i],
               Transform3d::Identity(), cadLink(kLengths[i], kRadii[i], kSegments[i], i % 2 == 1));
  }
  return arm;
}

}  // namespace kios::scenes
