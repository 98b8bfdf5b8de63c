// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mbm_problems.h"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace kios::bench {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

Problem readProblem(const fs::path& scene, const fs::path& request, const Robot& robot) {
  const YAML::Node root = YAML::LoadFile(request.string());
  Problem problem;
  problem.name = scene.parent_path().filename().string() + "/" + request.stem().string();
  problem.scene = scene;
  problem.start = problem.goal = VectorXd::Zero(robot.coordinates());
  int found = 0;
  const auto set = [&](VectorXd& q, const YAML::Node& name, const YAML::Node& value) {
    const auto at = std::find(robot.joints().begin(), robot.joints().end(), name.as<std::string>());
    if (at == robot.joints().end()) return;
    q[at - robot.joints().begin()] = value.as<double>();
    ++found;
  };
  const YAML::Node state = root["start_state"]["joint_state"];
  for (std::size_t i = 0; i < state["name"].size(); ++i) {
    set(problem.start, state["name"][i], state["position"][i]);
  }
  for (const YAML::Node& joint : root["goal_constraints"][0]["joint_constraints"]) {
    set(problem.goal, joint["joint_name"], joint["position"]);
  }
  if (found != 2 * robot.coordinates()) {
    throw std::runtime_error(request.string() + " doesn't name all joints once");
  }
  return problem;
}

}  // namespace

std::vector<Problem> readProblems(const fs::path& folder, const Robot& robot, std::size_t wanted) {
  std::map<fs::path, std::vector<fs::path>> kinds;
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    if (file.path().filename().string().rfind("scene", 0) == 0) {
      kinds[file.path().parent_path()].push_back(file.path());
    }
  }
  const std::size_t of_kind = (wanted + kinds.size() - 1) / std::max<std::size_t>(1, kinds.size());
  for (auto& [kind, scenes] : kinds) std::sort(scenes.begin(), scenes.end());
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < of_kind; ++i) {
    for (const auto& [kind, scenes] : kinds) {
      const std::size_t chosen = std::min(of_kind, scenes.size());
      if (i >= chosen) continue;
      const fs::path& scene = scenes[i * scenes.size() / chosen];
      const std::string number = scene.stem().string().substr(5);
      problems.push_back(readProblem(scene, kind / ("request" + number + ".yaml"), robot));
    }
  }
  return problems;
}

Unpacked::Unpacked(const fs::path& archive) {
  static int count = 0;
  path_ = fs::temp_directory_path() /
          ("kios_bench_" + std::to_string(getpid()) + "_" + std::to_string(count++));
  fs::create_directories(path_);
  const std::string command = "tar -xjf '" + archive.string() + "' -C '" + path_.string() + "'";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("tar couldn't unpack " + archive.string() + " (is bzip2 installed?)");
  }
}

Unpacked::~Unpacked() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace kios::bench
