// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios_robot: what a robot does, by its URDF. Exit status: 0 if it is clear of contact, 1 if it is
// not or that is open, 2 for what can't be read or asked.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.h"
#include "fcl_kios/version.h"

namespace kios::robot_tool {
namespace {

constexpr char kExamples[] = R"(Lengths are in metres, angles in radians. Exit status: 0 clear,
1 in contact or open, 2 for what can't be read or asked.

  kios_robot info arm.urdf --srdf arm.srdf
  kios_robot contact arm.urdf --srdf arm.srdf --scene cell.yaml --at 0,0.5,-1,0,0,0
  kios_robot clearance arm.urdf --srdf arm.srdf --at ready --json
  kios_robot motion arm.urdf --srdf arm.srdf --from ready --to extended --first
  kios_robot range arm.urdf --srdf arm.srdf --joint elbow=-1..2 --json
  kios_robot pairs arm.urdf --to-srdf > arm.srdf
  kios_robot show arm.urdf --scene cell.yaml --path plan.txt --html plan.html)";

struct Command {
  CLI::App* app;
  Answer (*run)(const Robot&, const Options&);
};

std::vector<Command> declare(CLI::App& app, Options& options) {
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("kios_robot ") + FCL_KIOS_VERSION_STRING);
  app.footer(kExamples);
  std::vector<Command> commands;
  const auto add = [&](const char* name, const char* what,
                       Answer (*run)(const Robot&, const Options&)) {
    CLI::App* const command = app.add_subcommand(name, what);
    command->add_option("URDF", options.urdf, "the robot")->required();
    command->add_option("--srdf", options.srdf, "allowed pairs and group states");
    command->add_option("--scene", options.scenes, "MoveIt's planning scene in YAML; repeatable");
    command->add_option("--octomap", options.octomaps, "NAME=FILE of .bt or .ot; repeatable");
    command->add_option("--package", options.packages, "NAME=FOLDER of package://NAME; repeatable");
    command->add_option("--padding", options.padding, "of all links, metres")
        ->check(CLI::Range(0.0, 1e6));
    command->add_flag("--beyond-limits", options.beyond_limits,
                      "takes configurations and ranges beyond the joints' limits");
    command->add_flag("--strict", options.strict, "takes warnings for errors");
    command->add_flag("--json", options.json, "prints JSON");
    commands.push_back({command, run});
    return command;
  };
  const std::string q = "numbers between commas, as 0,0.5,-1, or a group state";
  const std::string at = q + "; without it each is 0, or the limit next to 0";
  const auto addPath = [&](CLI::App* command) {
    return command->add_option("--path", options.path,
                               "FILE of configurations, one a line; - is standard input");
  };
  add("info", "links, coordinates, limits and group states", info);
  CLI::App* const touch = add("contact", "is it in contact?", contact);
  addPath(touch)->excludes(touch->add_option("-q,--at", options.at, at));
  CLI::App* const least = add(
      "clearance", "least clearance to obstacles and to itself, and all that are small", clearance);
  addPath(least)->excludes(least->add_option("-q,--at", options.at, at));
  least->add_option("--within", options.within, "lists pairs up to this, metres")
      ->capture_default_str();
  CLI::App* const way = add("motion", "is the straight path clear?", motion);
  CLI::Option* const start = way->add_option("--from", options.at, at);
  CLI::Option* const end = way->add_option("--to", options.to, q);
  addPath(way)->excludes(start)->excludes(end);
  way->add_option("--separation", options.separation, "farther apart than this, metres");
  way->add_flag("--first", options.first, "asks for the earliest contact");
  way->callback([&options, end] {
    if (options.path.empty() && end->count() == 0) throw CLI::RequiredError("--to or --path");
  });
  CLI::App* const swept =
      add("range", "least clearance over ranges of joints, or over a path, proven", range);
  CLI::Option* const joint = swept->add_option(
      "--joint", options.joints, "NAME=LOWER..UPPER, or NAME for all of its limits; repeatable");
  CLI::Option* const where = swept->add_option("-q,--at,--from", options.at, at);
  CLI::Option* const goal = swept->add_option("--to", options.to, q)->excludes(joint);
  CLI::Option* const plan = addPath(swept)->excludes(where)->excludes(goal)->excludes(joint);
  swept->add_option("--abs-err", options.range.abs_err, "of the bracket, metres; or")
      ->capture_default_str();
  swept->add_option("--rel-err", options.range.rel_err, "of the clearance")->capture_default_str();
  swept->add_option("--ceiling", options.range.ceiling, "no more is asked for, metres");
  swept->add_option("--queries", options.range.max_queries, "that it may take")
      ->capture_default_str();
  swept->add_flag("--each", options.each, "of each pair, the nearest first");
  swept->add_option("--html", options.html, "writes a page of one joint's range, or of the path");
  swept->callback([joint, goal, plan] {
    if (joint->count() + goal->count() + plan->count() > 0) return;
    throw CLI::RequiredError("--joint, --to or --path");
  });
  CLI::App* const page = add("show", "a page to look at: the robot, its obstacles, a path", show);
  CLI::Option* const from = page->add_option("-q,--from,--at", options.at, at);
  CLI::Option* const to =
      page->add_option("--to", options.to, q + ": shows the straight path there");
  addPath(page)->excludes(from)->excludes(to);
  page->add_option("--separation", options.separation, "of the path, metres");
  page->add_option("--html", options.html, "the file to write")->required();
  CLI::App* const all = add("pairs", "settles every pair of links, by proof", pairs);
  all->add_flag("--to-srdf", options.srdf_out, "prints an SRDF that disables what needs no check");
  all->add_option("--boxes", options.boxes, "of configurations a pair may take")
      ->check(CLI::NonNegativeNumber);
  all->add_option("--seconds", options.seconds, "that all may take")->check(CLI::NonNegativeNumber);
  return commands;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"What a robot does, by its URDF: contacts, clearances, proven motions and pairs.",
               "kios_robot"};
  const std::vector<Command> commands = declare(app, options);
  const std::string name = argc > 1 ? argv[1] : "";
  std::string names;
  bool known = !name.empty() && name[0] == '-';
  for (const Command& command : commands) {
    known |= command.app->get_name() == name;
    names += (names.empty() ? "" : ", ") + command.app->get_name();
  }
  if (!known) {
    std::fprintf(stderr, "kios_robot: %s; there are %s. --help says more.\n",
                 name.empty() ? "a command is needed" : ("'" + name + "' is no command").c_str(),
                 names.c_str());
    return 2;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    for (const Command& command : commands) {
      if (!command.app->parsed()) continue;
      const Answer answer = command.run(load(options), options);
      if (options.json) {
        std::printf("%s\n",
                    answer.json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
      } else {
        std::fputs(answer.text.c_str(), stdout);
      }
      return answer.status;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_robot: %s\n", sentenceOf(error).c_str());
  }
  return 2;
}

}  // namespace
}  // namespace kios::robot_tool

int main(int argc, char** argv) { return kios::robot_tool::run(argc, argv); }
