// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Queries about all pairs of a scene, frame by frame.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <numeric>

#include "library.h"
#include "scenario.h"
#include "scene_set.h"
#include "scenes/placement.h"

namespace kios::bench {
namespace {

constexpr double kMargin = 0.1;

// FCL's distances are off by up to about that much of a mesh's extent where nothing degenerates.
constexpr double kAgreement = 1e-9;

// Frames of a block: as many as leave a scene that is asked about at each frame its place in the
// caches.
constexpr std::size_t kBlock = 20;

constexpr struct {
  SceneQuery query;
  const char* name;
} kQueries[] = {{SceneQuery::kClosest, "closest"},
                {SceneQuery::kWithin, "within"},
                {SceneQuery::kVerdicts, "verdicts"},
                {SceneQuery::kClearances, "clearances"}};

using Distances = std::map<std::pair<int, int>, double>;

Distances distancesOf(const std::vector<SceneAnswer>& answers) {
  Distances distances;
  for (const SceneAnswer& answer : answers) distances[{answer.a, answer.b}] = answer.distance;
  return distances;
}

void compare(double answer, double truth, double tolerance, Errors& errors) {
  const double error = std::abs(answer - truth);
  *errors.max_abs = std::max(*errors.max_abs, error);
  if (!(error <= tolerance)) ++*errors.wrong;
}

// A pair that only one of the two reports counts as wrong unless its distance is the margin.
void compare(SceneQuery query, const std::vector<SceneAnswer>& answers,
             const std::vector<SceneAnswer>& truths, double tolerance, Errors& errors) {
  if (query == SceneQuery::kClosest) {
    if (answers.empty() != truths.empty()) {
      ++*errors.wrong;
    } else if (!answers.empty()) {
      compare(answers[0].distance, truths[0].distance, tolerance, errors);
    }
    return;
  }
  const Distances found = distancesOf(answers), true_ones = distancesOf(truths);
  for (const auto& [ids, truth] : true_ones) {
    const auto it = found.find(ids);
    if (it != found.end()) {
      if (query != SceneQuery::kVerdicts) compare(it->second, truth, tolerance, errors);
    } else if (std::abs(truth - kMargin) > tolerance) {
      ++*errors.wrong;
    }
  }
  for (const auto& [ids, distance] : found) {
    if (true_ones.count(ids) == 0 && std::abs(distance - kMargin) > tolerance) ++*errors.wrong;
  }
}

/// Holds a set and what it answered: each so many-th frame, where it takes too long.
struct Entrant {
  std::string name;
  std::unique_ptr<SceneSet> set;
  std::size_t stride;
  std::vector<std::vector<SceneAnswer>> answers;  // by frame
  std::vector<long long> queried;                 // pairs, by frame
};

/// The sets take turns at blocks of frames, each repeat from a cold start. The first sets the
/// truth: answers of all others are compared with its, the distances, and whether a pair is nearer
/// than the margin. Ratios are to fcl_obbrss, or else fcl_manager.
std::vector<Row> rowsOf(const scenes::BodyScene& scene, SceneQuery query, Row base,
                        std::vector<Entrant>& entrants, int repeats) {
  const std::size_t frames = scene.frames.size();
  std::vector<Competitor> competitors;
  std::vector<Entrant*> of;
  for (Entrant& entrant : entrants) {
    SceneSet& set = *entrant.set;
    if (!set.serves(query)) continue;
    entrant.answers.assign(frames, {});
    entrant.queried.assign(frames, 0);
    const auto answer = [&entrant, query](std::size_t frame, std::size_t /*end*/) {
      entrant.answers[frame] = entrant.set->answer(query, static_cast<int>(frame), kMargin);
      entrant.queried[frame] = entrant.set->queried();
    };
    const auto before = [&set](std::size_t frame, std::size_t /*end*/) {
      if (frame == 0) set.forget();
    };
    competitors.push_back({entrant.name, answer, before, entrant.stride});
    competitors.back().rounds = roundsOf(entrant.name);
    of.push_back(&entrant);
    set.answer(query, 0, kMargin);  // what models leave to their first query belongs to no repeat
  }
  Race{frames, repeats, kBlock, 1}.run(competitors);

  const Competitor* reference = named("fcl_obbrss", competitors);
  if (!reference) reference = named("fcl_manager", competitors);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Entrant& entrant = *of[i];
    base.frames = (frames + entrant.stride - 1) / entrant.stride;
    Row row = base.of(competitors[i], reference);
    row.asked.rel_err = row.asked.abs_err = 0;
    if (query == SceneQuery::kWithin || query == SceneQuery::kVerdicts) {
      row.asked.threshold = kMargin;
    }
    const long long queried = std::accumulate(entrant.queried.begin(), entrant.queried.end(), 0LL);
    row.pairs.narrow_queries = static_cast<double>(queried) / static_cast<double>(row.frames);
    row.pairs.total = static_cast<std::size_t>(scene.size() * (scene.size() - 1) / 2) * row.frames;
    row.errors.max_abs = 0;
    row.errors.wrong = 0;
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (frame % entrant.stride != 0 || frame % of[0]->stride != 0) continue;
      compare(query, entrant.answers[frame], of[0]->answers[frame], kAgreement * row.extent,
              row.errors);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Reports all queries, or the first `queries` of them, by sets of these names and strides.
void reportScene(const std::string& scenario, const scenes::BodyScene& scene, std::size_t queries,
                 const std::vector<std::pair<const char*, std::size_t>>& sets,
                 const Options& options, Report& report) {
  std::vector<Entrant> entrants;
  for (const auto& [bv, stride] : sets) {
    for (const std::string& name : compared({bv})) {
      auto set = isOurs(name) ? libraryOf(name).scene_set(scene) : makeSceneSet(name, scene);
      entrants.push_back({name, std::move(set), stride, {}, {}});
    }
  }
  Row base = baseRow(scenario, "scene", 0, scene.meshes);
  for (std::size_t i = 0; i < queries; ++i) {
    base.scenario = scenario + "/" + kQueries[i].name;
    report.add(rowsOf(scene, kQueries[i].query, base, entrants, options.repeats));
  }
}

int frameCount(const Options& options, int frames) {
  return options.quick ? 3 : options.frames > 0 ? options.frames : frames;
}

void reportRobots(const std::string& scenario, const scenes::Robot& robot,
                  const fcl::Transform3d& X_W2, std::size_t stride, const Options& options,
                  Report& report) {
  for (const bool smooth : {true, false}) {
    const scenes::BodyScene scene = scenes::twoRobots(
        robot, fcl::Transform3d::Identity(), X_W2, frameCount(options, 60), smooth, options.seed);
    reportScene(scenario + (smooth ? "/smooth" : "/random"), scene, std::size(kQueries),
                {{"kios_pairs", stride},
                 {"kios", 1},
                 {"fcl_obbrss", stride},
                 {"fcl_obbrss_bounded", stride},
                 {"fcl_manager", stride}},
                options, report);
  }
}

}  // namespace

void reportRobotScenes(const Options& options, Report& report) {
  reportRobots("robots/generated", scenes::cadArm(), scenes::facing(0.7), 6, options, report);
  if (!options.quick) {  // which pairs of a humanoid may touch takes the oracle a while
    reportRobots("robots/humanoids", scenes::humanoid(), scenes::facing(0.8), 20, options, report);
  }
  if (const auto ur5 = findUr5(options)) {
    reportRobots("robots/ur5", *ur5, scenes::shift(0, 0.5, 0), 6, options, report);
  }
}

void runScene(const Options& options, Report& report) {
  if (wanted(options, "crowds")) reportCrowds(options, report);
  if (!wanted(options, "bodies")) return;
  constexpr std::size_t kClosestAndWithin = 2;
  const int bodies = options.quick ? 300 : 5000;
  const auto run = [&](const std::string& scenario, const scenes::BodyScene& scene,
                       std::size_t stride) {
    reportScene(scenario, scene, kClosestAndWithin,
                {{"kios_bounded", stride}, {"kios", 1}, {"fcl_manager", 1}}, options, report);
  };
  const int frames = options.frames > 0 ? options.frames : frameCount(options, 40);
  run("scene/crowd", scenes::driftingCrowd(bodies, frames, options.seed), frames);
  const auto ur5 = findUr5(options);
  run(ur5 ? "scene/roadmap" : "scene/roadmap_generated",
      scenes::roadmap(ur5 ? *ur5 : scenes::cadArm(), bodies,
                      options.frames > 0 ? options.frames : frameCount(options, 1000),
                      options.seed),
      50);
}

}  // namespace kios::bench
