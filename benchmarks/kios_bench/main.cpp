// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mesh_set.h"
#include "options.h"
#include "report.h"
#include "scenario.h"

namespace kios::bench {
namespace {

void printList() {
  std::printf("scenarios:\n");
  for (const Scenario& scenario : scenarios()) {
    std::printf("  %-18s %s\n", scenario.name, scenario.description);
  }
  std::printf("bounding volumes:\n");
  for (const std::string& bv : volumeNames()) {
    const auto set = makeMeshSet(bv);
    std::printf("  %-18s", bv.c_str());
    for (const Query query : {Query::kDistance, Query::kCollide, Query::kThreshold, Query::kBuild,
                              Query::kPrepare, Query::kRefit}) {
      if (set->serves(query)) std::printf(" %s", name(query));
    }
    std::printf("\n");
  }
}

// Exit code of --check: 1 if a row of ours is wrong, or if there is none.
int check(const std::vector<Row>& rows) {
  constexpr double kMaxErrorPerExtent = 1e-12;
  int judged = 0;
  int failed = 0;
  for (const Row& row : rows) {
    if (row.bv.rfind("kios", 0) != 0 || !row.errors.wrong) continue;
    ++judged;
    const bool allowed =
        row.asked.rel_err.value_or(0) > 0 || row.asked.abs_err.value_or(0) > 0 || row.asked.budget;
    const double error = row.errors.max_abs.value_or(0);
    const bool inexact = !allowed && error > kMaxErrorPerExtent * row.extent;
    if (*row.errors.wrong == 0 && !inexact) continue;
    ++failed;
    std::fprintf(stderr, "kios_bench: %s %s %s: %zu wrong verdicts, error %g\n",
                 row.scenario.c_str(), row.query.c_str(), row.bv.c_str(), *row.errors.wrong, error);
  }
  std::printf("check: %d of %d rows of kios right\n", judged - failed, judged);
  return failed == 0 && judged > 0 ? 0 : 1;
}

int run(int argc, char** argv) {
  CLI::App app{"Compares kios with FCL's bounding volumes on whole scenarios, against an oracle."};
  std::vector<std::string> names;
  for (const Scenario& scenario : scenarios()) names.emplace_back(scenario.name);
  Options options;
  options.scenario = "generated";
  options.bvs = defaultVolumeNames();
  std::string oracle = std::to_string(options.oracle_frames);
  std::string data;
  std::string json;
  std::string markdown;
  std::string robot;
  bool list = false;
  bool check_rows = false;
  app.add_option("scenario", options.scenario, "what to run")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_option("--data", data, "folder of the benchmark data")->check(CLI::ExistingDirectory);
  app.add_option("--bv", options.bvs, "bounding volumes, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(volumeNames()));
  app.add_option("--frames", options.frames, "frames of each scene, evenly chosen")
      ->check(CLI::PositiveNumber);
  app.add_option("--repeats", options.repeats, "repeats of each measurement")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--oracle", oracle, "number of frames judged by the oracle, or 'all'")
      ->check(CLI::PositiveNumber | CLI::IsMember({"all"}))
      ->capture_default_str();
  app.add_option("--max-triangles", options.max_triangles,
                 "largest meshes of 'scaling', to 1000000")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--robot", robot,
                 "folder of binary STL and OBJ files, by name the links of a robot for 'robots'")
      ->check(CLI::ExistingDirectory);
  app.add_option("--seed", options.seed, "seed of generated poses")->capture_default_str();
  app.add_option("--json", json, "file for one JSON object a row");
  app.add_option("--markdown", markdown, "file for the table of 'stability'");
  app.add_flag("--quick", options.quick, "few frames and repeats: a smoke test");
  app.add_flag("--check", check_rows, "exit with 1 if an answer of kios is wrong");
  app.add_flag("--list", list, "list scenarios and bounding volumes");
  CLI11_PARSE(app, argc, argv);

  if (list) {
    printList();
    return 0;
  }
  if (options.quick && app.count("--repeats") == 0) options.repeats = 2;
  options.oracle_frames = oracle == "all" ? 0 : std::stoi(oracle);
  if (!data.empty()) options.data = data;
  if (!markdown.empty()) options.markdown = markdown;
  if (!robot.empty() && options.scenario != "robots") {
    throw std::invalid_argument("--robot is an option of the scenario 'robots'");
  }
  if (!robot.empty()) options.robot = robot;
  const auto scenario = std::find_if(scenarios().begin(), scenarios().end(),
                                     [&](const auto& s) { return s.name == options.scenario; });
  Report report(json.empty() ? std::nullopt : std::optional<std::filesystem::path>(json));
  try {
    scenario->run(options, report);
  } catch (const Skipped& reason) {
    std::printf("skipped: %s: %s\n", scenario->name, reason.what());
    return 0;
  }
  return check_rows ? check(report.rows()) : 0;
}

}  // namespace
}  // namespace kios::bench

int main(int argc, char** argv) {
  try {
    return kios::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_bench: %s\n", error.what());
    return 2;
  }
}
