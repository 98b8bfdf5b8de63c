// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two moving arms of one kind: every pair of a link of the first and a link of the second at each
// frame, none skipped.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/arms.h"
#include "scenes/cad_parts.h"
#include "scenes/mesh_folder.h"
#include "scenes/placement.h"

namespace kios::bench {
namespace {

/// Reports distance, collide and build rows: times and tests are sums over the pairs of a frame,
/// `total_pairs` counts the queries of all frames.
void reportArms(const std::string& scenario, const scenes::Robot& arm, const fcl::Transform3d& X_W2,
                const Options& options, Report& report) {
  constexpr int kFrames = 100;  // FCL's OBBRSS takes 17 ms for one
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 2 : kFrames);
  std::vector<scenes::Mesh> meshes;
  for (const scenes::Link& link : arm.links) meshes.push_back(link.mesh);
  Contest contest(meshes, options);
  Task task;
  task.scenario = scenario;
  task.questions = robotQuestions(arm, X_W2, frames, options.seed);
  task.frames = frames;
  std::vector<Row> rows;
  for (const bool cold : {false, true}) {
    if (cold) task.scenario += "/cold";  // the processor does something else before each frame
    task.cold = cold;
    for (const Query query : {Query::kDistance, Query::kCollide}) {
      task.query = query;
      append(contest.queryRows(task), rows);
    }
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

}  // namespace

void runRobots(const Options& options, Report& report) {
  if (options.robot) {
    const scenes::Robot chain = scenes::chainOf(scenes::loadMeshes(*options.robot));
    reportArms("robots/" + options.robot->lexically_normal().filename().string(), chain,
               scenes::facing(0.45 * scenes::chainLength(chain)), options, report);
    return;
  }
  if (wanted(options, "generated")) {
    reportArms("robots/generated", scenes::cadArm(), scenes::facing(0.7), options, report);
  }
  if (wanted(options, "parts")) {
    const scenes::Robot parts = scenes::chainOf(scenes::cadParts());
    reportArms("robots/parts", parts, scenes::facing(0.45 * scenes::chainLength(parts)), options,
               report);
  }
  if (wanted(options, "ur5")) {
    if (const auto ur5 = findUr5(options)) {
      reportArms("robots/ur5", *ur5, scenes::shift(0, 0.5, 0), options, report);
    } else {
      std::printf("robots/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
    }
  }
  if (wanted(options, "scenes")) reportRobotScenes(options, report);
}

}  // namespace kios::bench
