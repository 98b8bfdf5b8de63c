// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/random.h"
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

/// The body stands on the place, in worlds turned at random: they touch but for rounding, also that
/// of the poses, so that no verdict is wrong.
std::vector<scenes::Frame> standing(const scenes::Mesh& place, const scenes::Mesh& body, int count,
                                    std::uint64_t seed) {
  const auto height = [](const scenes::Mesh& mesh, double side) {
    double most = -std::numeric_limits<double>::infinity();
    for (const fcl::Vector3d& v : mesh.vertices) most = std::max(most, side * v.z());
    return side * most;
  };
  scenes::Random random(seed);
  std::vector<scenes::Frame> frames;
  for (const fcl::Transform3d& X_WA : scenes::randomPoses(count, 1, seed)) {
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    X_AB.translation() = fcl::Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.2, 0.2),
                                       height(place, 1) - height(body, -1));
    X_AB.rotate(Eigen::AngleAxisd(random.uniform(0, 6.28), fcl::Vector3d::UnitZ()));
    frames.push_back({X_WA, X_WA * X_AB});
  }
  return frames;
}

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
      const std::string pair = std::string("small/") + place.name + "/" + body.name + "/";
      const auto ask = [&](const std::string& state, const std::vector<scenes::Frame>& frames,
                           bool judged) {
        for (const Query query : {Query::kDistance, Query::kCollide}) {
          std::vector<Row> asked = contest.queryRows(pairTask(pair + state, query, frames));
          for (Row& row : asked) {
            if (!judged) row.errors.wrong.reset();
          }
          append(asked, rows);
        }
      };
      for (const Gaps& gaps : kGaps) {
        std::vector<scenes::Frame> frames;
        for (std::size_t i = 0; i < poses.size(); ++i) {
          for (const std::size_t turn : gaps.in_turn) {
            if (i % scenes::kGapsOfPoses != turn) continue;
            frames.push_back({fcl::Transform3d::Identity(), poses[i]});
          }
        }
        ask(gaps.name, frames, true);
      }
      ask("standing", standing(place.mesh, body.mesh, count / 7, options.seed), false);
      report.add(rows);
    }
  }
}

}  // namespace kios::bench
