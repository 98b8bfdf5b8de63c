// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What scripts/demo runs: three scenes of real work on one screen. It links no more of kios_bench
// than they need, so that a newcomer waits less.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "contest.h"
#include "least.h"
#include "library.h"
#include "mesh_set_of.h"
#include "scenes/cad_parts.h"
#include "scenes/placement.h"
#include "scenes/worlds.h"

// Our library makes meshes alone here.
extern "C" const kios::bench::Library kios_bench_library = {
    []() -> std::unique_ptr<kios::bench::MeshSet> {
      return std::make_unique<kios::bench::KiosSet>(nullptr);
    },
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr};

namespace kios::bench {
namespace {

const std::vector<std::string> kVolumes = {"kios", "fcl_obbrss", "fcl_rss", "fcl_kios_builtin"};

struct Scene {
  std::string name;
  std::vector<scenes::Mesh> meshes;
  std::vector<Question> questions;
  std::size_t frames;
};

Scene twoTori() {
  constexpr int kFrames = 40;
  const scenes::MovingPair pair = generatedFalling();
  const auto frames = evenlyChosen(pair.frames, kFrames);
  return {"two tori", {pair.a, pair.b}, pairTask("", Query::kDistance, frames).questions, kFrames};
}

/// Two arms that face each other, every pair of their links.
Scene twoArms() {
  constexpr int kFrames = 4;
  const scenes::Robot arm = scenes::cadArm();
  Scene scene{"two arms", {}, robotQuestions(arm, scenes::facing(0.7), kFrames, 1), kFrames};
  for (const scenes::Link& link : arm.links) scene.meshes.push_back(link.mesh);
  return scene;
}

/// Parts of machines touching a shelf of boxes, near it and off.
Scene shelf() {
  constexpr int kPoses = 21;
  Scene scene{"parts, shelf", scenes::cadParts(), {}, kPoses};
  const std::size_t parts = scene.meshes.size();
  for (const scenes::World& world : scenes::boxWorlds()) {
    if (world.name != "shelf") continue;
    for (std::size_t part = 0; part < parts; ++part) {
      const auto poses = scenes::posesNear(world, scene.meshes[part], kPoses, part);
      for (std::size_t i = part; i < poses.size(); i += parts) {
        scene.questions.push_back({part, parts, {poses[i], fcl::Transform3d::Identity()}});
      }
    }
    scene.meshes.push_back(world.mesh);
  }
  return scene;
}

void printLine(const std::string& what, const std::vector<Row>& rows) {
  std::printf("%-26s", what.c_str());
  for (const std::string& bv : kVolumes) {
    std::string time = "-";
    for (const Row& row : rows) {
      if (row.bv == bv) time = timeText(row.times.median_us);
    }
    std::printf(" %11s", time.c_str());
  }
  for (const Row& row : rows) {
    if (row.bv == kOurs) std::printf(" %9.1f", row.times.ratio_to_fcl_obbrss.value_or(0));
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// Says how many times as fast ours is as FCL's fastest volume: in the geometric mean and at least.
void printSpeed(const std::vector<Row>& rows, const std::string& query, const char* what) {
  std::vector<Standing> standings = byRatio(rows);
  standings.erase(std::remove_if(standings.begin(), standings.end(),
                                 [&](const Standing& s) { return s.ours.query != query; }),
                  standings.end());
  double logarithms = 0;
  for (const Standing& standing : standings) logarithms += std::log(standing.ratio);
  std::printf(
      "%s: %.1f times as fast as FCL's fastest volume in the mean of %zu scenes, %.1f at least "
      "(%s).\n",
      what, std::exp(logarithms / static_cast<double>(standings.size())), standings.size(),
      standings.at(0).ratio, standings.at(0).ours.scenario.c_str());
}

/// Says how the rows fell that the oracle judged. Returns how many verdicts are wrong.
std::size_t printErrors(const std::vector<Row>& rows) {
  std::size_t judged = 0, wrong = 0;
  double error = 0;
  for (const Row& row : rows) {
    if (row.bv != kOurs || !row.errors.wrong) continue;
    ++judged;
    wrong += *row.errors.wrong;
    error = std::max(error, row.errors.max_abs.value_or(0) / row.extent);
  }
  std::printf(
      "Answers: %zu wrong in %zu rows that an oracle judged; largest error of a distance %.1e of "
      "the mesh's size.\n",
      wrong, judged, error);
  return wrong;
}

void printBuilds(const std::vector<Row>& rows) {
  const auto mean = [&rows](const std::string& bv, Maybe Volumes::*value) {
    double sum = 0;
    int count = 0;
    for (const Row& row : rows) {
      if (row.query != "build" || row.bv != bv) continue;
      sum += (row.volumes.*value).value_or(0);
      ++count;
    }
    return sum / count;
  };
  constexpr auto kBytes = &Volumes::bytes_per_triangle, kUs = &Volumes::build_us_per_triangle;
  std::printf("Memory: %.0f bytes a triangle, OBBRSS %.0f.\n", mean(kOurs, kBytes),
              mean("fcl_obbrss", kBytes));
  std::printf("Building: %.2f us a triangle, OBBRSS %.2f.\n", mean(kOurs, kUs),
              mean("fcl_obbrss", kUs));
}

int run() {
  Options options;
  options.bvs = kVolumes;
  options.repeats = 3;
  options.oracle_frames = 20;
  std::printf("%-26s %11s %11s %11s %11s %9s\n", "time of a frame", "k-IOS", "OBBRSS", "RSS",
              "FCL's k-IOS", "x OBBRSS");
  std::vector<Row> rows;
  for (const Scene& scene : {twoTori(), twoArms(), shelf()}) {
    Contest contest(scene.meshes, options);
    Task task;
    task.scenario = scene.name;
    task.questions = scene.questions;
    task.frames = scene.frames;
    for (const Query query : {Query::kDistance, Query::kCollide}) {
      task.query = query;
      const std::vector<Row> asked = contest.queryRows(task);
      printLine(scene.name + (query == Query::kDistance ? ", distance" : ", first contact"), asked);
      append(asked, rows);
    }
    const std::vector<Row> built = contest.buildRows(scene.name);
    printLine(scene.name + ", building", built);
    append(built, rows);
  }
  std::printf("\n");
  printSpeed(rows, "distance", "Exact distance");
  printSpeed(rows, "collide", "First contact");
  printBuilds(rows);
  return printErrors(rows) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace kios::bench

int main() {
  try {
    return kios::bench::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_demo: %s\n", error.what());
    return 2;
  }
}
