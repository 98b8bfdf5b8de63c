// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_report.h"

#include "contest.h"

namespace kios::bench {

std::vector<scenes::Frame> chosenFrames(const std::vector<scenes::Frame>& frames,
                                        const Options& options) {
  constexpr int kQuickFrames = 40;
  return evenlyChosen(frames, options.frames == 0 && options.quick ? kQuickFrames : options.frames);
}

void reportMotion(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                  const std::vector<scenes::Frame>& frames, const Options& options,
                  Report& report) {
  const std::vector<scenes::Frame> chosen = chosenFrames(frames, options);
  Contest contest({a, b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    append(contest.queryRows(pairTask(scenario, query, chosen)), rows);
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

void reportShuffled(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                    const std::vector<scenes::Frame>& frames, const Options& options,
                    Report& report) {
  const auto chosen = scenes::shuffled(chosenFrames(frames, options), options.seed);
  Contest contest({a, b}, options);
  report.add(contest.queryRows(pairTask(scenario, Query::kDistance, chosen)));
}

}  // namespace kios::bench
