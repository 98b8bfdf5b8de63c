// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdio>

#include "scenario.h"
#include "scene_contest.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

constexpr double kMargin = 0.1;

SceneEntrant entrant(std::unique_ptr<SceneCompetitor> competitor, int stride = 1) {
  return {std::move(competitor), stride};
}

void reportQueries(const std::string& scenario, SceneContest& contest,
                   const std::vector<SceneQuery>& queries, Report& report) {
  for (const SceneQuery query : queries) {
    const char* const kind = query == SceneQuery::kClosest    ? "closest"
                             : query == SceneQuery::kWithin   ? "within"
                             : query == SceneQuery::kVerdicts ? "verdicts"
                                                              : "clearances";
    report.add(contest.rows({scenario + "/" + kind, query, kMargin}));
  }
}

void reportRobots(const std::string& scenario, const scenes::Robot& robot,
                  const fcl::Transform3d& X_W2, int frames, int stride, const Options& options,
                  Report& report) {
  if (options.frames > 0) frames = options.frames;
  if (options.quick) frames = 3;
  for (const bool smooth : {true, false}) {
    const scenes::BodyScene scene =
        scenes::twoRobots(robot, fcl::Transform3d::Identity(), X_W2, frames, smooth, options.seed);
    std::vector<SceneEntrant> entrants;
    entrants.push_back(entrant(makeKiosPairs(false), stride));
    entrants.push_back(entrant(makeKiosScene()));
    entrants.push_back(entrant(makeFclPairs(), stride));
    entrants.push_back(entrant(makeFclBoundedPairs(), stride));
    entrants.push_back(entrant(makeFclManager(), stride));
    SceneContest contest(scene, std::move(entrants), options);
    reportQueries(
        scenario + (smooth ? "/smooth" : "/random"), contest,
        {SceneQuery::kClosest, SceneQuery::kWithin, SceneQuery::kVerdicts, SceneQuery::kClearances},
        report);
  }
}

}  // namespace

void runRobotScenes(const Options& options, Report& report) {
  constexpr int kFrames = 60;
  fcl::Transform3d X_facing = fcl::Transform3d::Identity();
  X_facing.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();
  X_facing.translation().x() = 0.7;
  reportRobots("robots/generated", scenes::robotOf(scenes::cadArm()), X_facing, kFrames, 6, options,
               report);
  X_facing.translation().x() = 0.8;
  reportRobots("robots/humanoids", scenes::humanoid(), X_facing, kFrames, 20, options, report);

  const auto data = findData(options);
  if (!data || !scenes::holdsUr5(*data)) {
    std::printf("robots/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
    return;
  }
  fcl::Transform3d X_beside = fcl::Transform3d::Identity();
  X_beside.translation().y() = 0.5;
  reportRobots("robots/ur5", scenes::robotOf(scenes::loadUr5(*data)), X_beside, kFrames, 6, options,
               report);
}

void runScene(const Options& options, Report& report) {
  const int bodies = options.quick ? 300 : 5000;
  const auto framesOr = [&options](int frames) {
    if (options.frames > 0) return options.frames;
    return options.quick ? 3 : frames;
  };
  const std::vector<SceneQuery> queries = {SceneQuery::kClosest, SceneQuery::kWithin};
  {
    const int frames = framesOr(40);
    const scenes::BodyScene crowd = scenes::driftingCrowd(bodies, frames, options.seed);
    std::vector<SceneEntrant> entrants;
    entrants.push_back(entrant(makeKiosPairs(true), frames));
    entrants.push_back(entrant(makeKiosScene()));
    entrants.push_back(entrant(makeFclBoundedPairs(), frames));
    entrants.push_back(entrant(makeFclManager()));
    SceneContest contest(crowd, std::move(entrants), options);
    reportQueries("scene/crowd", contest, queries, report);
  }
  {
    const auto data = findData(options);
    const bool ur5 = data && scenes::holdsUr5(*data);
    const scenes::BodyScene map =
        scenes::roadmap(scenes::robotOf(ur5 ? scenes::loadUr5(*data) : scenes::cadArm()), bodies,
                        framesOr(1000), options.seed);
    std::vector<SceneEntrant> entrants;
    entrants.push_back(entrant(makeKiosPairs(true), 50));
    entrants.push_back(entrant(makeKiosScene()));
    entrants.push_back(entrant(makeFclBoundedPairs(), 50));
    entrants.push_back(entrant(makeFclManager()));
    SceneContest contest(map, std::move(entrants), options);
    reportQueries(ur5 ? "scene/roadmap" : "scene/roadmap_generated", contest, queries, report);
  }
}

}  // namespace kios::bench
