// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "contest.h"
#include "scenes/worlds.h"

// What the scenes of 'world' have in common: links of robots at random poses about a world.

namespace kios::bench {

/// Holds meshes that robots are made of.
struct LinkSet {
  std::string name;
  std::vector<scenes::Mesh> meshes;
};

/// Returns a UR5's where the data is there, and parts of machines; a few of them for options.quick.
std::vector<LinkSet> linkSets(const Options& options);

/// Holds a link, by its number, at a pose in the world's frame.
struct PlacedLink {
  std::size_t link;
  fcl::Transform3d X_VL;
};

/// Returns poses near the world for all links in turn.
std::vector<PlacedLink> placedLinks(const scenes::World& world,
                                    const std::vector<scenes::Mesh>& links, int count,
                                    std::uint64_t seed);

/// Returns where worlds stand: not at the origin, nor along its axes.
fcl::Transform3d worldPose();

/// Returns `full` poses, a mesh scene's 42 in the run of all; fewer in proportion where the options
/// name frames; seven for options.quick.
int poseCount(int full, const Options& options);

/// Returns the options with FCL's RSS and OBBRSS beside ours, and a third of the frames judged,
/// where the command line doesn't say.
Options worldOptions(const Options& options);

/// Returns a copy of the task with at most so many of its frames, evenly chosen.
Task fewer(const Task& task, std::size_t frames);

/// Returns a copy of the task as cold as it gets: a few of its frames, 96 MB written before each.
Task colder(const Task& task, const Options& options);

/// Links and worlds as FCL's shapes: boxes of worlds that are made of them, single shapes, octrees.
void reportWorldShapes(const std::vector<LinkSet>& sets, const Options& options, Report& report);

}  // namespace kios::bench
