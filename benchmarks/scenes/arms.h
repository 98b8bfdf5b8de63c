// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "mesh.h"

// Serial arms of rigid links. P is the link before, L the link, M its mesh.

namespace kios::scenes {

/// Holds a link and the joint that carries it, which turns about the link's own z.
struct Link {
  fcl::Transform3d X_PL = fcl::Transform3d::Identity();  // at angle 0
  fcl::Transform3d X_LM = fcl::Transform3d::Identity();
  Mesh mesh;
};

/// links[0] is the base, which stands still: it has no joint.
struct Arm {
  std::vector<Link> links;
  // Each joint swings about its centre by at most its amplitude, in radians.
  std::vector<double> centres;
  std::vector<double> amplitudes;
};

/// Returns poses of the meshes of all links with the base at X_WB and the joints at `angles`.
std::vector<fcl::Transform3d> linkPoses(const Arm& arm, const fcl::Transform3d& X_WB,
                                        const std::vector<double>& angles);

/// Returns joint angles for each frame: sums of two sines whose periods and phases the seed sets,
/// smooth and in the arm's range, slow enough for about 3 swings of a joint in 400 frames.
std::vector<std::vector<double>> armMotion(const Arm& arm, int frames, std::uint64_t seed);

/// Returns an arm of 7 links, base included, 1.5 long when stretched, its joints twisting and
/// bending in turn. Links are assemblies of flanged cylinders and bored blocks of 1.5k to 4.3k
/// triangles.
Arm cadArm();

/// Returns a chain of 4 cylinders of length 0.6 whose sides are 100 to 400 strips 0.001 to 0.005
/// wide.
Arm stripChain();

}  // namespace kios::scenes
