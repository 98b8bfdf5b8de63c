// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// An arm before a depth camera: each image becomes a point cloud, an obstacle of balls of a
// centimetre, and a motion is proven clear of what the camera sees, or refuted. The images are made
// here: a table, and a post on it that is gone in the second one.
//
// usage: depth_image

#include <fcl_kios/robot/robot.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

namespace {

constexpr int kWidth = 160, kHeight = 120;

/// Writes an arm of two links that turns about the vertical and lifts.
std::string writeArm() {
  const std::string file = "depth_image_arm.urdf";
  const auto link = [](const char* name, const char* size, const char* at) {
    return "<link name='" + std::string(name) + "'><collision><origin xyz='" + at +
           "'/><geometry><box size='" + size + "'/></geometry></collision></link>\n";
  };
  const auto joint = [](const char* name, const char* parent, const char* child, const char* at,
                        const char* axis) {
    return "<joint name='" + std::string(name) + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + at + "'/><axis xyz='" + axis +
           "'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>\n";
  };
  std::ofstream(file) << "<robot name='arm'>\n"
                      << link("base", "0.15 0.15 0.3", "0 0 0.2")
                      << link("upper", "0.35 0.06 0.06", "0.17 0 0")
                      << link("lower", "0.35 0.05 0.05", "0.17 0 0")
                      << joint("turn", "base", "upper", "0 0 0.4", "0 0 1")
                      << joint("lift", "upper", "lower", "0.36 0 0", "0 1 0") << "</robot>\n";
  return file;
}

/// How far along a ray the table's top is met, or the post that stands on it.
std::optional<double> depthAlong(const fcl::Vector3d& from, const fcl::Vector3d& ray, bool post) {
  constexpr double kTable = 0.02, kRadius = 0.04, kTop = 0.6;
  const fcl::Vector3d axis(0.55, 0, 0);
  if (post) {
    const double a = ray.head<2>().squaredNorm(), b = ray.head<2>().dot((from - axis).head<2>()),
                 c = (from - axis).head<2>().squaredNorm() - kRadius * kRadius;
    if (b * b > a * c) {
      const double t = (-b - std::sqrt(b * b - a * c)) / a, z = from.z() + t * ray.z();
      if (t > 0 && z > kTable && z < kTop) return t;
    }
  }
  if (!(ray.z() < 0)) return std::nullopt;
  return (kTable - from.z()) / ray.z();
}

/// The points of an image, a column each, in the world.
Eigen::Matrix3Xd pointsSeen(bool post) {
  const fcl::Vector3d camera(1.6, 0.3, 1.2), target(0.4, 0, 0.2);
  const fcl::Vector3d forward = (target - camera).normalized(),
                      right = forward.cross(fcl::Vector3d::UnitZ()).normalized(),
                      down = forward.cross(right);
  Eigen::Matrix3Xd points(3, kWidth * kHeight);
  Eigen::Index count = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const fcl::Vector3d ray =
          forward + (u - 0.5 * kWidth) / 140 * right + (v - 0.5 * kHeight) / 140 * down;
      const auto depth = depthAlong(camera, ray, post);
      if (depth && *depth < 3) points.col(count++) = camera + *depth * ray;
    }
  }
  return points.leftCols(count);
}

}  // namespace

int main() {
  kios::Robot robot = kios::loadRobot(writeArm());
  const Eigen::Vector2d from(-0.9, 0.3), to(0.9, 0.3);
  bool right = true;
  for (const bool post : {true, false}) {
    const Eigen::Matrix3Xd points = pointsSeen(post);
    const auto start = std::chrono::steady_clock::now();
    if (!post) robot.remove("seen");
    robot.addPoints("seen", points, 0.01);
    const kios::RobotClearance nearest = robot.clearance(from);
    const kios::RobotMotion motion = robot.checkMotion(from, to);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    const bool clear = motion.verdict == kios::MotionVerdict::kClear;
    std::printf("%ld points: %s at %.3f m from '%s'; the motion is %s (%.1f ms)\n",
                static_cast<long>(points.cols()), nearest.b.c_str(), nearest.clearance,
                nearest.a.c_str(), clear ? "clear" : ("in contact: " + motion.a).c_str(),
                took.count());
    right = right && clear == !post && nearest.clearance > 0;
  }
  return right ? 0 : 1;
}
