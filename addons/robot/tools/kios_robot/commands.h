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
  std::vector<std::string> scenes, packages, octomaps, joints;
  double padding = 0, within = 0.1, separation = 0;
  bool first = false, srdf_out = false, strict = false, json = false;
  long long boxes = PairRequest().max_boxes;
  double seconds = PairRequest().max_seconds;
  RangeRequest range;
  bool beyond_limits = false, each = false;
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

// What commands have in common: how they read what they are given, and write numbers.
[[noreturn]] void refuse(const std::string& what);

[[gnu::format(printf, 1, 2)]] std::string format(const char* how, ...);
std::string textOf(const Eigen::VectorXd& q, const char* between = ",");
/// Numbers that aren't finite are null.
Json listOf(const Eigen::VectorXd& v);

/// Numbers between commas, or the name of a group state; nothing is 0 or the limit next to it.
/// `option` is what gave it, for messages. Refused beyond the limits, without --beyond-limits.
Eigen::VectorXd configuration(const Robot& robot, const Options& options, const std::string& text,
                              const std::string& option);
/// A coordinate; the limit where it is just beyond, as rounded ones are. Refused likewise.
double limited(const Robot& robot, const Options& options, Eigen::Index i, double x,
               const std::string& option);
/// Configurations of --path, or of standard input by the name -, one a line; at least so many.
/// Without it --from and --to; --from alone if one will do.
std::vector<Eigen::VectorXd> pathOf(const Robot& robot, const Options& options, std::size_t least);
/// Writes the page of a path to the file of --html.
Answer writePage(const Robot& robot, const Options& options,
                 const std::vector<Eigen::VectorXd>& path);

// The commands; see docs/robot.md.
Answer info(const Robot& robot, const Options& options);
Answer contact(const Robot& robot, const Options& options);
Answer clearance(const Robot& robot, const Options& options);
Answer motion(const Robot& robot, const Options& options);
Answer range(const Robot& robot, const Options& options);
Answer pairs(const Robot& robot, const Options& options);
Answer show(const Robot& robot, const Options& options);

}  // namespace kios::robot_tool
