// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_report.h"

#include <utility>

#include "contest.h"

namespace kios::bench {

void reportMotion(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                  const std::vector<scenes::Frame>& frames, const Options& options,
                  Report& report) {
  constexpr int kQuickFrames = 40;
  const int wanted = options.frames == 0 && options.quick ? kQuickFrames : options.frames;
  const std::vector<scenes::Frame> chosen = evenlyChosen(frames, wanted);
  Contest contest({a, b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    append(contest.queryRows(pairTask(scenario, query, chosen)), rows);
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

}  // namespace kios::bench
