// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios_robot: what a robot does, by its URDF. Exit status: 0 if it is clear of contact, 1 if it is
// not or that is open, 2 for what can't be read or asked.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl_kios/robot/robot.h"
#include "show.h"

namespace {

using kios::Robot;

struct Options {
  std::string urdf, srdf, at, to, path, html;
  std::vector<std::string> scenes, packages;
  double padding = 0, within = 0.1, separation = 0;
  bool first = false, srdf_out = false, strict = false;
  long long boxes = kios::PairOptions().max_boxes;
};

Robot load(const Options& options) {
  kios::RobotOptions robot_options;
  robot_options.padding = options.padding;
  for (const std::string& package : options.packages) {
    const std::size_t equals = package.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("--package must be NAME=FOLDER, but is " + package + ".");
    }
    robot_options.packages[package.substr(0, equals)] = package.substr(equals + 1);
  }
  Robot robot = kios::loadRobot(options.urdf, options.srdf, robot_options);
  for (const std::string& scene : options.scenes) robot.addScene(scene);
  for (const std::string& warning : robot.warnings()) {
    std::fprintf(stderr, "kios_robot: warning: %s\n", warning.c_str());
  }
  if (options.strict && !robot.warnings().empty()) {
    throw std::invalid_argument("there are warnings, which --strict makes errors.");
  }
  return robot;
}

/// Numbers between commas, or the name of a group state; nothing is 0 or the limit next to it.
Eigen::VectorXd configuration(const Robot& robot, const std::string& text) {
  if (text.empty()) return robot.lower().cwiseMax(0.0).cwiseMin(robot.upper());
  std::vector<double> values;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    std::size_t end = 0;
    try {
      values.push_back(std::stod(item, &end));
    } catch (const std::exception&) {
      end = 0;
    }
    if (end != item.size() || item.empty()) return robot.state(text);
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Reads configurations, one a line.
std::vector<Eigen::VectorXd> pathOf(const Robot& robot, const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error(name + ": the path can't be read.");
  std::vector<Eigen::VectorXd> path;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty()) continue;
    try {
      path.push_back(configuration(robot, line));
      if (path.back().size() != robot.coordinates()) {
        throw std::invalid_argument("it has " + std::to_string(path.back().size()) +
                                    " coordinates, but the robot " +
                                    std::to_string(robot.coordinates()) + ".");
      }
    } catch (const std::exception& error) {
      throw std::runtime_error(name + ", line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (path.empty()) throw std::runtime_error(name + ": it has no configuration.");
  return path;
}

std::string text(const Eigen::VectorXd& q) {
  std::ostringstream stream;
  stream.precision(6);
  for (Eigen::Index i = 0; i < q.size(); ++i) stream << (i > 0 ? "," : "") << q[i];
  return stream.str();
}

void print(const char* name, const Eigen::Vector3d& p) {
  std::printf("  %-18s %.9g %.9g %.9g\n", name, p.x(), p.y(), p.z());
}

int info(const Robot& robot, const Options&) {
  std::printf("%zu links, %d coordinates\n", robot.links().size(), robot.coordinates());
  for (int i = 0; i < robot.coordinates(); ++i) {
    std::printf("  %-32s %.6g to %.6g\n", robot.joints()[static_cast<std::size_t>(i)].c_str(),
                robot.lower()[i], robot.upper()[i]);
  }
  for (const std::string& name : robot.states()) {
    try {
      std::printf("  state %-26s %s\n", name.c_str(), text(robot.state(name)).c_str());
    } catch (const std::exception& error) {
      std::printf("  state %-26s %s\n", name.c_str(), error.what());
    }
  }
  return 0;
}

int contact(const Robot& robot, const Options& options) {
  const auto found = robot.contact(configuration(robot, options.at));
  if (!found) {
    std::puts("free");
    return 0;
  }
  std::printf("contact of %s and %s\n", found->a.c_str(), found->b.c_str());
  print("point", found->point);
  if (found->id_a >= 0) std::printf("  triangle of %s: %td\n", found->a.c_str(), found->id_a);
  if (found->id_b >= 0) std::printf("  triangle of %s: %td\n", found->b.c_str(), found->id_b);
  return 1;
}

int clearance(const Robot& robot, const Options& options) {
  const Eigen::VectorXd q = configuration(robot, options.at);
  const auto least = robot.clearance(q);
  if (least.a.empty()) {
    std::puts("there is no pair to be checked");
    return 0;
  }
  std::printf("%.9g between %s and %s\n", least.clearance, least.a.c_str(), least.b.c_str());
  print(least.a.c_str(), least.point_a);
  print(least.b.c_str(), least.point_b);
  std::printf("  d/dq               %s\n", text(least.gradient).c_str());
  for (const auto& pair : robot.clearances(q, options.within)) {
    std::printf("  %.9g %s %s\n", pair.clearance, pair.a.c_str(), pair.b.c_str());
  }
  return least.clearance > 0 ? 0 : 1;
}

int motion(const Robot& robot, const Options& options) {
  kios::MotionRequest request;
  request.min_separation = options.separation;
  request.first_contact = options.first;
  const auto answer = robot.checkMotion(configuration(robot, options.at),
                                        configuration(robot, options.to), request);
  if (answer.verdict == kios::MotionVerdict::kClear) {
    std::printf("clear, all along: proven by %lld configurations and %lld queries\n",
                answer.counts.configurations, answer.counts.narrow_queries);
    return 0;
  }
  const bool touches = answer.verdict == kios::MotionVerdict::kContact,
             spent = answer.verdict == kios::MotionVerdict::kBudgetSpent;
  std::printf("%s of %s and %s at %.9g to %.9g of the way\n",
              touches ? "contact"
              : spent ? "budget spent, by"
                      : "unresolved",
              answer.a.c_str(), answer.b.c_str(), answer.from, answer.to);
  return 1;
}

int show(const Robot& robot, const Options& options) {
  std::vector<Eigen::VectorXd> path;
  if (options.path.empty()) {
    path.push_back(configuration(robot, options.at));
    if (!options.to.empty()) path.push_back(configuration(robot, options.to));
  } else {
    path = pathOf(robot, options.path);
  }
  const std::string page = kios::robot_tool::showPage(
      robot, std::filesystem::path(options.urdf).stem().string(), path, options.separation);
  std::ofstream file(options.html, std::ios::binary);
  if (!(file << page) || !file.flush()) {
    throw std::runtime_error(options.html + ": the page can't be written.");
  }
  std::printf("%s: %.1f MB\n", options.html.c_str(), 1e-6 * static_cast<double>(page.size()));
  return 0;
}

int pairs(const Robot& robot, const Options& options) {
  kios::PairOptions pair_options;
  pair_options.max_boxes = options.boxes;
  const auto all = robot.linkPairs(pair_options);
  if (options.srdf_out) {
    std::fputs(kios::toSrdf(all).c_str(), stdout);
    return 0;
  }
  const char* const names[] = {"always", "never", "sometimes", "open"};
  int open = 0;
  for (const auto& pair : all) {
    const auto verdict = static_cast<std::size_t>(pair.verdict);
    open += pair.verdict == kios::PairVerdict::kOpen ? 1 : 0;
    std::printf("%-9s %s %s", names[verdict], pair.a.c_str(), pair.b.c_str());
    if (pair.adjacent) std::printf(", joined by a joint");
    if (pair.verdict == kios::PairVerdict::kNever) {
      std::printf(", proven by %lld boxes", pair.boxes);
    }
    if (pair.verdict == kios::PairVerdict::kSometimes) {
      std::printf("%s, at %s", robot.allowed(pair.a, pair.b) ? ", BUT IT IS ALLOWED" : "",
                  text(pair.q).c_str());
    }
    std::puts("");
  }
  return open > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"What a robot does, by its URDF: contacts, clearances, proven motions and pairs."};
  app.require_subcommand(1);
  struct Command {
    CLI::App* app;
    int (*run)(const Robot&, const Options&);
  };
  std::vector<Command> commands;
  const auto add = [&](const char* name, const char* what,
                       int (*run)(const Robot&, const Options&)) {
    CLI::App* const command = app.add_subcommand(name, what);
    command->add_option("URDF", options.urdf, "the robot")->required();
    command->add_option("--srdf", options.srdf, "allowed pairs and group states");
    command->add_option("--scene", options.scenes, "MoveIt's planning scene in YAML; repeatable");
    command->add_option("--package", options.packages, "NAME=FOLDER of package://NAME; repeatable");
    command->add_option("--padding", options.padding, "of all links, metres");
    command->add_flag("--strict", options.strict, "takes warnings for errors");
    commands.push_back({command, run});
    return command;
  };
  const char* const at = "numbers between commas, or a group state; else 0";
  add("info", "links, coordinates, limits and group states", info);
  add("contact", "is it in contact?", contact)->add_option("-q,--at", options.at, at);
  CLI::App* const least =
      add("clearance", "the least clearance, and all that are small", clearance);
  least->add_option("-q,--at", options.at, at);
  least->add_option("--within", options.within, "lists pairs up to this, metres");
  CLI::App* const way = add("motion", "is the straight path clear?", motion);
  way->add_option("--from", options.at, at);
  way->add_option("--to", options.to, at)->required();
  way->add_option("--separation", options.separation, "farther apart than this, metres");
  way->add_flag("--first", options.first, "asks for the earliest contact");
  CLI::App* const page = add("show", "a page to look at: the robot, its obstacles, a path", show);
  CLI::Option* const from = page->add_option("-q,--from,--at", options.at, at);
  CLI::Option* const to = page->add_option("--to", options.to, "shows the straight path there");
  page->add_option("--path", options.path, "FILE: shows a path, its configurations one a line")
      ->excludes(from)
      ->excludes(to);
  page->add_option("--separation", options.separation, "of the path, metres");
  page->add_option("--html", options.html, "the file to write")->required();
  CLI::App* const all = add("pairs", "settles every pair of links, by proof", pairs);
  all->add_flag("--to-srdf", options.srdf_out, "prints disable_collisions of an SRDF");
  all->add_option("--boxes", options.boxes, "a pair may take");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const Command& command : commands) {
      if (command.app->parsed()) return command.run(load(options), options);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_robot: %s\n", error.what());
  }
  return 2;
}
