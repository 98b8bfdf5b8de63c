// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "contest.h"
#include "scenario.h"
#include "scenes/cad_shapes.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "scenes/worlds.h"
#include "scenes/yard.h"

namespace kios::bench {
namespace {

struct Named {
  const char* name;
  scenes::Mesh mesh;
};

/// A place, and the height that bodies stand at.
struct Place {
  const char* name;
  scenes::Mesh mesh;
  double top;
};

scenes::Mesh roughGround(double height) {
  scenes::Mesh mesh = scenes::sheet(10, 10, 20, 20, 0);
  scenes::Random random(3);
  for (fcl::Vector3d& v : mesh.vertices) v.z() = random.uniform(-height, height);
  return mesh;
}

/// A hundred needles through a box, in all directions.
scenes::Mesh brush() {
  std::vector<scenes::Mesh> needles;
  scenes::Random random(7);
  const auto vector = [&](double most) {
    const double x = random.uniform(-most, most), y = random.uniform(-most, most);
    return fcl::Vector3d(x, y, random.uniform(-most, most));
  };
  for (int i = 0; i < 100; ++i) {
    const fcl::Vector3d p = vector(0.5), along = 0.5 * vector(1).normalized();
    needles.push_back(scenes::singleTriangle(p - along, p + along, p - along + vector(0.002)));
  }
  return scenes::merged(needles);
}

double highest(const scenes::Mesh& mesh) {
  double most = -std::numeric_limits<double>::infinity();
  for (const fcl::Vector3d& v : mesh.vertices) most = std::max(most, v.z());
  return most;
}

std::vector<Place> places() {
  scenes::Mesh quad;
  quad.vertices = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {{"quad", quad, 0},
          {"box", scenes::subdividedBox({1.2, 0.8, 0.5}, 1), 0.25},
          {"grid", scenes::sheet(10, 10, 20, 20, 0), 0},
          {"rough", roughGround(0.05), 0.05},
          {"yard", scenes::withPosts(quad, 1.5), 0},
          {"brush", brush(), highest(brush())}};
}

std::vector<Named> bodies() {
  return {{"quad", scenes::sheet(0.5, 0.4, 1, 1, 0)},
          {"box", scenes::subdividedBox({0.3, 0.2, 0.15}, 1)},
          {"ball", scenes::uvSphere(0.2, 4, 5)},
          {"can", scenes::stripCylinder(12, 0.3, 0.05)},
          {"drum", scenes::stripCylinder(100, 0.4, 0.01)},
          {"stone", scenes::icosphere(0.2, 2)},
          {"ring", scenes::bumpyTorus(500)}};
}

// Which of posesNear()'s gaps, in turn, belong together.
struct Gaps {
  const char* name;
  std::vector<std::size_t> in_turn;
};
const Gaps kGaps[] = {{"touching", {0, 2}}, {"near", {1, 3}}, {"off", {4, 5, 6}}};

/// The body stands on the place, `gap(random)` above it, in worlds turned at random.
template <class GapOf>
std::vector<scenes::Frame> standing(const Place& place, const scenes::Mesh& body, int count,
                                    std::uint64_t seed, const GapOf& gap) {
  double low = std::numeric_limits<double>::infinity();
  for (const fcl::Vector3d& v : body.vertices) low = std::min(low, v.z());
  scenes::Random random(seed);
  std::vector<scenes::Frame> frames;
  for (const fcl::Transform3d& X_WA : scenes::randomPoses(count, 1, seed)) {
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.2, 0.2);
    X_AB.translation() = fcl::Vector3d(x, y, place.top - low + gap(random));
    X_AB.rotate(Eigen::AngleAxisd(random.uniform(0, 6.28), fcl::Vector3d::UnitZ()));
    frames.push_back({X_WA, X_WA * X_AB});
  }
  return frames;
}

}  // namespace

void runSmall(const Options& options, Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 28 : 700);
  for (const Place& place : places()) {
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
        for (const Query query : {Query::kDistance, Query::kThreshold, Query::kCollide}) {
          Task task = pairTask(pair + state, query, frames);
          if (query == Query::kThreshold) {
            constexpr double kNear = 0.01;
            task.threshold = kNear;
            for (Question& question : task.questions) question.threshold = kNear;
          }
          std::vector<Row> asked = contest.queryRows(task);
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
      // They touch but for rounding, also that of the poses, so that no verdict is wrong.
      ask("standing",
          standing(place, body.mesh, count / 7, options.seed, [](scenes::Random&) { return 0.0; }),
          false);
      ask("hovering",
          standing(place, body.mesh, count / 7, options.seed,
                   [](scenes::Random& random) { return std::pow(10, random.uniform(-6, -2)); }),
          true);
      report.add(rows);
    }
  }
}

}  // namespace kios::bench
