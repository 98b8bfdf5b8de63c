// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "contest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "timing.h"

namespace kios::bench {
namespace {

// Large enough for the models to be in cache for most of a block even where a query takes 3 us.
constexpr std::size_t kBlock = 256;

constexpr char kReference[] = "fcl_obbrss";

// Median over repeats of reference / own time of the same repeat.
double medianRatio(const std::vector<double>& reference, const std::vector<double>& own) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < own.size(); ++i) ratios.push_back(reference[i] / own[i]);
  return median(std::move(ratios));
}

// i of `count` evenly chosen indices below `size`.
std::size_t evenIndex(std::size_t i, std::size_t count, std::size_t size) {
  return i * size / count;
}

// What the oracle says at some of the frames.
struct Verdicts {
  std::vector<std::size_t> frames;
  std::vector<double> answers;  // distance, or 1 for contact
};

Verdicts judge(const scenes::MeshOracle& oracle, Query query,
               const std::vector<scenes::Frame>& frames, int wanted) {
  const std::size_t count =
      wanted == 0 ? frames.size() : std::min(frames.size(), static_cast<std::size_t>(wanted));
  Verdicts verdicts;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t frame = evenIndex(i, count, frames.size());
    const auto& [X_WA, X_WB] = frames[frame];
    verdicts.frames.push_back(frame);
    verdicts.answers.push_back(query == Query::kDistance ? oracle.distance(X_WA, X_WB)
                                                         : (oracle.collide(X_WA, X_WB) ? 1 : 0));
  }
  return verdicts;
}

// An answer that is no number is an infinite error, so that it cannot hide in a maximum.
double absoluteError(double answer, double exact) {
  return std::isfinite(answer) ? std::abs(answer - exact) : std::numeric_limits<double>::infinity();
}

void compare(const std::vector<double>& answers, const Verdicts& verdicts, Query query, Row& row) {
  row.wrong_verdicts = 0;
  for (std::size_t i = 0; i < verdicts.frames.size(); ++i) {
    const double answer = answers[verdicts.frames[i]];
    const double exact = verdicts.answers[i];
    if ((answer == 0) != (exact == 0)) ++*row.wrong_verdicts;
    if (query != Query::kDistance) continue;
    const double error = absoluteError(answer, exact);
    row.max_abs_error = std::max(row.max_abs_error.value_or(0), error);
    if (exact > 0) row.max_rel_error = std::max(row.max_rel_error.value_or(0), error / exact);
  }
}

}  // namespace

std::vector<scenes::Frame> evenlyChosen(const std::vector<scenes::Frame>& frames, int count) {
  if (count == 0 || static_cast<std::size_t>(count) >= frames.size()) return frames;
  std::vector<scenes::Frame> chosen;
  chosen.reserve(count);
  for (int i = 0; i < count; ++i) chosen.push_back(frames[evenIndex(i, count, frames.size())]);
  return chosen;
}

Contest::Contest(const scenes::Mesh& a, const scenes::Mesh& b, const Options& options)
    : options_(options),
      extent_(std::max(scenes::extent(a), scenes::extent(b))),
      triangles_(a.triangles.size() + b.triangles.size()),
      oracle_(a, b) {
  for (const std::string& bv : options.bvs) entrants_.push_back({makeCompetitor(bv), {}});
  measureBuilds(a, b);
  for (Entrant& entrant : entrants_) entrant.competitor->load(a, b);
}

void Contest::measureBuilds(const scenes::Mesh& a, const scenes::Mesh& b) {
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (std::size_t turn = 0; turn < entrants_.size(); ++turn) {
      Entrant& entrant = entrants_[(turn + repeat) % entrants_.size()];
      const double start = nowMicroseconds();
      entrant.competitor->build(a, b);
      entrant.build_us.push_back(nowMicroseconds() - start);
    }
  }
}

Row Contest::rowOf(const Entrant& entrant, const std::string& scenario, Query query) const {
  Row row;
  row.scenario = scenario;
  row.query = name(query);
  row.bv = entrant.competitor->name();
  row.triangles = triangles_;
  row.bytes_per_triangle =
      static_cast<double>(entrant.competitor->bytes()) / static_cast<double>(triangles_);
  row.build_us_per_triangle = median(entrant.build_us) / static_cast<double>(triangles_);
  row.simd_target = entrant.competitor->simdTarget();
  row.seed = options_.seed;
  row.extent = extent_;
  return row;
}

std::vector<Row> Contest::buildRows(const std::string& scenario) const {
  const auto reference = std::find_if(
      entrants_.begin(), entrants_.end(),
      [](const Entrant& entrant) { return std::string(entrant.competitor->name()) == kReference; });
  std::vector<Row> rows;
  for (const Entrant& entrant : entrants_) {
    Row row = rowOf(entrant, scenario, Query::kBuild);
    row.frames = 1;
    row.median_us = median(entrant.build_us);
    row.min_us = *std::min_element(entrant.build_us.begin(), entrant.build_us.end());
    if (reference != entrants_.end()) {
      row.ratio_to_fcl_obbrss = medianRatio(reference->build_us, entrant.build_us);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Contest::queryRows(const std::string& scenario, Query query,
                                    const std::vector<scenes::Frame>& frames) {
  struct Lane {
    const Entrant* entrant;
    std::vector<double> answers;
    std::vector<double> repeat_us;  // per frame
  };
  std::vector<Lane> lanes;
  for (const Entrant& entrant : entrants_) {
    if (!entrant.competitor->serves(query)) continue;
    lanes.push_back({&entrant, std::vector<double>(frames.size()), {}});
  }

  // The first query of a model may prepare it: that belongs to no repeat.
  for (Lane& lane : lanes) lane.entrant->competitor->answer(query, frames, 0, 1, lane.answers);
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (Lane& lane : lanes) lane.repeat_us.push_back(0);
    for (std::size_t begin = 0, block = 0; begin < frames.size(); begin += kBlock, ++block) {
      const std::size_t end = std::min(begin + kBlock, frames.size());
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + block + repeat) % lanes.size()];
        const double start = nowMicroseconds();
        lane.entrant->competitor->answer(query, frames, begin, end, lane.answers);
        lane.repeat_us.back() += nowMicroseconds() - start;
      }
    }
    for (Lane& lane : lanes) lane.repeat_us.back() /= static_cast<double>(frames.size());
  }

  const auto reference = std::find_if(lanes.begin(), lanes.end(), [](const Lane& lane) {
    return std::string(lane.entrant->competitor->name()) == kReference;
  });
  const Verdicts verdicts = judge(oracle_, query, frames, options_.oracle_frames);
  std::vector<Row> rows;
  for (const Lane& lane : lanes) {
    Row row = rowOf(*lane.entrant, scenario, query);
    row.frames = frames.size();
    row.median_us = median(lane.repeat_us);
    row.min_us = *std::min_element(lane.repeat_us.begin(), lane.repeat_us.end());
    if (reference != lanes.end()) {
      row.ratio_to_fcl_obbrss = medianRatio(reference->repeat_us, lane.repeat_us);
    }
    if (query == Query::kDistance) {
      row.rel_err = 0;
      row.abs_err = 0;
    }
    compare(lane.answers, verdicts, query, row);
    const TestCounts counts = lane.entrant->competitor->count(query, frames);
    row.bv_tests = static_cast<double>(counts.bv_tests) / static_cast<double>(frames.size());
    row.leaf_tests = static_cast<double>(counts.leaf_tests) / static_cast<double>(frames.size());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace kios::bench
