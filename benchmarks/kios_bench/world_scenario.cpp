// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links of robots about what stands around them, as meshes: few large triangles, or large ones
// among small ones.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>

#include "contest.h"
#include "scenario.h"
#include "scenes/cad_parts.h"
#include "scenes/placement.h"
#include "scenes/shape_geometry.h"
#include "scenes/worlds.h"

namespace kios::bench {
namespace {

constexpr int kPoses = 42;
constexpr double kThresholds[] = {0, 1e-3, 2e-2};
constexpr std::size_t kContacts = 100;  // of shapes

/// Holds meshes that robots are made of.
struct LinkSet {
  std::string name;
  std::vector<scenes::Mesh> meshes;
};

/// Holds a link, by its number, at a pose in the world's frame.
struct PlacedLink {
  std::size_t link;
  fcl::Transform3d X_VL;
};

/// Returns a UR5's where the data is there, and parts of machines; a few of them for options.quick.
std::vector<LinkSet> linkSets(const Options& options) {
  std::vector<LinkSet> sets;
  if (const auto ur5 = findUr5(options)) {
    sets.push_back({"ur5", {}});
    for (const scenes::Link& link : ur5->links) {
      sets.back().meshes.push_back(link.mesh);
    }
  } else {
    std::printf("world/*/ur5 is left out: name the folder of its data by --data or KIOS_DATA\n");
  }
  sets.push_back({"parts", scenes::cadParts()});
  if (options.quick) {
    for (LinkSet& set : sets) set.meshes.resize(2);
  }
  return sets;
}

/// Returns poses near the world for all links in turn.
std::vector<PlacedLink> placedLinks(const scenes::World& world,
                                    const std::vector<scenes::Mesh>& links, int count,
                                    std::uint64_t seed) {
  // Every link gets all gaps in turn.
  std::vector<PlacedLink> placed(static_cast<std::size_t>(count));
  for (std::size_t link = 0; link < links.size(); ++link) {
    const auto poses = scenes::posesNear(world, links[link], count, seed + 100 * link);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if ((i + i / scenes::kGapsOfPoses) % links.size() == link) placed[i] = {link, poses[i]};
    }
  }
  return placed;
}

/// Returns where worlds stand: not at the origin, nor along its axes.
fcl::Transform3d worldPose() {
  return scenes::shift(1.5, -0.7, 0.2) * scenes::turn(0.4, fcl::Vector3d::UnitZ());
}

/// Returns `full` poses, a mesh scene's 42 in the run of all; fewer in proportion where the options
/// name frames; seven for options.quick.
int poseCount(int full, const Options& options) {
  constexpr int kQuick = 7;
  if (options.frames > 0) return std::max(1, options.frames * full / kPoses);
  return options.quick ? kQuick : full;
}

/// Returns the options with FCL's RSS and OBBRSS beside ours, and a third of the frames judged,
/// where the command line doesn't say.
Options worldOptions(const Options& options) {
  Options ours = options;
  constexpr int kJudged = 14;
  if (options.oracle_frames == Options().oracle_frames) ours.oracle_frames = kJudged;
  if (options.bvs == defaultVolumeNames()) ours.bvs = {"kios", "fcl_rss", "fcl_obbrss"};
  return ours;
}

/// Returns a copy of the task with at most so many of its frames, evenly chosen.
Task fewer(const Task& task, std::size_t frames) {
  const std::size_t of_frame = task.questions.size() / task.frames;
  Task few = task;
  few.frames = std::min(frames, task.frames);
  few.questions.clear();
  for (std::size_t i = 0; i < few.frames; ++i) {
    const auto from = task.questions.begin() +
                      static_cast<std::ptrdiff_t>(i * task.frames / few.frames * of_frame);
    few.questions.insert(few.questions.end(), from, from + static_cast<std::ptrdiff_t>(of_frame));
  }
  return few;
}

/// Returns a copy of the task as cold as it gets: a few of its frames, 96 MB written before each.
Task colder(const Task& task, const Options& options) {
  const std::size_t streamed = (options.quick ? 1 : 96) << 20;
  Task cold = fewer(task, options.quick ? 2 : 9);
  cold.scenario += "/cold";
  cold.cold = true;
  cold.streamed_bytes = streamed;
  return cold;
}

/// The links are the bodies from `first_link`, the world the last. In large worlds it comes first,
/// since the oracle places all triangles of the second; else it is first for every other link.
std::vector<Question> questionsOf(const std::vector<PlacedLink>& placed, std::size_t first_link,
                                  std::size_t world, bool large) {
  const fcl::Transform3d X_WV = worldPose();
  std::vector<Question> questions;
  for (const auto& [link, X_VL] : placed) {
    const std::size_t body = first_link + link;
    const fcl::Transform3d X_WL = X_WV * X_VL;
    if (large || link % 2 == 1) {
      questions.push_back({world, body, {X_WV, X_WL}});
    } else {
      questions.push_back({body, world, {X_WL, X_WV}});
    }
  }
  return questions;
}

/// Two of them.
std::vector<LinkSet> thinned(std::vector<LinkSet> sets) {
  for (LinkSet& set : sets) {
    const std::size_t count = set.meshes.size();
    set.meshes = {set.meshes[count / 3], set.meshes[2 * count / 3]};
  }
  return sets;
}

/// Returns the first contacts of the poses that touch, of those within 5 cm of a surface and of the
/// others: one time for all hides what the answer costs.
std::vector<Row> rowsByGap(const Task& whole, Contest& contest) {
  const std::vector<std::pair<const char*, std::vector<std::size_t>>> kinds = {
      {"hit", {0, 3}}, {"near", {1, 2, 4}}, {"apart", {5, 6}}};
  std::vector<Row> rows;
  for (const auto& [name, of_seven] : kinds) {
    Task task = whole;
    task.scenario += std::string("/") + name;
    task.query = Query::kCollide;
    task.questions.clear();
    for (std::size_t i = 0; i < whole.questions.size(); ++i) {
      if (std::count(of_seven.begin(), of_seven.end(), i % scenes::kGapsOfPoses) > 0) {
        task.questions.push_back(whole.questions[i]);
      }
    }
    task.frames = task.questions.size();
    append(contest.queryRows(task), rows);
  }
  return rows;
}

void reportWorld(const std::string& scenario, const scenes::World& world, std::vector<LinkSet> sets,
                 const Options& options, Report& report) {
  constexpr std::size_t kLarge = 50000;  // triangles: an oracle for each link takes 100 MB
  const bool large = world.mesh.triangles.size() > kLarge;
  if (large) sets = thinned(std::move(sets));
  std::vector<scenes::Mesh> meshes;
  for (const LinkSet& set : sets) {
    meshes.insert(meshes.end(), set.meshes.begin(), set.meshes.end());
  }
  meshes.push_back(world.mesh);
  Contest contest(meshes, options);
  std::size_t first_link = 0;
  for (const LinkSet& set : sets) {
    std::vector<Row> rows;
    Task task;
    task.scenario = scenario + "/" + world.name + "/" + set.name;
    task.questions =
        questionsOf(placedLinks(world, set.meshes, poseCount(kPoses, options), options.seed),
                    first_link, meshes.size() - 1, large);
    task.frames = task.questions.size();
    for (const Query query : {Query::kDistance, Query::kCollide, Query::kContacts}) {
      task.query = query;
      append(contest.queryRows(task), rows);
    }
    task.query = Query::kCloserThan;
    for (const double threshold : kThresholds) {
      for (Question& question : task.questions) question.threshold = threshold;
      append(contest.queryRows(task), rows);
    }
    append(rowsByGap(task, contest), rows);
    if (first_link == 0) {
      Task cold = colder(task, options);
      for (const Query query : {Query::kDistance, Query::kCollide}) {
        cold.query = query;
        append(contest.queryRows(cold), rows);
      }
    }
    first_link += set.meshes.size();
    report.add(rows);
  }
}

std::vector<scenes::World> allWorlds(const Options& options) {
  std::vector<scenes::World> worlds = scenes::boxWorlds();
  for (scenes::World& world : scenes::meshWorlds(options.quick ? 5000 : 200000)) {
    worlds.push_back(std::move(world));
  }
  return worlds;
}

/// Some of the worlds with Coal beside.
void reportCoal(const Options& options, Report& report) {
  const std::vector<std::string> volumes = volumeNames();
  if (std::count(volumes.begin(), volumes.end(), kCoal) == 0) {
    throw Skipped("Coal was not found when kios_bench was built");
  }
  Options ours = worldOptions(options);
  ours.bvs = {"kios", "fcl_obbrss", kCoal};
  const std::vector<std::string> named = {"table", "shelf", "terrain_1m", "building"};
  const std::vector<LinkSet> sets = linkSets(options);
  for (const scenes::World& world : allWorlds(options)) {
    if (std::count(named.begin(), named.end(), world.name) == 0) continue;
    reportWorld("coal", world, sets, ours, report);
  }
}

/// Shapes that are one world, and their mesh, near which links are placed.
struct ShapeWorld {
  scenes::World world;
  Geometries shapes;
  std::vector<fcl::Transform3d> places;  // of the shapes in the world's frame
};

/// The links are the first bodies, the shapes the last.
std::vector<Question> boxQuestions(const ShapeWorld& of, const std::vector<PlacedLink>& placed,
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

/// The queries of all shapes, a frame for a pose: distances at `distances` of the poses alone.
void reportShapes(const ShapeWorld& of, int poses, std::size_t distances,
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
        boxQuestions(of, placedLinks(of.world, set.meshes, poseCount(poses, options), options.seed),
                     first_link, meshes.size());
    task.frames = task.questions.size() / of.shapes.size();
    Task cold = colder(task, options);
    for (Task* each : {&task, &cold}) {
      if (each == &cold && first_link > 0) continue;
      for (const Query query : {Query::kDistance, Query::kCollide, Query::kContacts}) {
        if (each == &cold && query == Query::kContacts) continue;
        each->query = query;
        append(contest.queryRows(query == Query::kDistance ? fewer(*each, distances) : *each),
               rows);
      }
    }
    first_link += set.meshes.size();
    report.add(rows);
  }
}

ShapeWorld asBoxes(const scenes::World& world) {
  ShapeWorld of{world, {}, {}};
  of.world.name += "_as_boxes";
  for (const scenes::Board& board : world.boards) {
    of.shapes.push_back(std::make_shared<fcl::Boxd>(board.size));
    of.places.push_back(board.X_WB);
  }
  return of;
}

/// Returns a scan of a table before a wall in cells of this size, and the surfaces as scanned.
ShapeWorld octree(const std::string& name, double cell) {
  const scenes::World table = scenes::boxWorld("", {{{1.6, 1, 0.02}, scenes::shift(0, 0, 0.75)},
                                                    {{2.4, 0.02, 2}, scenes::shift(0, 0.6, 1)}});
  ShapeWorld of{table,
                {scenes::octreeOf(scenes::scannedTable(0.6 * cell, 0.3 * cell, 1), cell)},
                {fcl::Transform3d::Identity()}};
  of.world.name = name;
  return of;
}

/// Links and worlds as FCL's shapes: boxes of worlds that are made of them, octrees.
void reportWorldShapes(const std::vector<LinkSet>& sets, const Options& all, Report& report) {
  Options options = all;
  options.bvs.erase(std::remove(options.bvs.begin(), options.bvs.end(), kCoal), options.bvs.end());
  for (const scenes::World& world : scenes::boxWorlds()) {
    const ShapeWorld boxes = asBoxes(world);
    if (!wanted(options, boxes.world.name)) continue;
    reportShapes(boxes, world.boards.size() > 1 ? kPoses / 3 : kPoses, kPoses, sets, options,
                 report);
  }
  constexpr int kOctreePoses = 14;
  constexpr std::size_t kOctreeDistances = 3;  // FCL takes up to 0.2 s for one
  for (const auto& [name, cell] :
       {std::pair("octree_18k", 0.02), std::pair("octree_34k", 0.0144)}) {
    if (wanted(options, name)) {
      reportShapes(octree(name, options.quick ? 4 * cell : cell), kOctreePoses, kOctreeDistances,
                   sets, options, report);
    }
  }
}

}  // namespace

void runWorld(const Options& options, Report& report) {
  if (options.part == "coal") return reportCoal(options, report);
  const Options ours = worldOptions(options);
  const std::vector<LinkSet> sets = linkSets(options);
  for (const scenes::World& world : allWorlds(options)) {
    if (wanted(options, world.name)) reportWorld("world", world, sets, ours, report);
  }
  reportWorldShapes(sets, ours, report);
}

}  // namespace kios::bench
