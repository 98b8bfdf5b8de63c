// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "contest.h"
#include "scenario.h"

namespace kios::bench {
namespace {

constexpr double kThresholds[] = {0.01, 0.05, 0.2};     // far below the size of the tori
constexpr double kDistanceFactors[] = {0.5, 0.9, 1.1};  // of each frame's exact distance
constexpr int kFactorFrames = 600;

std::string text(double value) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%g", value);
  return digits;
}

// Thresholds that are a factor of the distance, at frames without contact.
std::vector<Task> factorTasks(const std::string& scenario, const std::vector<scenes::Frame>& frames,
                              Contest& contest) {
  std::vector<scenes::Frame> apart;
  std::vector<double> distances;
  for (const scenes::Frame& frame : evenlyChosen(frames, kFactorFrames)) {
    const double distance = contest.oracle().distance(frame.X_WA, frame.X_WB);
    if (distance == 0) continue;
    apart.push_back(frame);
    distances.push_back(distance);
  }
  std::vector<Task> tasks;
  for (const double factor : kDistanceFactors) {
    tasks.push_back(pairTask(scenario + "/" + text(factor) + "d", Query::kThreshold, apart));
    tasks.back().threshold = factor;
    for (std::size_t i = 0; i < apart.size(); ++i) {
      tasks.back().questions[i].threshold = factor * distances[i];
    }
  }
  return tasks;
}

void reportThresholds(const std::string& scenario, const scenes::MovingPair& pair,
                      const Options& options, Report& report) {
  const std::vector<scenes::Frame> frames = chosenFrames(pair.frames, options);
  Contest contest({pair.a, pair.b}, options);
  std::vector<Task> tasks;
  for (const double threshold : kThresholds) {
    tasks.push_back(pairTask(scenario + "/" + text(threshold), Query::kThreshold, frames));
    tasks.back().threshold = threshold;
    for (Question& question : tasks.back().questions) question.threshold = threshold;
  }
  for (Task& task : factorTasks(scenario, frames, contest)) tasks.push_back(std::move(task));
  std::vector<Row> rows;
  for (const Task& task : tasks) append(contest.queryRows(task), rows);
  report.add(rows);
}

}  // namespace

void runThreshold(const Options& options, Report& report) {
  reportThresholds("threshold/generated", generatedFalling(), options, report);
  if (const auto data = findData(options)) {
    reportThresholds("threshold/falling", scenes::loadFalling(*data), options, report);
  } else {
    std::printf(
        "threshold/falling is left out: name the folder of its data by --data or KIOS_DATA\n");
  }
}

}  // namespace kios::bench
