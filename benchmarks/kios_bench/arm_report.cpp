// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arm_report.h"

#include <algorithm>
#include <vector>

#include "contest.h"

namespace kios::bench {
namespace {

// The whole motion, from which fewer frames are chosen evenly.
constexpr int kMotionFrames = 400;

std::vector<Question> questionsOf(const TwoArms& arms, int frames, std::uint64_t seed) {
  const int all = std::max(frames, kMotionFrames);
  const auto motion_1 = scenes::armMotion(arms.arm, all, 2 * seed);
  const auto motion_2 = scenes::armMotion(arms.arm, all, 2 * seed + 1);
  std::vector<Question> questions;
  for (int i = 0; i < frames; ++i) {
    const int frame = i * all / frames;
    const auto poses_1 = scenes::linkPoses(arms.arm, arms.X_W1, motion_1[frame]);
    const auto poses_2 = scenes::linkPoses(arms.arm, arms.X_W2, motion_2[frame]);
    for (std::size_t i = 0; i < poses_1.size(); ++i) {
      for (std::size_t j = 0; j < poses_2.size(); ++j) {
        Question question;
        question.a = i;
        question.b = j;
        question.poses = {poses_1[i], poses_2[j]};
        questions.push_back(question);
      }
    }
  }
  return questions;
}

}  // namespace

void reportArms(const std::string& scenario, const TwoArms& arms, int frames,
                const Options& options, Report& report) {
  constexpr int kQuickFrames = 2;
  if (options.frames > 0) {
    frames = options.frames;
  } else if (options.quick) {
    frames = kQuickFrames;
  }
  std::vector<scenes::Mesh> meshes;
  for (const scenes::Link& link : arms.arm.links) meshes.push_back(link.mesh);
  Contest contest(meshes, options);
  Task task;
  task.scenario = scenario;
  task.questions = questionsOf(arms, frames, options.seed);
  task.frames = frames;
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    task.query = query;
    append(contest.queryRows(task), rows);
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

}  // namespace kios::bench
