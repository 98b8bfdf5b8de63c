// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkage/robot_cases.h"

// What moves in each other with little clearance: rods, rings and bowls.

namespace kios::testing {

inline constexpr double kPi = 3.141592653589793;

/// Returns a ring around z, its wall from inner(angle) of its corners within to `outer` of those
/// without.
template <typename Inner>
Mesh ringOf(const Inner& inner, double outer, double height, int n) {
  Mesh mesh;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * i / n;
    for (const double r : {inner(angle), outer}) {
      for (const double z : {-0.5 * height, 0.5 * height}) {
        mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  }
  const auto id = [&](int i, int k) { return static_cast<std::size_t>(4 * (i % n) + k); };
  for (int i = 0; i < n; ++i) {
    for (const auto& [k, l] :
         {std::pair(0, 1), std::pair(2, 3), std::pair(0, 2), std::pair(1, 3)}) {
      mesh.triangles.emplace_back(id(i, k), id(i, l), id(i + 1, l));
      mesh.triangles.emplace_back(id(i, k), id(i + 1, l), id(i + 1, k));
    }
  }
  return mesh;
}

/// Returns a ring whose wall begins at the radius `inner` of the faces within.
inline Mesh ring(double inner, double outer, double height, int n) {
  return ringOf([&](double /*angle*/) { return inner / std::cos(kPi / n); }, outer, height, n);
}

/// Returns a prism about z, `radius` to its corners, which are turned by `turn` of a side.
inline Mesh rod(double radius, double height, int n, double turn) {
  Mesh mesh;
  mesh.vertices = {{0, 0, -0.5 * height}, {0, 0, 0.5 * height}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * (i + turn) / n;
    for (const double z : {-0.5 * height, 0.5 * height}) {
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  for (int i = 0; i < n; ++i) {
    const std::size_t a = 2 + 2 * static_cast<std::size_t>(i);
    const std::size_t b = 2 + 2 * static_cast<std::size_t>((i + 1) % n);
    mesh.triangles.emplace_back(0, b, a);
    mesh.triangles.emplace_back(1, a + 1, b + 1);
    mesh.triangles.emplace_back(a, b, b + 1);
    mesh.triangles.emplace_back(a, b + 1, a + 1);
  }
  return mesh;
}

/// Returns a part of a sphere's mesh, from the polar angle `from` on.
inline Mesh bowl(double radius, double from, int n, int rows) {
  Mesh mesh;
  for (int i = 0; i <= rows; ++i) {
    const double polar = from + (kPi - from) * i / rows;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * k / n;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(angle),
                                 radius * std::sin(polar) * std::sin(angle),
                                 radius * std::cos(polar));
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < n; ++k) {
      const auto a = static_cast<std::size_t>(i * n + k),
                 b = static_cast<std::size_t>(i * n + (k + 1) % n),
                 row = static_cast<std::size_t>(n);
      mesh.triangles.emplace_back(a, b, b + row);
      mesh.triangles.emplace_back(a, b + row, a + row);
    }
  }
  return mesh;
}

/// Returns a body on joints about, or along, `axes` through the origin of a frame that is anywhere.
inline RobotCase fitted(const BodyGeometry& body, const BodyGeometry& around, JointType type,
                        const std::vector<Vector3d>& axes, bool turned) {
  RobotCase robot;
  Transform3d X = Transform3d::Identity();
  if (turned) {
    X.linear() = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized().toRotationMatrix();
    X.translation() = Vector3d(0.3, 0.2, 0.1);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Joint joint;
    joint.type = type;
    joint.axis = axes[i];
    if (i == 0) joint.X_PJ = X;
    robot.addLink(static_cast<int>(i) - 1, joint);
  }
  robot.addBody(static_cast<int>(axes.size()) - 1, body);
  robot.addBody(-1, around, X);
  return robot;
}

/// All that is proven is compared with samples by expectRight().
inline void expectClear(const RobotCase& robot, const Joints& q1, long long most_queries,
                        double separation = 0) {
  const Joints q0 = Joints::Zero(q1.size());
  for (const bool first : {false, true}) {
    MotionRequest request;
    request.first_contact = first;
    request.min_separation = separation;
    const MotionResult answer = checkMotion(robot.linkage, q0, q1, request);
    EXPECT_EQ(answer.verdict, MotionVerdict::kClear) << first;
    EXPECT_LE(answer.counts.queries, most_queries) << first;
  }
  EXPECT_EQ(robot.firstSample(q0, q1, 50, separation), 2);
}

/// Returns a shaft with a key, that turns in a ring with a slot for it: clear within 0.7 either
/// way, though the key reaches farther than the ring's wall elsewhere. The motion turns it.
inline RobotCase keyInSlot(double clearance) {
  constexpr int kSides = 64;
  const auto angleOf = [](double angle) { return angle > kPi ? angle - 2 * kPi : angle; };
  const Mesh hole = ringOf(
      [&](double angle) {
        const double wall = (std::abs(angleOf(angle)) < 0.9 ? 0.013 : 0.01) + clearance;
        return wall / std::cos(kPi / kSides);
      },
      0.03, 0.1, kSides);
  Mesh shaft = rod(0.01, 0.2, kSides, 0);
  for (Vector3d& p : shaft.vertices) {
    if (std::abs(std::atan2(p.y(), p.x())) < 0.15 && p.head(2).norm() > 0) p.head(2) *= 1.3;
  }
  return fitted(modelOf(shaft), modelOf(hole), JointType::kRevolute, {{0, 0, 1}}, false);
}

}  // namespace kios::testing
