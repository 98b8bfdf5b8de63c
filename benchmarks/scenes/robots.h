// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "arms.h"

// A humanoid, and scenes of many moving bodies.

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

/// Returns a humanoid of 19 links, 1.8 high: pelvis, chest and head, two arms and two legs of 4
/// links each; 1.2k to 3.0k triangles a link.
Robot humanoid();

/// Returns pairs of links a < b that a planner wouldn't ask about, ascending: neighbours, and those
/// that touch in more than one of twenty random configurations. The links of several robots of one
/// kind are numbered one robot after the other.
std::vector<std::pair<int, int>> allowedPairs(const Robot& robot, int robots = 1);

/// Returns two robots of one kind with their bases at X_W1 and X_W2, each with all its links, which
/// share meshes. Smooth frames are the first of a motion of 400 for three swings of a joint.
BodyScene twoRobots(const Robot& robot, const fcl::Transform3d& X_W1, const fcl::Transform3d& X_W2,
                    int frames, bool smooth, std::uint64_t seed);

/// Returns `count` bodies over many small meshes in a loose, jittered grid, each drifting about its
/// place, so that few are near each other in a frame.
BodyScene driftingCrowd(int count, int frames, std::uint64_t seed);

/// Returns `count` bodies 0.2 to 0.4 across that stand still in a jittered grid of this spacing,
/// each a bumpy ball of its own of so many triangles, a multiple of 20.
BodyScene packedCrowd(int count, int triangles, double spacing, std::uint64_t seed);

/// Returns a robot's configurations, all at random, amid `count` obstacles that stand still and
/// keep clear of its base: what a roadmap planner asks.
BodyScene roadmap(const Robot& robot, int count, int configurations, std::uint64_t seed);

}  // namespace kios::scenes
