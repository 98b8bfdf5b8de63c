// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scene_contest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "timing.h"

namespace kios::bench {
namespace {

// FCL's distances are off by up to about that much of a mesh's extent where nothing degenerates.
constexpr double kAgreement = 1e-9;

// As many as leave a scene that is asked about at each frame its place in the caches.
constexpr int kBlock = 20;

struct Lane {
  SceneEntrant* entrant;
  std::vector<std::vector<double>> us;            // by repeat and frame; 0 where it didn't answer
  std::vector<std::vector<SceneAnswer>> answers;  // by frame
  long long queried = 0, frames = 0;              // of one repeat
};

using Distances = std::map<std::pair<int, int>, double>;

Distances distancesOf(const std::vector<SceneAnswer>& answers) {
  Distances distances;
  for (const SceneAnswer& answer : answers) distances[{answer.a, answer.b}] = answer.distance;
  return distances;
}

struct Errors {
  double absolute = 0, relative = 0;
  std::size_t wrong = 0;

  void compare(double answer, double truth, double tolerance) {
    const double error = std::abs(answer - truth);
    absolute = std::max(absolute, error);
    if (truth > 0) relative = std::max(relative, error / truth);
    if (!(error <= tolerance)) ++wrong;
  }
};

// A pair that only one of the two reports counts as wrong unless its distance is the margin.
void compare(const SceneTask& task, const std::vector<SceneAnswer>& answers,
             const std::vector<SceneAnswer>& truths, double tolerance, Errors& errors) {
  if (task.query == SceneQuery::kClosest) {
    if (answers.empty() != truths.empty()) {
      ++errors.wrong;
    } else if (!answers.empty()) {
      errors.compare(answers[0].distance, truths[0].distance, tolerance);
    }
    return;
  }
  const Distances found = distancesOf(answers), true_ones = distancesOf(truths);
  for (const auto& [ids, truth] : true_ones) {
    const auto it = found.find(ids);
    if (it != found.end()) {
      if (task.query != SceneQuery::kVerdicts) errors.compare(it->second, truth, tolerance);
    } else if (std::abs(truth - task.margin) > tolerance) {
      ++errors.wrong;
    }
  }
  for (const auto& [ids, distance] : found) {
    if (true_ones.count(ids) == 0 && std::abs(distance - task.margin) > tolerance) ++errors.wrong;
  }
}

// Median over repeats of the ratio of both times over the frames that both answered.
double ratio(const Lane& reference, const Lane& own) {
  std::vector<double> ratios;
  for (std::size_t repeat = 0; repeat < own.us.size(); ++repeat) {
    double theirs = 0, ours = 0;
    for (std::size_t frame = 0; frame < own.us[repeat].size(); ++frame) {
      if (reference.us[repeat][frame] == 0 || own.us[repeat][frame] == 0) continue;
      theirs += reference.us[repeat][frame];
      ours += own.us[repeat][frame];
    }
    ratios.push_back(theirs / ours);
  }
  return median(std::move(ratios));
}

}  // namespace

SceneContest::SceneContest(const scenes::BodyScene& scene, std::vector<SceneEntrant> entrants,
                           const Options& options)
    : scene_(scene), entrants_(std::move(entrants)), options_(options) {
  for (const scenes::Mesh& mesh : scene.meshes) {
    extent_ = std::max(extent_, scenes::extent(mesh));
    triangles_ += mesh.triangles.size();
  }
  for (SceneEntrant& entrant : entrants_) entrant.competitor->load(scene);
}

std::vector<Row> SceneContest::rows(const SceneTask& task) {
  const int frames = static_cast<int>(scene_.frames.size());
  std::vector<Lane> lanes;
  for (SceneEntrant& entrant : entrants_) {
    if (!entrant.competitor->serves(task.query)) continue;
    lanes.push_back({&entrant, {}, std::vector<std::vector<SceneAnswer>>(frames), 0, 0});
    // Whatever models leave to their first query belongs to no repeat.
    entrant.competitor->answer(task.query, 0, task.margin);
  }
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (Lane& lane : lanes) {
      lane.entrant->competitor->forget();
      lane.us.emplace_back(frames, 0.0);
    }
    for (int begin = 0, block = 0; begin < frames; begin += kBlock, ++block) {
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + block + repeat) % lanes.size()];
        for (int frame = begin; frame < std::min(begin + kBlock, frames); ++frame) {
          if (frame % lane.entrant->stride != 0) continue;
          const double start = nowMicroseconds();
          lane.answers[frame] = lane.entrant->competitor->answer(task.query, frame, task.margin);
          lane.us[repeat][frame] = nowMicroseconds() - start;
          if (repeat > 0) continue;
          lane.queried += lane.entrant->competitor->queried();
          ++lane.frames;
        }
      }
    }
  }

  const auto named = [&lanes](const char* name) {
    return std::find_if(lanes.begin(), lanes.end(), [name](const Lane& lane) {
      return std::string(lane.entrant->competitor->name()) == name;
    });
  };
  auto reference = named("fcl_obbrss");
  if (reference == lanes.end()) reference = named("fcl_manager");
  const auto all_pairs = static_cast<long long>(scene_.size()) * (scene_.size() - 1) / 2;
  std::vector<Row> rows;
  for (const Lane& lane : lanes) {
    const SceneCompetitor& competitor = *lane.entrant->competitor;
    Row row;
    row.scenario = task.scenario;
    row.query = "scene";
    row.bv = competitor.name();
    row.triangles = triangles_;
    row.frames = lane.frames;
    row.rel_err = row.abs_err = 0;
    if (task.query == SceneQuery::kWithin || task.query == SceneQuery::kVerdicts) {
      row.threshold = task.margin;
    }
    std::vector<double> per_frame;
    for (const auto& us : lane.us) {
      double sum = 0;
      for (const double time : us) sum += time;
      per_frame.push_back(sum / static_cast<double>(lane.frames));
    }
    row.median_us = median(per_frame);
    row.min_us = *std::min_element(per_frame.begin(), per_frame.end());
    if (reference != lanes.end()) row.ratio_to_fcl_obbrss = ratio(*reference, lane);
    row.total_pairs = all_pairs * lane.frames;
    row.skipped_pairs = all_pairs * lane.frames - lane.queried;
    row.narrow_queries = static_cast<double>(lane.queried) / static_cast<double>(lane.frames);
    row.bytes_per_triangle =
        static_cast<double>(competitor.bytes()) / static_cast<double>(triangles_);
    row.prepared_models = competitor.preparedModels();
    row.simd_target = competitor.simdTarget();
    row.seed = options_.seed;
    row.extent = extent_;
    Errors errors;
    for (int frame = 0; frame < frames; ++frame) {
      if (lane.us[0][frame] == 0 || lanes[0].us[0][frame] == 0) continue;
      compare(task, lane.answers[frame], lanes[0].answers[frame], kAgreement * extent_, errors);
    }
    row.max_abs_error = errors.absolute;
    row.max_rel_error = errors.relative;
    row.wrong_verdicts = errors.wrong;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace kios::bench
