// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fcl_kios/version.h"
#include "inspect/output.h"
#include "inspection.h"
#include "page.h"
#include "pair_query.h"
#include "progress.h"
#include "report.h"

namespace kios::inspect {
namespace {

// Exit codes beside those of ExitError, as docs/inspect.md and --help list them.
constexpr int kFine = 0, kWarned = 1, kUsage = 2;

const char* const kFooter = R"(
The table by level: volumes of the level (with the leaves above it, so that they contain the whole
mesh) by k, the mean size of their contents (diagonal of the box), and their slack: how far volumes
reach beyond their contents, mean over 162 directions and up to 100 volumes, in parts of the
content's size; the largest; and the mean for sphere S0 alone. Distance bounds are too low by about
the slack, so queries are the faster the sooner it falls.

Coordinates, lengths and triangle numbers are the file's; meshes of a scene are placed by its
transforms and numbered through.

exit codes: 0 done; 1 done, with warnings, under --strict; 2 wrong command line; 3 a file can't be
read or is no mesh that queries can use; 4 a file can't be written)";

/// Holds the options of the command line.
struct Options {
  std::vector<std::filesystem::path> meshes;  // one, or two for their distance
  std::string pose_a = "0,0,0", pose_b = "0,0,0";
  int repeats = 101;
  int level = -1;  // -1: not given
  std::filesystem::path html;
  double html_limit = 20;
  bool repair = false;  // implied by the next three
  double weld = 1e-5;
  int fill_holes = 0;
  std::filesystem::path write;  // the repaired mesh, as OBJ
  bool json = false;
  bool strict = false;
  bool quiet = false;
};

std::string checkPose(const std::string& text) {
  try {
    parsePose(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void declare(CLI::App& app, Options& options) {
  app.add_option("MESH", options.meshes,
                 "one mesh to look at, or two for their distance: STL, OBJ, PLY, DAE, glTF, OFF "
                 "and whatever else assimp reads")
      ->required()
      ->expected(1, 2);
  app.add_option("--pose-a", options.pose_a,
                 "pose of the first of two meshes, x,y,z or x,y,z,qw,qx,qy,qz")
      ->check(checkPose);
  app.add_option("--pose-b", options.pose_b, "pose of the second one")->check(checkPose);
  app.add_option("--repeats", options.repeats, "distance queries that are timed")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--level", options.level,
                 "level of the tree that --html shows first, 0 is the root")
      ->check(CLI::Range(0, 1000000));
  app.add_option("--html", options.html,
                 "write one self-contained page that shows meshes and volumes, to turn");
  app.add_option("--html-limit", options.html_limit,
                 "size of the page in MB; the page says what it leaves out")
      ->check(CLI::Range(1e-6, 1e6))
      ->capture_default_str();
  app.add_flag("--repair", options.repair,
               "look at the repaired mesh, and tell what was changed: near vertices are welded, "
               "degenerate and double triangles left out, components turned outwards");
  app.add_option("--weld", options.weld,
                 "vertices so near to each other are welded, in parts of the box's diagonal; "
                 "implies --repair")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  app.add_option("--fill-holes", options.fill_holes,
                 "fill holes of up to so many edges; implies --repair")
      ->check(CLI::Range(0, int{RepairRequest::kMostHoleEdges}))
      ->capture_default_str();
  app.add_option("--write", options.write, "write the repaired mesh as OBJ; implies --repair");
  app.add_flag("--json", options.json, "print JSON instead of text");
  app.add_flag("--strict", options.strict, "exit with 1 if there is a warning");
  app.add_flag("--quiet", options.quiet, "no progress on stderr");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("kios_inspect ") + FCL_KIOS_VERSION_STRING);
}

/// Refuses a level that none of the meshes has.
void requireLevel(const Options& options, const std::vector<Inspection>& inspections) {
  int deepest = 0;
  for (const Inspection& i : inspections) deepest = std::max(deepest, i.tree->depth());
  if (options.level <= deepest) return;
  throw UsageError("--level " + std::to_string(options.level) + ": the deepest level is " +
                   std::to_string(deepest) + ".");
}

/// Returns the repaired mesh, every coordinate to its last digit.
std::string toObj(const RepairResultd& mesh) {
  std::string text = "# written by kios_inspect\n";
  char line[128];
  for (const fcl::Vector3d& p : mesh.vertices) {
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    text += line;
  }
  for (const fcl::Triangle& t : mesh.triangles) {
    std::snprintf(line, sizeof line, "f %zu %zu %zu\n", t[0] + 1, t[1] + 1, t[2] + 1);
    text += line;
  }
  return text;
}

int run(const Options& options) {
  requireDirectory(options.html);
  requireDirectory(options.write);
  RepairRequest repair;
  repair.relative_weld = options.weld;
  repair.max_hole_edges = options.fill_holes;
  Progress progress(options.quiet);
  const bool two = options.meshes.size() == 2;
  std::vector<Inspection> inspections;
  for (const auto& file : options.meshes) {
    inspections.push_back(inspect(file, !two, progress, options.repair ? &repair : nullptr));
  }

  requireLevel(options, inspections);

  std::optional<PairQuery> pair;
  if (two) {
    progress.step("querying the distance");
    pair = queryPair(*inspections[0].model, parsePose(options.pose_a), *inspections[1].model,
                     parsePose(options.pose_b), options.repeats);
  }
  if (!options.html.empty()) {
    progress.step("writing " + options.html.string());
    writeFile(options.html,
              page(inspections, pair ? &*pair : nullptr, {options.level, options.html_limit}));
  }
  if (!options.write.empty()) writeFile(options.write, toObj(*inspections[0].repaired));
  progress.done();

  bool warned = false;
  for (const Inspection& i : inspections) warned |= !i.warnings().empty();
  if (options.json) {
    Json report = {
        {"version", FCL_KIOS_VERSION_STRING}, {"meshes", Json::array()}, {"pair", nullptr}};
    for (const Inspection& i : inspections) report["meshes"].push_back(toJson(i));
    if (pair) report["pair"] = toJson(*pair);
    std::printf("%s\n", report.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  } else {
    for (const Inspection& i : inspections) std::printf("%s\n", toText(i).c_str());
    if (pair) std::printf("%s", toText(*pair).c_str());
    for (const auto& file : {options.html, options.write}) {
      if (!file.empty()) std::printf("wrote %s\n", file.string().c_str());
    }
  }
  return warned && options.strict ? kWarned : kFine;
}

}  // namespace
}  // namespace kios::inspect

int main(int argc, char** argv) {
  using namespace kios::inspect;
  Options options;
  CLI::App app{"A mesh and the k-IOS volumes that fcl_kios builds for it, to look at.",
               "kios_inspect"};
  try {
    declare(app, options);
    app.parse(argc, argv);
    if (options.meshes.size() == 1 && app.count("--pose-a") + app.count("--pose-b") > 0) {
      throw CLI::ValidationError("--pose-a, --pose-b", "are for two meshes");
    }
    if (options.meshes.size() == 2 && !options.write.empty()) {
      throw CLI::ValidationError("--write", "is for one mesh");
    }
    options.repair |= app.count("--weld") + app.count("--fill-holes") + app.count("--write") > 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kFine : kUsage;
  }
  try {
    return run(options);
  } catch (const ExitError& error) {
    std::fprintf(stderr, "kios_inspect: %s\n", error.what());
    return error.exit_code;
  }
}
