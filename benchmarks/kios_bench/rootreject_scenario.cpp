// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

// Distances of the meshes' origins, as multiples of the sum of their radii about it.
struct Range {
  const char* name;
  double nearest;
  double farthest;
};

constexpr Range kRanges[] = {{"beside", 1.2, 1.5}, {"far", 3, 10}};

double radius(const scenes::Mesh& mesh) {
  double squared = 0;
  for (const fcl::Vector3d& p : mesh.vertices) squared = std::max(squared, p.squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

void runRootReject(const Options& options, Report& report) {
  const scenes::Mesh a = scenes::bentTorus();
  const scenes::Mesh b = scenes::knobbyTorus();
  const double radii = radius(a) + radius(b);
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 40 : 4000);
  Contest contest({a, b}, options);
  std::vector<Row> rows;
  for (const Range& range : kRanges) {
    const auto motion =
        scenes::farMotion(frames, range.nearest * radii, range.farthest * radii, options.seed);
    const std::string scenario = std::string("rootreject/") + range.name;
    append(contest.queryRows(pairTask(scenario, Query::kCollide, motion)), rows);
    // Half the least distance of the spheres about the meshes.
    Task bounded = pairTask(scenario, Query::kThreshold, motion);
    bounded.threshold = 0.5 * (range.nearest - 1) * radii;
    for (Question& question : bounded.questions) question.threshold = *bounded.threshold;
    append(contest.queryRows(bounded), rows);
  }
  report.add(rows);
}

}  // namespace kios::bench
