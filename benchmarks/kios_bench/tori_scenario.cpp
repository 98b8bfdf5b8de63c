// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes along a motion, and two tori of each size at a gap.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/pqp_data.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"

namespace kios::bench {
namespace {

/// Reports distance, collide and build rows of two meshes along the chosen frames of a motion.
void reportMotion(const std::string& scenario, const scenes::MovingPair& pair,
                  const Options& options, Report& report) {
  const std::vector<scenes::Frame> chosen = chosenFrames(pair.frames, options);
  Contest contest({pair.a, pair.b}, options);
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide}) {
    append(contest.queryRows(pairTask(scenario, query, chosen)), rows);
  }
  append(contest.buildRows(scenario), rows);
  report.add(rows);
}

struct Gap {
  const char* name;
  double distance;  // of tori with radii 1 and 0.4; 0 = a shallow contact
};

constexpr Gap kGaps[] = {{"gap_0.1", 0.1}, {"gap_1e-3", 1e-3}, {"touching", 0}};
constexpr double kApart = 4;  // clears both tori at any orientation

void reportScaling(const Options& options, Report& report) {
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 4 : 32);
  for (const int size : allowed(options, {1000, 5000, 20000, 80000, 320000, 1000000})) {
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    const std::string scenario = "scaling/" + std::to_string(size);
    Options affordable = options;
    // The oracle transforms every triangle at each frame.
    affordable.oracle_frames = std::min(options.oracle_frames, 1000000 / size);
    Contest contest({torus, scenes::unlike(torus)}, affordable);  // they share nothing
    const auto distance = obbrssDistance(torus);
    std::vector<Row> rows;
    for (const Gap& gap : kGaps) {
      const auto motion = scenes::gapMotion(frames, gap.distance, kApart, options.seed, distance);
      for (const Query query : {Query::kDistance, Query::kCollide}) {
        append(contest.queryRows(pairTask(scenario + "/" + gap.name, query, motion)), rows);
      }
    }
    report.add(rows);
  }
}

}  // namespace

void runTori(const Options& options, Report& report) {
  constexpr int kSpinningFrames = 5000;
  if (const auto data = findData(options)) {
    if (wanted(options, "falling")) {
      reportMotion("falling", scenes::loadFalling(*data), options, report);
    }
    if (wanted(options, "spinning")) {
      reportMotion("spinning", scenes::loadSpinning(*data, kSpinningFrames), options, report);
    }
  } else {
    std::printf(
        "falling and spinning are left out: name the folder of their data by --data or "
        "KIOS_DATA\n");
  }
  if (wanted(options, "generated")) {
    reportMotion("generated/falling", generatedFalling(), options, report);
    reportMotion("generated/spinning", generatedSpinning(), options, report);
  }
  if (wanted(options, "scaling")) reportScaling(options, report);
}

}  // namespace kios::bench
