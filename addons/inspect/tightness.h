// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "volume_tree.h"

namespace kios::inspect {

/// The support function of a volume: returns how far it reaches along the unit vector n from the
/// centre of S0, low by at most 1e-5 of S0's radius.
double support(const kIOSd& volume, const fcl::Vector3d& n);

/// Holds the slack of a volume in a direction: how far it reaches beyond its content there
/// (difference of their support functions), in units of the content's size, the diagonal of its
/// box. The bound that the volume gives for a distance is too low by about that much. Measured in
/// 162 directions.
struct Slack {
  double size = 0;           ///< of the content, in the file's units
  double mean = 0, max = 0;  ///< over directions
  double mean_s0 = 0;        ///< of sphere S0 alone, as if it were the volume
};

/// Returns the slack of a node's volume; no slack if its content is a single point.
Slack slackOf(const VolumeTree& tree, int node);

/// Measures of the volumes of a level.
struct LevelTightness {
  int level = 0;
  std::size_t volumes = 0;
  std::size_t leaves = 0;             ///< of a single triangle
  std::array<std::size_t, 3> k = {};  ///< volumes of 1, 3 and 5 spheres
  std::size_t measured = 0;           ///< volumes, evenly chosen, that the rest is about
  Slack slack;                        ///< means over them; `max` is the largest
};

/// Takes `nodes`: a level's, all of them.
LevelTightness measure(const VolumeTree& tree, int level, const std::vector<int>& nodes);

}  // namespace kios::inspect
