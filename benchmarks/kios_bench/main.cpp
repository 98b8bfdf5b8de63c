// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "compare.h"
#include "least.h"
#include "library.h"
#include "mesh_set.h"
#include "options.h"
#include "report.h"
#include "scenario.h"

namespace kios::bench {
namespace {

/// Holds a named set of scenes.
struct Scenario {
  const char* name;
  const char* parts;  ///< that the command line may name, as SCENARIO/PART; empty for none
  const char* description;
  void (*run)(const Options& options, Report& report);
  /// Says how many of each scene `--least` takes; 0 where nothing of FCL's stands beside ours.
  int least_frames;
};

constexpr Scenario kScenarios[] = {
    {"tori", "falling spinning generated scaling",
     "the k-IOS paper's moving pairs (data), the same kind made by the program, and bumpy tori "
     "of "
     "1k to 80k triangles (1M by --max-triangles): gap 0.1, 1e-3, touching",
     runTori, 100},
    {"robots", "ur5 generated parts scenes",
     "two arms side by side, all pairs of links: UR5 (data), generated, machine parts; "
     "scene queries of them and of humanoids",
     runRobots, 10},
    {"world", "SCENE coal",
     "a UR5's links (data) and parts of machines about tables, shelves, rooms, terrain, a "
     "building, as meshes, shapes and octrees; hot and cold; Coal's OBBRSS beside, if named",
     runWorld, 14},
    {"scene", "bodies crowds",
     "5,000 drifting bodies; an arm's 1,000 configurations amid 5,000 obstacles; 2,000 different "
     "small bodies in FCL's manager: made and asked about, and asked again",
     runScene, 20},
    {"shapes", "", "a mesh of 20k triangles against eight shapes and an octree", runShapes, 20},
    {"rays", "",
     "first, any and all hits of camera rays, random rays and rays at edges, bumpy tori and "
     "strips; FCL has no rays",
     runRays, 0},
    {"solids", "contains penetration depth points",
     "points in solids; penetration and local depth of boxes, balls, a blob in a torus, links in "
     "a table; 100,000 nearest points and signed distances, beside balls of radius 0; winding "
     "numbers",
     runSolids, 0},
    {"clashes", "1000 10000 pieces",
     "clashes, touches and duplicates planted in a building of some 1,000 and 10,000 slabs, "
     "columns, "
     "walls and pipes; its contacts by FCL's manager; time against the width of depths",
     runClashes, 1},
    {"motions", "paths range moved continuous",
     "straight paths in joint space, UR5 (data) or a generated arm amid obstacles, and two arms: "
     "proven, and sampled 0.01 rad apart; the least clearance over ranges; contact amid spheres "
     "of which one moves; first contact in time "
     "of two tori on random motions",
     runMotions, 20},
#ifdef KIOS_HAVE_ROBOT
    {"mbm", "panda ur5",
     "MotionBenchMaker's problems (data) by RRT-Connect: edges proven, sampled, and by FCL's "
     "manager",
     runMbm, 0},
#endif
    {"build", "models refit",
     "endModel, the same mesh again, memory: tori of 1k to 80k triangles (1M by --max-triangles), "
     "and "
     "the UR5 (data); refits of tori that sway",
     runBuild, 8},
    {"error", "",
     "run time against error: tolerances, budgets and thresholds over moving pairs, FCL's nodes "
     "with their error members set",
     runError, 20},
    {"paper", "", "the k-IOS paper's constructions and volumes of others over one tree", runPaper,
     0},
    {"stability", "triangles queries",
     "triangle distance and intersection over hard classes of pairs, and FCL's; points, local "
     "depths and clashes over hard classes of solids",
     runStability, 0},
#ifdef KIOS_HAVE_PRELOAD
    {"preload", "", "a program that knows FCL alone, with and without the preloaded library; DART",
     runPreload, 0},
#endif
};

constexpr char kColumns[] =
    "Columns: median_us and min_us are the time of a frame, us/pair of one of its queries; x "
    "OBBRSS "
    "is\nOBBRSS's time by this one, so that above 1 is faster; BV tests and leaves (pairs of "
    "triangles) are\ncounted a frame; err/extent is the largest error by the mesh's size, and "
    "wrong "
    "counts verdicts, both\nby an oracle; B/tri and peak/tri are bytes a triangle of a model and "
    "while it is built, build/tri us;\nk, floats and tightness are means over volumes; - is not "
    "measured.\n";

void printList() {
  std::printf("scenarios:\n");
  for (const Scenario& scenario : kScenarios) {
    std::printf("  %-12s %s%s%s%s\n", scenario.name, scenario.description,
                *scenario.parts ? " (" : "", scenario.parts, *scenario.parts ? ")" : "");
  }
  std::printf("bounding volumes:\n");
  for (const std::string& bv : volumeNames()) {
    const auto set = makeMeshSet(bv);
    std::printf("  %-18s", bv.c_str());
    for (const Query query :
         {Query::kDistance, Query::kCollide, Query::kCloserThan, Query::kBuild, Query::kRefit}) {
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
    if (row.bv.rfind("kios", 0) != 0 || (!row.errors.wrong && !row.errors.max_abs)) continue;
    ++judged;
    const std::size_t wrong = row.errors.wrong.value_or(0);
    const bool allowed =
        row.asked.rel_err.value_or(0) > 0 || row.asked.abs_err.value_or(0) > 0 || row.asked.budget;
    const double error = row.errors.max_abs.value_or(0);
    const bool inexact = !allowed && error > kMaxErrorPerExtent * row.extent;
    if (wrong == 0 && !inexact) continue;
    ++failed;
    std::fprintf(stderr, "kios_bench: %s %s %s: %zu wrong verdicts, error %g\n",
                 row.scenario.c_str(), row.query.c_str(), row.bv.c_str(), wrong, error);
  }
  std::printf("check: %d of %d rows of kios right\n", judged - failed, judged);
  return failed == 0 && judged > 0 ? 0 : 1;
}

const Scenario& scenarioOf(const std::string& name) {
  return *std::find_if(std::begin(kScenarios), std::end(kScenarios),
                       [&name](const Scenario& s) { return s.name == name; });
}

void runOne(const std::string& name, Options options, Report& report) {
  const std::size_t slash = name.find('/');
  const Scenario& scenario = scenarioOf(name.substr(0, slash));
  if (slash != std::string::npos) options.part = name.substr(slash + 1);
  try {
    const std::size_t before = report.rows().size();
    scenario.run(options, report);
    if (!options.part.empty() && report.rows().size() == before) {
      const std::string parts = ' ' + std::string(scenario.parts) + ' ';
      if (parts.find(' ' + options.part + ' ') == std::string::npos) {
        throw std::invalid_argument("'" + std::string(scenario.name) + "' has no part called '" +
                                    options.part + "'");
      }
      throw Skipped("its data are absent: name their folder by --data or KIOS_DATA");
    }
  } catch (const Skipped& reason) {
    std::printf("skipped: %s: %s\n", name.c_str(), reason.what());
  }
}

// Runs the scenarios with few frames each; all that have rows of FCL's if none is named.
void runFew(std::vector<std::string> wanted, Options options, Report& report) {
  if (wanted.empty()) {
    for (const Scenario& scenario : kScenarios) {
      if (scenario.least_frames > 0) wanted.emplace_back(scenario.name);
    }
  }
  options.oracle_frames = 20;
  for (const std::string& name : wanted) {
    Options few = options;
    if (few.frames == 0) few.frames = scenarioOf(name.substr(0, name.find('/'))).least_frames;
    runOne(name, few, report);
  }
}

// Compares with FCL. Returns how many of our rows are slower than the fastest other's.
int runLeast(const std::vector<std::string>& wanted, const Options& options, Report& report) {
  constexpr std::size_t kShown = 10;
  runFew(wanted, options, report);
  const std::vector<Standing> standings = byRatio(report.rows());
  printLeast(standings, kShown);
  return countSlower(standings);
}

// Compares with the library of an earlier revision. Returns how many of our rows are slower than
// kLeastRatio or answer otherwise.
int runCompared(std::vector<std::string> wanted, Options options, Report& report) {
  constexpr std::size_t kShown = 10;
  if (wanted.empty()) {
    wanted = {"tori", "robots", "world", "scene", "shapes", "build", "motions"};
  }
  if (options.bvs == defaultVolumeNames()) options.bvs = {kOurs, "fcl_obbrss"};
  options.bvs = compared(options.bvs);
  runFew(std::move(wanted), options, report);
  return summarize(report.rows(), kShown);
}

int run(int argc, char** argv) {
  CLI::App app{"Compares kios with FCL's bounding volumes on whole scenarios, against an oracle."};
  app.footer(kColumns);
  std::vector<std::string> names;
  for (const Scenario& scenario : kScenarios) names.emplace_back(scenario.name);
  Options options;
  std::vector<std::string> wanted;
  options.bvs = defaultVolumeNames();
  std::string oracle = std::to_string(options.oracle_frames);
  std::string data;
  std::string json;
  std::string robot;
  std::vector<std::filesystem::path> libraries;
  bool least = false;
  bool list = false;
  bool check_rows = false;
  app.add_option("scenario", wanted,
                 "what to run: names of --list, or NAME/PART; 'tori/generated' if none is named")
      ->check([&names](const std::string& name) {
        return CLI::IsMember(names)(name.substr(0, name.find('/')));
      });
  app.add_option("--data", data, "folder of the benchmark data")->check(CLI::ExistingDirectory);
  app.add_option("--bv", options.bvs, "bounding volumes, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(volumeNames()));
  app.add_option("--frames", options.frames, "frames of each scene, evenly chosen")
      ->check(CLI::Range(1, 1000000000));
  app.add_option("--repeats", options.repeats, "repeats of each measurement")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
  app.add_option("--oracle", oracle, "number of frames judged by the oracle, or 'all'")
      ->check(CLI::Range(1, 1000000000) | CLI::IsMember({"all"}))
      ->capture_default_str();
  app.add_option("--max-triangles", options.max_triangles,
                 "largest meshes of 'tori', 'build' and 'rays', to 1000000")
      ->check(CLI::Range(1, 1000000000))
      ->capture_default_str();
  app.add_option("--robot", robot,
                 "folder of binary STL and OBJ files, by name the links of a robot for 'robots'")
      ->check(CLI::ExistingDirectory);
  app.add_option("--seed", options.seed, "seed of generated poses")->capture_default_str();
  app.add_option("--json", json, "file for one JSON object a row");
  app.add_flag("--quick", options.quick, "few frames and repeats: a smoke test");
  app.add_flag(
      "--least", least,
      "run several scenarios, or all, with few frames, and print where ours is least ahead "
      "of FCL's fastest volume");
  app.add_option("--compare", libraries,
                 "two shared objects, of an earlier revision and of this one (scripts/compare): "
                 "ask both in turn, as --least, and print where this one is least ahead")
      ->expected(2)
      ->check(CLI::ExistingFile);
  app.add_flag("--check", check_rows,
               "exit with 1 if an answer of kios is wrong, with --least or --compare if a row is "
               "slower");
  app.add_flag("--list", list, "list scenarios and bounding volumes");
  CLI11_PARSE(app, argc, argv);

  if (list) {
    printList();
    return 0;
  }
  const bool few = least || !libraries.empty();
  if (app.count("--repeats") == 0 && (few || options.quick)) options.repeats = few ? 3 : 2;
  options.oracle_frames = oracle == "all" ? 0 : std::stoi(oracle);
  if (!data.empty()) options.data = data;
  if (!libraries.empty()) loadLibraries(libraries[0], libraries[1]);
  if (wanted.empty() && !few) wanted = {"tori/generated"};
  if (!robot.empty() && wanted != std::vector<std::string>{"robots"}) {
    throw std::invalid_argument("--robot is an option of the scenario 'robots'");
  }
  if (!robot.empty()) options.robot = robot;
  Report report(json.empty() ? std::nullopt : std::optional<std::filesystem::path>(json),
                options.seed, libraries.empty() ? printTable : printCompared);
  int slower = 0;
  if (!libraries.empty()) {
    slower = runCompared(wanted, options, report);
  } else if (least) {
    slower = runLeast(wanted, options, report);
  } else {
    for (const std::string& name : wanted) runOne(name, options, report);
    if (report.rows().empty()) return 0;
    std::printf("%s", kColumns);
  }
  if (!check_rows) return 0;
  if (slower > 0) std::fprintf(stderr, "kios_bench: %d rows are slower\n", slower);
  return std::max(check(report.rows()), slower > 0 ? 1 : 0);
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
