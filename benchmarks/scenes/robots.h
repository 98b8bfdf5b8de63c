// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "arms.h"

// Robots as trees of rigid links, and scenes of many moving bodies.

namespace kios::scenes {

/// Holds many bodies over some meshes and, frame by frame, their poses in the world.
struct BodyScene {
  std::vector<Mesh> meshes;
  std::vector<int> mesh_of;                           // by body
  std::vector<bool> obstacle;                         // by body; two obstacles are no pair
  std::vector<std::pair<int, int>> excluded;          // pairs of bodies a < b, ascending
  std::vector<std::vector<fcl::Transform3d>> frames;  // poses of the first bodies, those that move
  std::vector<fcl::Transform3d> places;               // poses of the others

  int size() const { return static_cast<int>(mesh_of.size()); }
  int moving() const { return size() - static_cast<int>(places.size()); }
};

/// Links and the joints that carry them; links[0] is the base and has none. A joint turns about its
/// link's own z, after X_PL; parents[i] < i is the link that carries link i.
struct Robot {
  std::vector<Link> links;
  std::vector<int> parents;
  std::vector<double> centres, amplitudes;  // of the joints, as Arm's
};

Robot robotOf(const Arm& arm);

/// Returns a humanoid of 19 links, 1.8 high: pelvis, chest and head, two arms and two legs of 4
/// links each; 1.2k to 3.0k triangles a link.
Robot humanoid();

/// Returns poses of the meshes with the base at X_WB and the joints at `angles`.
std::vector<fcl::Transform3d> robotPoses(const Robot& robot, const fcl::Transform3d& X_WB,
                                         const std::vector<double>& angles);

/// Returns joint angles for each frame: smooth as armMotion()'s, or uniform in the robot's range.
std::vector<std::vector<double>> jointMotion(const Robot& robot, int frames, bool smooth,
                                             std::uint64_t seed);

/// Returns pairs of links that a planner wouldn't ask about: neighbours, and those that touch in
/// more than one of twenty random configurations.
std::vector<std::pair<int, int>> allowedPairs(const Robot& robot);

/// Returns two robots of one kind with their bases at X_W1 and X_W2, each with all its links, which
/// share meshes. Smooth frames are the first of a motion of 400 for three swings of a joint.
BodyScene twoRobots(const Robot& robot, const fcl::Transform3d& X_W1, const fcl::Transform3d& X_W2,
                    int frames, bool smooth, std::uint64_t seed);

/// Returns `count` bodies over many small meshes in a loose, jittered grid, each drifting about its
/// place, so that few are near each other in a frame.
BodyScene driftingCrowd(int count, int frames, std::uint64_t seed);

/// Returns `count` bodies 0.2 to 0.4 across that stand still in a jittered grid of this spacing,
/// each a mesh of its own: a box for 12 `triangles`, else a bumpy ball of as many, a multiple of
/// 20.
BodyScene packedCrowd(int count, int triangles, double spacing, std::uint64_t seed);

/// Returns a robot's configurations, all at random, amid `count` obstacles that stand still and
/// keep clear of its base: what a roadmap planner asks.
BodyScene roadmap(const Robot& robot, int count, int configurations, std::uint64_t seed);

}  // namespace kios::scenes
