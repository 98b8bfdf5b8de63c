// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "race.h"
#include "scenario.h"

namespace kios::bench {
namespace {

namespace fs = std::filesystem;

/// Holds a row of the client (benchmarks/preload) at some sizes.
struct Rows {
  const char* name;
  std::vector<int> triangles;
};

/// Says what a client printed.
struct Measured {
  double us = 0, sum = 0;
};

/// Returns the folder of this program, where its clients lie.
fs::path programFolder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// Runs a client, with the library preloaded unless the mode is empty.
Measured run(const std::string& mode, const fs::path& front, const std::string& command) {
  const std::string with =
      mode.empty() ? std::string()
                   : "FCL_KIOS_PRELOAD=" + mode + " LD_PRELOAD='" + front.string() + "' ";
  FILE* const pipe = popen((with + command).c_str(), "r");
  if (!pipe) throw Skipped("no process can be started");
  Measured measured;
  double ns = 0;
  const int read = std::fscanf(pipe, "%lf %lf", &ns, &measured.sum);
  if (pclose(pipe) != 0 || read != 2) throw Skipped("a client failed: " + command);
  measured.us = ns / 1000;
  return measured;
}

/// Processes with and without the library take turns.
std::vector<Row> measure(const std::string& scenario, const fs::path& front,
                         const std::string& command, std::size_t triangles, int repeats) {
  constexpr std::array<const char*, 3> kModes = {"", "on", "trust"};
  constexpr std::array<const char*, 3> kNames = {"fcl_obbrss", "kios", "kios_trust"};
  std::array<std::vector<Measured>, 3> measured;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t m = 0; m < kModes.size(); ++m) {
      const std::size_t mode = (m + static_cast<std::size_t>(repeat)) % kModes.size();
      measured[mode].push_back(run(kModes[mode], front, command));
    }
  }
  std::vector<Row> rows;
  for (std::size_t mode = 0; mode < kModes.size(); ++mode) {
    Row row;
    row.scenario = scenario;
    row.query = scenario.find("distance") != std::string::npos ? "distance" : "collide";
    row.bv = kNames[mode];
    row.triangles = triangles;
    std::vector<double> us, ratios;
    bool wrong = false;
    for (std::size_t i = 0; i < measured[mode].size(); ++i) {
      const Measured &fcl = measured[0][i], &own = measured[mode][i];
      us.push_back(own.us);
      ratios.push_back(fcl.us / own.us);
      // Distances of shapes are as exact as FCL's solvers.
      wrong = wrong || !(std::abs(own.sum - fcl.sum) <= 1e-5 * std::abs(fcl.sum));
    }
    row.frames = us.size();
    row.times = {median(us), *std::min_element(us.begin(), us.end()), median(ratios)};
    row.errors.wrong = wrong ? 1 : 0;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

void runPreload(const Options& options, Report& report) {
  const fs::path folder = programFolder(), front = folder.parent_path() / "libfcl_kios_preload.so",
                 client = folder / "preload_client", dart = folder / "preload_dart";
  if (!fs::exists(front) || !fs::exists(client)) {
    throw Skipped("the preloaded library and its client aren't built: " + front.string());
  }
  const std::vector<Rows> all = {{"distance_near", {1000, 5000, 100000}},
                                 {"distance_far", {100000}},
                                 {"distance_near_bounded", {5000, 100000}},
                                 {"distance_box_near", {5000}},
                                 {"distance_octree_near", {5000}},
                                 {"collide_reject", {5000}},
                                 {"collide_near", {5000, 100000}},
                                 {"collide_touch", {5000}},
                                 {"collide_deep", {5000, 100000}},
                                 {"collide_deep_contacts", {5000}},
                                 {"collide_box_near", {20000}},
                                 {"collide_sphere_near", {5000}}};
  const int repeats = options.quick ? 1 : options.repeats;
  for (const Rows& rows : all) {
    for (const int triangles : rows.triangles) {
      if (options.quick && triangles > 5000) continue;
      const std::string name = rows.name;
      const auto names = [&](const char* word) { return name.find(word) != std::string::npos; };
      const char* const times = names("reject")     ? " 2000"
                                : names("collide")  ? " 100"
                                : triangles > 20000 ? " 12"
                                                    : " 30";
      const std::string command =
          "'" + client.string() + "' " + name + " " + std::to_string(triangles) + times;
      report.add(measure(std::string("preload/") + rows.name + "/" + std::to_string(triangles),
                         front, command, 2 * static_cast<std::size_t>(triangles), repeats));
    }
  }
  if (!fs::exists(dart)) return;
  // Three robots of seven links: a query is the distance of two of them.
  const std::string links = (fs::temp_directory_path() / "kios_bench_link").string();
  report.add(measure(
      "preload/dart_distance", front,
      "'" + dart.string() + "' time '" + links + "." + std::to_string(getpid()) + "'", 0, repeats));
}

}  // namespace kios::bench
