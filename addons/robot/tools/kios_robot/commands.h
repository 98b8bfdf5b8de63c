// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"

namespace kios::robot_tool {

using Json = nlohmann::ordered_json;

/// A command line, as it was given.
struct Options {
  std::string urdf, srdf, at, to, path, html;
  std::vector<std::string> scenes, packages;
  double padding = 0, within = 0.1, separation = 0;
  bool first = false, srdf_out = false, strict = false, json = false;
  long long boxes = PairOptions().max_boxes;
  double seconds = PairOptions().max_seconds;
};

/// Throws std::invalid_argument in the words of the command line for what can't be read or asked.
Robot load(const Options& options);

/// What an error says, without the library's name.
std::string sentenceOf(const std::exception& error);

/// What a command says, as JSON and in words, and the exit status.
struct Answer {
  Json json;
  std::string text;
  int status = 0;
};

// The commands; see docs/robot.md.
Answer info(const Robot& robot, const Options& options);
Answer contact(const Robot& robot, const Options& options);
Answer clearance(const Robot& robot, const Options& options);
Answer motion(const Robot& robot, const Options& options);
Answer pairs(const Robot& robot, const Options& options);
Answer show(const Robot& robot, const Options& options);

}  // namespace kios::robot_tool
