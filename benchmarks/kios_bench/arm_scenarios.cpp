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
#include "robot_classes.h"
#include "scenario.h"
#include "scenes/arms.h"
#include "scenes/cad_parts.h"
#include "scenes/mesh_folder.h"
#include "scenes/ur5_data.h"

namespace kios::bench {
namespace {

// The whole motion, from which fewer frames are chosen evenly.
constexpr int kMotionFrames = 400;

/// The first arm's base is the world.
std::vector<Question> questionsOf(const scenes::Arm& arm, const fcl::Transform3d& X_W2, int frames,
                                  std::uint64_t seed) {
  const int all = std::max(frames, kMotionFrames);
  const auto motion_1 = scenes::armMotion(arm, all, 2 * seed);
  const auto motion_2 = scenes::armMotion(arm, all, 2 * seed + 1);
  std::vector<Question> questions;
  for (int i = 0; i < frames; ++i) {
    const int frame = i * all / frames;
    const auto poses_1 = scenes::linkPoses(arm, fcl::Transform3d::Identity(), motion_1[frame]);
    const auto poses_2 = scenes::linkPoses(arm, X_W2, motion_2[frame]);
    for (std::size_t a = 0; a < poses_1.size(); ++a) {
      for (std::size_t b = 0; b < poses_2.size(); ++b) {
        questions.push_back({a, b, {poses_1[a], poses_2[b]}});
      }
    }
  }
  return questions;
}

/// Says what rows there are beside those of whole frames: of frames before which the processor did
/// something else, and of the pairs of each class, a pair a frame.
void addDetails(const Task& whole, const std::vector<scenes::Mesh>& meshes, Contest& contest,
                std::vector<Row>& rows) {
  Task task = whole;
  task.cold = true;
  task.scenario = whole.scenario + "/cold";
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    task.query = query;
    append(contest.queryRows(task), rows);
  }
  task.cold = false;
  const auto classes = byClass(meshes, whole.questions);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    task.scenario = whole.scenario + "/" + name(static_cast<PairClass>(i));
    task.questions = classes[i];
    task.frames = classes[i].size();
    task.query = Query::kCollide;
    append(contest.queryRows(task), rows);
  }
}

/// Reports distance, collide and build rows: times and tests are sums over the pairs of a frame,
/// `total_pairs` counts the queries of all frames. `frames` if the options name none.
void reportArms(const std::string& scenario, const scenes::Arm& arm, const fcl::Transform3d& X_W2,
                int frames, const Options& options, Report& report, bool details = false) {
  if (options.frames > 0) {
    frames = options.frames;
  } else if (options.quick) {
    frames = 2;
  }
  std::vector<scenes::Mesh> meshes;
  for (const scenes::Link& link : arm.links) meshes.push_back(link.mesh);
  Contest contest(meshes, options);
  Task task;
  task.scenario = scenario;
  task.questions = questionsOf(arm, X_W2, frames, options.seed);
  task.frames = frames;
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    task.query = query;
    append(contest.queryRows(task), rows);
  }
  if (details) addDetails(task, meshes, contest, rows);
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

/// Returns the second of two robots of one kind that face each other.
fcl::Transform3d facing(double distance) {
  fcl::Transform3d X_W2 = fcl::Transform3d::Identity();
  X_W2.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();
  X_W2.translation().x() = distance;
  return X_W2;
}

}  // namespace

void runRobots(const Options& options, Report& report) {
  constexpr int kFrames = 100;      // FCL's OBBRSS takes 17 ms for one
  constexpr int kStripFrames = 40;  // FCL's k-IOS takes 0.3 s for one, its OBBRSS 3 ms
  if (options.robot) {
    const scenes::Arm chain = scenes::chainOf(scenes::loadMeshes(*options.robot));
    reportArms("robots/" + options.robot->lexically_normal().filename().string(), chain,
               facing(0.45 * scenes::chainLength(chain)), kFrames, options, report, true);
    return;
  }
  if (wanted(options, "generated")) {
    reportArms("robots/generated", scenes::cadArm(), facing(0.7), kFrames, options, report, true);
  }
  if (wanted(options, "parts")) {
    const scenes::Arm parts = scenes::chainOf(scenes::cadParts());
    reportArms("robots/parts", parts, facing(0.45 * scenes::chainLength(parts)), kFrames, options,
               report, true);
  }
  if (wanted(options, "strips")) {
    // The second chain points back at the first, askew: none of their cylinders stay parallel.
    fcl::Transform3d X_W2 = fcl::Transform3d::Identity();
    X_W2 =
        fcl::AngleAxisd(3.3, fcl::Vector3d::UnitZ()) * fcl::AngleAxisd(0.5, fcl::Vector3d::UnitX());
    X_W2.translation() = fcl::Vector3d(1.8, 0.4, 0.1);
    reportArms("strips", scenes::stripChain(), X_W2, kStripFrames, options, report);
  }
  if (wanted(options, "ur5")) {
    const auto data = findData(options);
    if (data && scenes::holdsUr5(*data)) {
      const fcl::Transform3d X_W2(Eigen::Translation3d(0, 0.5, 0));
      reportArms("robots/ur5", scenes::loadUr5(*data), X_W2, kFrames, options, report, true);
    } else {
      std::printf("robots/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
    }
  }
  if (wanted(options, "scenes")) reportRobotScenes(options, report);
}

}  // namespace kios::bench
