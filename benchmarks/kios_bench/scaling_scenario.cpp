// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <string>
#include <vector>

#include "contest.h"
#include "pose_finder.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"
#include "scenes/unlike.h"

namespace kios::bench {
namespace {

struct Gap {
  const char* name;
  double distance;  // of tori with radii 1 and 0.4; 0 = a shallow contact
};

constexpr Gap kGaps[] = {{"gap_0.1", 0.1}, {"gap_1e-3", 1e-3}, {"touching", 0}};
constexpr double kApart = 4;  // clears both tori at any orientation

std::vector<int> sizes(const Options& options) {
  std::vector<int> kept;
  for (const int size : {1000, 5000, 20000, 80000, 320000, 1000000}) {
    if (size > (options.quick ? 1000 : options.max_triangles)) break;
    kept.push_back(size);
  }
  return kept;
}

// The oracle transforms every triangle at each frame: 2 s at 1M.
int oracleFrames(const Options& options, int size) {
  constexpr int kTriangleFrames = 1000000;
  const int affordable = std::max(2, kTriangleFrames / size);
  return options.oracle_frames == 0 ? 0 : std::min(options.oracle_frames, affordable);
}

}  // namespace

void runScaling(const Options& options, Report& report) {
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 4 : 32);
  for (const int size : sizes(options)) {
    const scenes::Mesh torus = scenes::bumpyTorus(size);
    const std::string scenario = "scaling/" + std::to_string(size);
    Options affordable = options;
    affordable.oracle_frames = oracleFrames(options, size);
    Contest contest({torus, scenes::unlike(torus)}, affordable);  // they share nothing
    PoseFinder distance(torus);
    std::vector<Row> rows;
    Question in_contact;
    for (const Gap& gap : kGaps) {
      const auto motion = scenes::gapMotion(frames, gap.distance, kApart, options.seed,
                                            [&](const auto& frame) { return distance(frame); });
      for (const Query query : {Query::kDistance, Query::kCollide}) {
        append(contest.queryRows(pairTask(scenario + "/" + gap.name, query, motion)), rows);
      }
      in_contact.poses = motion.back();  // of the last gap
    }
    append(contest.buildRows(scenario), rows);
    // In contact: no bounding volume at the roots decides.
    append(contest.prepareRows(scenario, in_contact), rows);
    report.add(rows);
  }
}

}  // namespace kios::bench
