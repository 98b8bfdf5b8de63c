// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cells.h"

#include <algorithm>
#include <cmath>

#include "cad_shapes.h"
#include "motions.h"
#include "placement.h"
#include "shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

/// About 0.3 across.
Mesh obstacle(int kind, int triangles, Random& random) {
  const double size = random.uniform(0.1, 0.2);
  Mesh mesh;
  switch (kind % 4) {
    case 0:
      return flangedCylinder(0.05, 2 * size, std::max(8, triangles / 20));
    case 1:
      return boredBlock(Vector3d(2, 1.4, 0.8) * size, 0.02, 0.01, 0.05,
                        std::max(8, triangles / 48 * 4));
    case 2:
      mesh = bumpyTorus(triangles);
      break;
    default:
      mesh = uvSphere(1, std::max(4, static_cast<int>(std::sqrt(triangles / 4.0))),
                      std::max(8, static_cast<int>(std::sqrt(1.0 * triangles))));
  }
  for (Vector3d& p : mesh.vertices) p *= 0.8 * size;
  return mesh;
}

}  // namespace

bool Cell::admissible(int a, int b) const {
  if (a > b) std::swap(a, b);
  if (a >= moving()) return false;
  return !std::binary_search(allowed.begin(), allowed.end(), std::pair(a, b));
}

void placeLinks(const Cell& cell, const Joints& q, std::vector<Transform3d>& poses) {
  const auto joints = static_cast<std::ptrdiff_t>(cell.robot.centres.size());
  poses.clear();
  auto first = q.begin();
  for (const Transform3d& X_WB : cell.bases) {
    const auto placed = robotPoses(cell.robot, X_WB, {first, first + joints});
    poses.insert(poses.end(), placed.begin(), placed.end());
    first += joints;
  }
}

Cell workCell(const Robot& robot, int count, double size, std::uint64_t seed) {
  constexpr double kNearest = 0.3, kFarthest = 0.9;  // of obstacles from the base's axis
  Random random(seed);
  Cell cell;
  cell.robot = robot;
  cell.bases = {Transform3d::Identity()};
  cell.allowed = allowedPairs(robot);
  const auto add = [&cell](Mesh mesh, const Transform3d& X) {
    cell.obstacles.push_back(std::move(mesh));
    cell.places.push_back(X);
  };
  const int cuts = std::max(2, static_cast<int>(10 * std::sqrt(size)));
  add(subdividedBox({2, 2, 0.06}, cuts), shift(0, 0, -0.05));
  add(subdividedBox({0.05, 2, 1.6}, cuts), shift(-0.75, 0, 0.8));
  add(subdividedBox({2, 0.05, 1.6}, cuts), shift(0, 0.9, 0.8));
  cell.allowed.emplace_back(0, cell.moving());  // the base stands on the table
  const auto turns = randomPoses(count, 1, seed + 1);
  for (int i = 0; i < count; ++i) {
    const double triangles = size * 1000 * std::pow(20.0, random.unit());
    const double far = random.uniform(kNearest, kFarthest), angle = random.uniform(-kPi, kPi);
    Transform3d X = turns[i];
    X.translation() = Vector3d(far * std::cos(angle), far * std::sin(angle), random.uniform(0, 1));
    add(obstacle(i, static_cast<int>(triangles), random), X);
  }
  std::sort(cell.allowed.begin(), cell.allowed.end());
  return cell;
}

Cell sideBySide(const Robot& robot, const Transform3d& X_W2) {
  Cell cell;
  cell.robot = robot;
  cell.bases = {Transform3d::Identity(), X_W2};
  cell.allowed = allowedPairs(robot, 2);
  return cell;
}

Joints randomJoints(const Cell& cell, Random& random) {
  Joints q;
  for (std::size_t r = 0; r < cell.bases.size(); ++r) {
    for (std::size_t i = 0; i < cell.robot.centres.size(); ++i) {
      q.push_back(cell.robot.centres[i] + cell.robot.amplitudes[i] * random.uniform(-1, 1));
    }
  }
  return q;
}

Joints randomStep(const Joints& q, double length, Random& random) {
  Joints step(q.size());
  double most = 0;
  for (double& x : step) {
    x = random.uniform(-1, 1);
    most = std::max(most, std::abs(x));
  }
  for (std::size_t i = 0; i < q.size(); ++i) step[i] = q[i] + length * step[i] / most;
  return step;
}

Joints between(const Joints& q0, const Joints& q1, double s) {
  Joints q(q0.size());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = q0[i] + s * (q1[i] - q0[i]);
  return q;
}

}  // namespace kios::scenes
