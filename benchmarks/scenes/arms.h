// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "mesh.h"

// Robots as trees of rigid links. P is the link before, L the link, M its mesh.

namespace kios::scenes {

/// Holds a link and the joint that carries it, which turns about the link's own z.
struct Link {
  fcl::Transform3d X_PL = fcl::Transform3d::Identity();  // at angle 0
  fcl::Transform3d X_LM = fcl::Transform3d::Identity();
  Mesh mesh;
};

/// Links and the joints that carry them; links[0] is the base and has none. A joint turns about its
/// link's own z, after X_PL; parents[i] < i is the link that carries link i.
struct Robot {
  std::vector<Link> links;
  std::vector<int> parents;
  // Each joint swings about its centre by at most its amplitude, in radians.
  std::vector<double> centres, amplitudes;
};

/// Returns poses of the meshes of all links with the base at X_WB and the joints at `angles`.
std::vector<fcl::Transform3d> robotPoses(const Robot& robot, const fcl::Transform3d& X_WB,
                                         const std::vector<double>& angles);

/// Returns joint angles for each frame in the robot's range: uniform, or smooth: sums of two sines
/// whose periods and phases the seed sets, slow enough for about 3 swings of a joint in 400 frames.
std::vector<std::vector<double>> jointMotion(const Robot& robot, int frames, bool smooth,
                                             std::uint64_t seed);

/// Adds a link to a chain, beyond the last one's joint by `reach`. Even links turn about the arm's
/// direction, their z; odd ones bend about an axis across it, with -y along the arm. At X_UM the
/// mesh stands upright on its joint.
void addToChain(Robot& arm, double reach, double centre, double amplitude,
                const fcl::Transform3d& X_UM, Mesh mesh);

/// Returns the pose of a robot that faces another of its kind at the origin.
fcl::Transform3d facing(double distance);

/// Returns an arm of 7 links, base included, 1.5 long when stretched, its joints twisting and
/// bending in turn. Links are assemblies of flanged cylinders and bored blocks of 1.5k to 4.3k
/// triangles.
Robot cadArm();

}  // namespace kios::scenes
