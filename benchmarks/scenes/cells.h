// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "random.h"
#include "robots.h"

// Robots at work, and straight paths in their joint space, as planners ask about them.

namespace kios::scenes {

/// Holds robots of one kind that stand at their bases among obstacles. Bodies are the links of the
/// first robot, those of the second, and the obstacles. The joints of all robots are one vector q.
struct Cell {
  Robot robot;
  std::vector<fcl::Transform3d> bases;  // in the world
  std::vector<Mesh> obstacles;
  std::vector<fcl::Transform3d> places;      // of the obstacles in the world
  std::vector<std::pair<int, int>> allowed;  // pairs of bodies a < b that may touch, ascending

  int links() const { return static_cast<int>(robot.links.size()); }
  int moving() const { return links() * static_cast<int>(bases.size()); }
  int bodies() const { return moving() + static_cast<int>(obstacles.size()); }
  int coordinates() const {
    return static_cast<int>(robot.centres.size()) * static_cast<int>(bases.size());
  }
  const Mesh& mesh(int body) const {
    return body < moving() ? robot.links[body % links()].mesh : obstacles[body - moving()];
  }
  bool admissible(int a, int b) const;
};

/// Holds joint values.
using Joints = std::vector<double>;

/// Poses of all links at q, which are overwritten.
void placeLinks(const Cell& cell, const Joints& q, std::vector<fcl::Transform3d>& poses);

/// Returns one robot on a table between two walls, amid `count` obstacles of 1,000 to 20,000
/// triangles, or `size` times that.
Cell workCell(const Robot& robot, int count, double size, std::uint64_t seed);

/// Returns two robots whose workspaces overlap, the second at X_W2, and nothing else.
Cell sideBySide(const Robot& robot, const fcl::Transform3d& X_W2);

/// Returns a configuration in the robots' range.
Joints randomJoints(const Cell& cell, Random& random);

/// From q in a random direction, the joint that turns most by `length` radians.
Joints randomStep(const Joints& q, double length, Random& random);

/// Returns q0 + s (q1 - q0)
Joints between(const Joints& q0, const Joints& q1, double s);

}  // namespace kios::scenes
