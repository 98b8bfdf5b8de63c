// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include "scenes/cad_shapes.h"
#include "scenes/placement.h"
#include "scenes/shapes.h"
#include "shape_geometry.h"
#include "world_tasks.h"

namespace kios::bench {
namespace {

using scenes::kPi;
using scenes::World;

constexpr std::size_t kContacts = 100;
constexpr double kThresholds[] = {1e-3, 2e-2};
constexpr int kPoses = 42;

/// Shapes that are one world, and their mesh, near which links are placed.
struct ShapeWorld {
  World world;
  Geometries shapes;
  std::vector<fcl::Transform3d> places;  // of the shapes in the world's frame
  bool fcl_has_distance = true;
};

/// The links are the first bodies, the shapes the last.
std::vector<Question> questionsOf(const ShapeWorld& of, const std::vector<PlacedLink>& placed,
                                  std::size_t first_link, std::size_t first_shape) {
  std::vector<Question> questions;
  for (const auto& [link, X_VL] : placed) {
    for (std::size_t i = 0; i < of.shapes.size(); ++i) {
      Question question{
          first_link + link, first_shape + i, {worldPose() * X_VL, worldPose() * of.places[i]}};
      question.max_contacts = kContacts;
      questions.push_back(question);
    }
  }
  return questions;
}

/// The queries of all shapes, a frame for a pose: distances at `distances` of the poses alone, and
/// with a bound on entry if `thresholds`.
void reportShapes(const ShapeWorld& of, int poses, std::size_t distances, bool thresholds,
                  const std::vector<LinkSet>& sets, const Options& options, Report& report) {
  std::vector<scenes::Mesh> meshes;
  for (const LinkSet& set : sets) {
    meshes.insert(meshes.end(), set.meshes.begin(), set.meshes.end());
  }
  Contest contest(meshes, options, of.shapes);
  std::size_t first_link = 0;
  for (const LinkSet& set : sets) {
    std::vector<Row> rows;
    Task task;
    task.scenario = "world/" + of.world.name + "/" + set.name;
    task.questions =
        questionsOf(of, placedLinks(of.world, set.meshes, poseCount(poses, options), options.seed),
                    first_link, meshes.size());
    task.frames = task.questions.size() / of.shapes.size();
    Task cold = colder(task, options);
    for (Task* each : {&task, &cold}) {
      if (each == &cold && first_link > 0) continue;
      for (const Query query : {Query::kDistance, Query::kCollide, Query::kContacts}) {
        if (each == &cold && query == Query::kContacts) continue;
        each->query = query;
        each->ours_alone = query == Query::kDistance && !of.fcl_has_distance;
        append(contest.queryRows(query == Query::kDistance ? fewer(*each, distances) : *each),
               rows);
      }
    }
    task.query = Query::kThreshold;
    task.ours_alone = !of.fcl_has_distance;
    for (const double threshold : kThresholds) {
      if (!thresholds) continue;
      task.threshold = threshold;
      for (Question& question : task.questions) question.threshold = threshold;
      append(contest.queryRows(task), rows);
    }
    first_link += set.meshes.size();
    report.add(rows);
  }
}

ShapeWorld asBoxes(const World& world) {
  ShapeWorld of{world, {}, {}};
  of.world.name += "_as_boxes";
  for (const scenes::Board& board : world.boards) {
    of.shapes.push_back(std::make_shared<fcl::Boxd>(board.size));
    of.places.push_back(board.X_WB);
  }
  return of;
}

ShapeWorld single(const std::string& name, const std::shared_ptr<fcl::CollisionGeometryd>& shape,
                  scenes::Mesh surface) {
  ShapeWorld of{{}, {shape}, {fcl::Transform3d::Identity()}};
  of.world.name = name;
  of.world.mesh = std::move(surface);
  return of;
}

/// Makes a mesh of revolution about z, from its radii at `steps` + 1 places from -half to half.
scenes::Mesh turned(double half, int steps, const std::function<double(double z)>& radius) {
  std::vector<scenes::ProfilePoint> profile = {{0, -half}};
  for (int i = 0; i <= steps; ++i) {
    const double z = -half * std::cos(kPi * i / steps);
    if (radius(z) > 1e-9) profile.push_back({radius(z), z});
  }
  profile.push_back({0, half});
  return scenes::turnedPart(profile, 64);
}

std::vector<ShapeWorld> singleShapes() {
  const auto box = [](const std::string& name, const fcl::Vector3d& size) {
    return single(name, std::make_shared<fcl::Boxd>(size), scenes::subdividedBox(size, 1));
  };
  scenes::Mesh egg = scenes::icosphere(1, 4);
  for (fcl::Vector3d& p : egg.vertices) p = p.cwiseProduct(fcl::Vector3d(0.15, 0.2, 0.3));
  const scenes::Mesh stone = scenes::icosphere(0.3, 1);
  std::vector<ShapeWorld> all = {
      box("box_table", {1.2, 0.8, 0.05}),
      box("box_floor", {10, 10, 0.1}),
      single("sphere", std::make_shared<fcl::Sphered>(0.2), scenes::icosphere(0.2, 4)),
      single("capsule", std::make_shared<fcl::Capsuled>(0.1, 0.5),
             turned(0.35, 40,
                    [](double z) {
                      const double beyond = std::max(0.0, std::abs(z) - 0.25);
                      return std::sqrt(std::max(0.0, 0.01 - beyond * beyond));
                    })),
      single("cylinder", std::make_shared<fcl::Cylinderd>(0.2, 0.6),
             turned(0.3, 4, [](double) { return 0.2; })),
      single("cone", std::make_shared<fcl::Coned>(0.25, 0.5),
             turned(0.25, 8, [](double z) { return (0.25 - z) / 2; })),
      single("ellipsoid", std::make_shared<fcl::Ellipsoidd>(0.15, 0.2, 0.3), egg),
      single("convex", convexOf(stone), stone)};
  // Planes are infinite; links are placed about 4 x 4 m of them.
  const scenes::Mesh square = scenes::sheet(4, 4, 1, 1, 0);
  for (const bool solid : {true, false}) {
    const fcl::Vector3d up = fcl::Vector3d::UnitZ();
    std::shared_ptr<fcl::CollisionGeometryd> shape = std::make_shared<fcl::Planed>(up, 0);
    if (solid) shape = std::make_shared<fcl::Halfspaced>(up, 0);
    all.push_back(single(solid ? "halfspace" : "plane", shape, square));
    all.back().fcl_has_distance = false;  // it follows a null pointer
  }
  return all;
}

/// Returns a scan of a table before a wall in cells of this size, and the surfaces as scanned.
ShapeWorld octree(const std::string& name, double cell) {
  const scenes::World table = scenes::boxWorld("", {{{1.6, 1, 0.02}, scenes::shift(0, 0, 0.75)},
                                                    {{2.4, 0.02, 2}, scenes::shift(0, 0.6, 1)}});
  return single(name, octreeOf(scenes::scannedTable(0.6 * cell, 0.3 * cell, 1), cell), table.mesh);
}

}  // namespace

void reportWorldShapes(const std::vector<LinkSet>& sets, const Options& all, Report& report) {
  Options options = all;
  options.bvs.erase(std::remove(options.bvs.begin(), options.bvs.end(), kCoal), options.bvs.end());
  std::vector<ShapeWorld> shapes;
  for (const World& world : scenes::boxWorlds()) {
    if (world.boards.size() > 1) shapes.push_back(asBoxes(world));
  }
  for (ShapeWorld& one : singleShapes()) shapes.push_back(std::move(one));
  for (const ShapeWorld& of : shapes) {
    if (wanted(options, of.world.name)) {
      const int poses = of.shapes.size() > 1 ? kPoses / 3 : kPoses;
      reportShapes(of, poses, kPoses, true, sets, options, report);
    }
  }
  constexpr int kOctreePoses = 14;
  constexpr std::size_t kOctreeDistances = 3;  // FCL takes up to 0.2 s for one
  for (const auto& [name, cell] :
       {std::pair("octree_18k", 0.02), std::pair("octree_34k", 0.0144)}) {
    if (wanted(options, name)) {
      reportShapes(octree(name, options.quick ? 4 * cell : cell), kOctreePoses, kOctreeDistances,
                   false, sets, options, report);
    }
  }
}

}  // namespace kios::bench
