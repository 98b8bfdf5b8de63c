// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "robots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cad_shapes.h"
#include "oracle.h"
#include "placement.h"
#include "random.h"
#include "shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

// A limb from its joint at the origin to z = -length: a turned shell between two knuckles.
Mesh limb(double length, double radius, int segments) {
  std::vector<ProfilePoint> profile;
  constexpr int kRings = 12;
  profile.push_back({0, -0.95 * length});
  for (int ring = 1; ring < kRings; ++ring) {
    const double t = static_cast<double>(ring) / kRings;
    const double swell = 0.75 + 0.25 * std::sin(kPi * t) + 0.08 * std::sin(7 * t);
    profile.push_back({radius * swell, -0.95 * length + 0.9 * length * t});
  }
  profile.push_back({0, -0.05 * length});
  const double knuckle = 1.9 * radius;
  return merged({moved(turn(kPi / 2, Vector3d::UnitY()) * shift(0, 0, -knuckle / 2),
                       flangedCylinder(0.6 * radius, knuckle, segments)),
                 turnedPart(profile, segments)});
}

Mesh block(const Vector3d& size, int segments) {
  const double least = size.minCoeff();
  return boredBlock(size, 0.1 * least, 0.05 * least, 0.3 * least, segments);
}

}  // namespace

// Every joint axis lies across the body, along the world's y where the robot stands upright, or
// along x for the joints that abduct: X_PL turns z there, X_LM turns the mesh back.
Robot humanoid() {
  Robot robot;
  const auto add = [&robot](int parent, const Vector3d& at, const Vector3d& axis, double centre,
                            double amplitude, const Mesh& mesh) {
    const Transform3d X_axis(
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix());
    Link link;
    // The parent's frame is turned by its own axis; undo that first.
    const Transform3d X_parent = parent < 0 ? Transform3d::Identity() : robot.links[parent].X_LM;
    link.X_PL = X_parent * shift(at.x(), at.y(), at.z()) * X_axis;
    link.X_LM = X_axis.inverse();
    link.mesh = mesh;
    robot.links.push_back(link);
    robot.parents.push_back(parent);
    if (parent >= 0) {
      robot.centres.push_back(centre);
      robot.amplitudes.push_back(amplitude);
    }
    return static_cast<int>(robot.links.size()) - 1;
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const int pelvis = add(-1, Vector3d::Zero(), z, 0, 0, block({0.16, 0.26, 0.14}, 160));
  const int chest = add(pelvis, {0, 0, 0.32}, z, 0, 0.5, block({0.2, 0.32, 0.34}, 240));
  add(chest, {0, 0, 0.33}, z, 0, 0.8, icosphere(0.11, 3));
  for (const double side : {-1.0, 1.0}) {
    const int shoulder = add(chest, {0, 0.23 * side, 0.12}, y, 0, 1.2,
                             moved(shift(0, 0.02 * side, 0.03), limb(0.12, 0.045, 48)));
    const int upper =
        add(shoulder, {0, 0.06 * side, -0.1}, x, 0.35 * side, 0.35, limb(0.27, 0.05, 64));
    const int fore = add(upper, {0, 0, -0.3}, y, -0.9, 0.8, limb(0.25, 0.04, 48));
    add(fore, {0, 0, -0.28}, x, 0, 0.6, limb(0.16, 0.035, 40));
  }
  for (const double side : {-1.0, 1.0}) {
    const int hip = add(pelvis, {0, 0.11 * side, -0.13}, x, 0.06 * side, 0.12, limb(0.1, 0.05, 48));
    const int thigh = add(hip, {0, 0, -0.13}, y, -0.2, 0.5, limb(0.36, 0.065, 80));
    const int shank = add(thigh, {0, 0, -0.4}, y, 0.5, 0.5, limb(0.36, 0.055, 64));
    add(shank, {0.05, 0, -0.41}, y, -0.1, 0.3, block({0.24, 0.09, 0.06}, 96));
  }
  return robot;
}

std::vector<std::pair<int, int>> allowedPairs(const Robot& robot, int robots) {
  constexpr int kSamples = 40;
  const auto samples = jointMotion(robot, kSamples, false, 7);
  std::vector<std::vector<Transform3d>> poses;
  for (const auto& angles : samples) {
    poses.push_back(robotPoses(robot, Transform3d::Identity(), angles));
  }
  std::vector<std::pair<int, int>> allowed;
  const int links = static_cast<int>(robot.links.size());
  for (int a = 0; a < links; ++a) {
    for (int b = a + 1; b < links; ++b) {
      bool skip = robot.parents[b] == a;
      if (!skip) {
        const MeshOracle oracle(robot.links[a].mesh, robot.links[b].mesh);
        int touching = 0;
        for (const auto& pose : poses) touching += oracle.collide(pose[a], pose[b]) ? 1 : 0;
        skip = touching > kSamples / 20;
      }
      if (skip) allowed.emplace_back(a, b);
    }
  }
  const std::size_t of_one = allowed.size();
  for (std::size_t i = of_one; i < robots * of_one; ++i) {
    const auto [a, b] = allowed[i - of_one];
    allowed.emplace_back(a + links, b + links);
  }
  return allowed;
}

BodyScene twoRobots(const Robot& robot, const Transform3d& X_W1, const Transform3d& X_W2,
                    int frames, bool smooth, std::uint64_t seed) {
  const int links = static_cast<int>(robot.links.size());
  BodyScene scene;
  for (const Link& link : robot.links) scene.meshes.push_back(link.mesh);
  scene.excluded = allowedPairs(robot, 2);
  for (int i = 0; i < 2 * links; ++i) scene.mesh_of.push_back(i % links);
  scene.obstacle.assign(scene.mesh_of.size(), false);
  const auto first = jointMotion(robot, frames, smooth, 2 * seed);
  const auto second = jointMotion(robot, frames, smooth, 2 * seed + 1);
  for (int frame = 0; frame < frames; ++frame) {
    auto poses = robotPoses(robot, X_W1, first[frame]);
    const auto others = robotPoses(robot, X_W2, second[frame]);
    poses.insert(poses.end(), others.begin(), others.end());
    scene.frames.push_back(std::move(poses));
  }
  return scene;
}

}  // namespace kios::scenes
