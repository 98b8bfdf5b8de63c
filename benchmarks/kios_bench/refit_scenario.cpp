// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
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

struct Way {
  const char* name;
  Refit how;
};

constexpr Way kWays[] = {
    {"rebuild", Refit::kRebuild}, {"top_down", Refit::kTopDown}, {"bottom_up", Refit::kBottomUp}};

constexpr double kSway = 0.1;   // of the torus's extent
constexpr double kApart = 4.5;  // clears both tori at any orientation

scenes::Mesh swayed(scenes::Mesh mesh) {
  const double amplitude = kSway * scenes::extent(mesh) / std::sqrt(3.0);
  for (fcl::Vector3d& p : mesh.vertices) {
    p += amplitude * fcl::Vector3d(std::sin(2 * p[1]), std::cos(3 * p[2]), std::sin(2 * p[0] + 1));
  }
  return mesh;
}

}  // namespace

void runRefit(const Options& options, Report& report) {
  const int frames = options.frames > 0 ? options.frames : (options.quick ? 4 : 8);
  // FCL's OBBRSS takes a second a query after its bottom-up refit of 20k triangles.
  for (const int size : {1000, 5000, 20000}) {
    if (size > (options.quick ? 1000 : options.max_triangles)) break;
    const scenes::Mesh before = scenes::bumpyTorus(size), after = swayed(before);
    const std::string scenario = "refit/" + std::to_string(size);
    Contest contest({after, scenes::unlike(after)}, options);  // they share nothing
    PoseFinder distance(after);
    const auto at = [&](const auto& frame) { return distance(frame); };
    const auto near = scenes::gapMotion(frames, 0.05, kApart, options.seed, at);
    const auto touching = scenes::gapMotion(frames, 0, kApart, options.seed + 1, at);
    Question first;
    first.poses = touching[0];  // no bounding volume at the roots decides
    std::vector<Row> rows = contest.prepareRows(scenario + "/built", first);
    const auto ask = [&](const std::string& name) {
      append(contest.queryRows(pairTask(name, Query::kDistance, near)), rows);
      append(contest.queryRows(pairTask(name, Query::kCollide, touching)), rows);
    };
    ask(scenario + "/built");
    for (const Way& way : kWays) {
      const std::string name = scenario + "/" + way.name;
      append(contest.refitRows(name, {before, scenes::unlike(before)}, way.how, first), rows);
      ask(name);
    }
    report.add(rows);
  }
}

}  // namespace kios::bench
