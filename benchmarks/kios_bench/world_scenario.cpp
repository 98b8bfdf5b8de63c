// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links of robots about what stands around them, as meshes: few large triangles, or large ones
// among small ones.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "scenario.h"
#include "scenes/cad_parts.h"
#include "scenes/placement.h"
#include "scenes/ur5_data.h"
#include "world_tasks.h"

namespace kios::bench {
namespace {

constexpr int kPoses = 42;
constexpr double kThresholds[] = {0, 1e-3, 2e-2};

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
      task.threshold = threshold;
      for (Question& question : task.questions) question.threshold = threshold;
      append(contest.queryRows(task), rows);
    }
    task.threshold.reset();
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

}  // namespace

std::vector<LinkSet> linkSets(const Options& options) {
  std::vector<LinkSet> sets;
  const auto data = findData(options);
  if (data && scenes::holdsUr5(*data)) {
    sets.push_back({"ur5", {}});
    for (const scenes::Link& link : scenes::loadUr5(*data).links) {
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

fcl::Transform3d worldPose() {
  return scenes::shift(1.5, -0.7, 0.2) * scenes::turn(0.4, fcl::Vector3d::UnitZ());
}

int poseCount(int full, const Options& options) {
  constexpr int kQuick = 7;
  if (options.frames > 0) return std::max(1, options.frames * full / kPoses);
  return options.quick ? kQuick : full;
}

Options worldOptions(const Options& options) {
  Options ours = options;
  constexpr int kJudged = 14;
  if (options.oracle_frames == Options().oracle_frames) ours.oracle_frames = kJudged;
  if (options.bvs == defaultVolumeNames()) ours.bvs = {"kios", "fcl_rss", "fcl_obbrss"};
  return ours;
}

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

Task colder(const Task& task, const Options& options) {
  const std::size_t streamed = (options.quick ? 1 : 96) << 20;
  Task cold = fewer(task, options.quick ? 2 : 9);
  cold.scenario += "/cold";
  cold.cold = true;
  cold.streamed_bytes = streamed;
  return cold;
}

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
