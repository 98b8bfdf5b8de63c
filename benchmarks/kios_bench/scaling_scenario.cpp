// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <string>
#include <utility>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

struct Gap {
  const char* name;
  double distance;  // of tori with radii 1 and 0.4; 0 = a shallow contact
};

constexpr Gap kGaps[] = {{"gap_0.1", 0.1}, {"gap_1e-3", 1e-3}, {"touching", 0}};
constexpr double kApart = 4;  // clears both tori at any orientation

}  // namespace

void runScaling(const Options& options, Report& report) {
  const std::vector<int> sizes =
      options.quick ? std::vector<int>{1000} : std::vector<int>{1000, 5000, 20000, 80000};
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 4 : 32);
  for (const int size : sizes) {
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    const std::string scenario = "scaling/" + std::to_string(size);
    Contest contest({torus, torus}, options);
    std::vector<Row> rows;
    for (const Gap& gap : kGaps) {
      const auto motion = scenes::gapMotion(
          frames, gap.distance, kApart, options.seed, [&](const scenes::Frame& frame) {
            return contest.oracle().distance(frame.X_WA, frame.X_WB);
          });
      for (const Query query : {Query::kDistance, Query::kCollide}) {
        append(contest.queryRows(pairTask(scenario + "/" + gap.name, query, motion)), rows);
      }
    }
    append(contest.buildRows(scenario), rows);
    report.add(rows);
  }
}

}  // namespace kios::bench
