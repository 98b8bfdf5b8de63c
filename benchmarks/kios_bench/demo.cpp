// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What scripts/demo runs: three scenes of real work on one screen and a page. It links no more of
// kios_bench than they need, so that a newcomer waits less.
#include <cstdio>
#include <exception>
#include <string>

#include "contest.h"
#include "library.h"
#include "mesh_set_of.h"
#include "scenes/cad_parts.h"
#include "scenes/placement.h"
#include "scenes/worlds.h"
#include "summary.h"

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

int run(const std::string& page) {
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
  for (const std::string& sentence : inWords(rows)) std::printf("%s.\n", sentence.c_str());
  writePage(rows, page);
  for (const Row& row : rows) {
    if (row.bv == kOurs && row.errors.wrong.value_or(0) > 0) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace kios::bench

int main(int argc, char** argv) {
  try {
    if (argc == 2) return kios::bench::run(argv[1]);
    std::fprintf(stderr, "usage: kios_demo PAGE.html\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kios_demo: %s\n", error.what());
  }
  return 2;
}
