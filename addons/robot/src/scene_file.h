// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cell.h"

namespace kios::robot {

/// What a MoveIt PlanningScene in YAML says of a robot's surroundings.
struct Scene {
  std::vector<std::string> removed;
  std::vector<Object> objects;  ///< obstacles and attached ones, by the robot's links
  std::vector<std::pair<NamePair, bool>> pairs;      ///< of the matrix
  std::vector<std::pair<std::string, bool>> others;  ///< a name, and whether it may touch all else
  std::map<std::string, double> paddings;
};

/// Reads one. Frames are the world's, those of links that no joint moves, those of
/// fixed_frame_transforms, and for what is attached its link's. Throws std::invalid_argument with
/// the file and the line.
Scene readScene(const std::string& file, const Description& robot);

}  // namespace kios::robot
