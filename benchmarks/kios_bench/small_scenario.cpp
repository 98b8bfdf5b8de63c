// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstddef>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/shapes.h"
#include "scenes/worlds.h"

namespace kios::bench {
namespace {

struct Named {
  const char* name;
  scenes::Mesh mesh;
};

std::vector<Named> places() {
  scenes::Mesh quad;
  quad.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {{"quad", quad}, {"box", scenes::subdividedBox({1.2, 0.8, 0.5}, 1)}};
}

std::vector<Named> bodies() {
  return {{"quad", scenes::sheet(0.5, 0.4, 1, 1, 0)},
          {"box", scenes::subdividedBox({0.3, 0.2, 0.15}, 1)},
          {"ball", scenes::uvSphere(0.2, 4, 5)},
          {"ring", scenes::bumpyTorus(500)}};
}

// Which of posesNear()'s gaps, in turn, belong together.
struct Gaps {
  const char* name;
  std::vector<std::size_t> in_turn;
};
const Gaps kGaps[] = {{"touching", {0, 2}}, {"near", {1, 3}}, {"off", {4, 5, 6}}};

}  // namespace

void runSmall(const Options& options, Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 28 : 700);
  for (const Named& place : places()) {
    for (const Named& body : bodies()) {
      scenes::World world;
      world.name = place.name;
      world.mesh = place.mesh;
      const auto poses = scenes::posesNear(world, body.mesh, count, options.seed);
      Contest contest({place.mesh, body.mesh}, options);
      std::vector<Row> rows;
      for (const Gaps& gaps : kGaps) {
        std::vector<scenes::Frame> frames;
        for (std::size_t i = 0; i < poses.size(); ++i) {
          for (const std::size_t turn : gaps.in_turn) {
            if (i % scenes::kGapsOfPoses != turn) continue;
            frames.push_back({fcl::Transform3d::Identity(), poses[i]});
          }
        }
        const std::string scenario =
            std::string("small/") + place.name + "/" + body.name + "/" + gaps.name;
        for (const Query query : {Query::kDistance, Query::kCollide}) {
          append(contest.queryRows(pairTask(scenario, query, frames)), rows);
        }
      }
      report.add(rows);
    }
  }
}

}  // namespace kios::bench
