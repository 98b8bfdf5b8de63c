// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>

#include "contest.h"
#include "library.h"
#include "scenario.h"
#include "scenes/random.h"
#include "scenes/shape_geometry.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// Returns the mesh and the geometry at the frames of a query: apart for distances, touching or
/// near for contacts.
std::vector<Question> questionsOf(Query query, int count, std::uint64_t seed) {
  std::vector<Question> questions;
  for (const scenes::Frame& frame : query == Query::kDistance
                                        ? scenes::farMotion(count, 2.1, 4, seed)
                                        : scenes::farMotion(count, 0.4, 1.9, seed + 1)) {
    questions.push_back({0, 1, frame});
  }
  return questions;
}

void reportGeometry(const std::string& scenario, const scenes::Mesh& mesh, const Geometry& geometry,
                    int frames, const Options& options, Report& report) {
  Options pair = options;
  pair.bvs = compared({kOurs, "fcl_obbrss"});
  pair.oracle_frames = options.quick ? 5 : 20;
  Contest contest({mesh}, pair, {geometry});
  std::vector<Row> rows;
  for (const Query query : {Query::kDistance, Query::kCollide, Query::kContacts}) {
    Task task;
    task.scenario = scenario;
    task.query = query;
    task.questions = questionsOf(query, frames, options.seed);
    task.frames = task.questions.size();
    append(contest.queryRows(task), rows);
  }
  report.add(rows);
}

int frameCount(const Options& options) {
  constexpr int kFrames = 60;  // FCL takes up to 4 ms for one
  return options.frames > 0 ? options.frames : (options.quick ? 5 : kFrames);
}

}  // namespace

void runShapes(const Options& options, Report& report) {
  const scenes::Mesh mesh = scenes::bumpyTorus(options.quick ? 2000 : 20000);
  const std::pair<const char*, Geometry> shapes[] = {
      {"sphere", std::make_shared<fcl::Sphered>(0.4)},
      {"box", std::make_shared<fcl::Boxd>(0.6, 0.5, 0.8)},
      {"cone", std::make_shared<fcl::Coned>(0.4, 0.8)},
      {"cylinder", std::make_shared<fcl::Cylinderd>(0.3, 0.8)},
      {"capsule", std::make_shared<fcl::Capsuled>(0.25, 0.6)},
      {"ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.3, 0.4, 0.5)},
      {"convex", scenes::convexOf(scenes::icosphere(0.4, 1))},
      {"hull", scenes::convexOf(scenes::icosphere(0.4, 3))}};
  for (const auto& [shape, geometry] : shapes) {
    reportGeometry(std::string("shapes/") + shape, mesh, geometry, frameCount(options), options,
                   report);
  }
  // Occupied cells about the surface of a sphere.
  reportGeometry("octrees/shell", mesh, scenes::octreeOf(scenes::icosphere(0.4, 4).vertices, 0.05),
                 frameCount(options), options, report);
}

}  // namespace kios::bench
