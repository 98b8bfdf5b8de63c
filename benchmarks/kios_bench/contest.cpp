// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "contest.h"

#include <algorithm>
#include <limits>

#include "timing.h"
#include "verdicts.h"

namespace kios::bench {
namespace {

// Large enough for the models to be in cache for most of a block even where a query takes 3 us; in
// frames where each asks many questions.
constexpr std::size_t kBlock = 256;
constexpr std::size_t kBlockFrames = 32;

constexpr char kReference[] = "fcl_obbrss";

// Median over repeats of reference / own time of the same repeat.
double medianRatio(const std::vector<double>& reference, const std::vector<double>& own) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < own.size(); ++i) ratios.push_back(reference[i] / own[i]);
  return median(std::move(ratios));
}

double minimum(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

template <typename Work>
double timeOf(const Work& work) {
  const double start = nowMicroseconds();
  work();
  return nowMicroseconds() - start;
}

// A competitor's answers and times to one task.
struct Lane {
  Competitor* competitor;
  std::vector<double> answers;
  std::vector<double> repeat_us;  // per frame
};

void timeRepeats(const Task& task, int repeats, std::vector<Lane>& lanes) {
  const std::size_t size = task.questions.size();
  const std::size_t block_size = std::max(kBlock, kBlockFrames * (size / task.frames));
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Lane& lane : lanes) lane.repeat_us.push_back(0);
    for (std::size_t begin = 0, block = 0; begin < size; begin += block_size, ++block) {
      const std::size_t end = std::min(begin + block_size, size);
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + block + repeat) % lanes.size()];
        lane.repeat_us.back() += timeOf(
            [&] { lane.competitor->answer(task.query, task.questions, begin, end, lane.answers); });
      }
    }
    for (Lane& lane : lanes) lane.repeat_us.back() /= static_cast<double>(task.frames);
  }
}

}  // namespace

std::vector<scenes::Frame> evenlyChosen(const std::vector<scenes::Frame>& frames, int count) {
  if (count == 0 || static_cast<std::size_t>(count) >= frames.size()) return frames;
  std::vector<scenes::Frame> chosen;
  chosen.reserve(count);
  for (int i = 0; i < count; ++i) chosen.push_back(frames[i * frames.size() / count]);
  return chosen;
}

Task pairTask(const std::string& scenario, Query query, const std::vector<scenes::Frame>& frames) {
  Task task{scenario, query, {}, frames.size(), std::nullopt};
  for (const scenes::Frame& frame : frames) {
    Question question;
    question.poses = frame;
    task.questions.push_back(question);
  }
  return task;
}

Contest::Contest(std::vector<scenes::Mesh> meshes, const Options& options)
    : options_(options), meshes_(std::move(meshes)) {
  for (const scenes::Mesh& mesh : meshes_) {
    extent_ = std::max(extent_, scenes::extent(mesh));
    triangles_ += mesh.triangles.size();
  }
  for (const std::string& bv : options.bvs) entrants_.push_back({makeCompetitor(bv), {}});
  measureBuilds();
  for (Entrant& entrant : entrants_) entrant.competitor->load(meshes_);
}

void Contest::measureBuilds() {
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (std::size_t turn = 0; turn < entrants_.size(); ++turn) {
      Entrant& entrant = entrants_[(turn + repeat) % entrants_.size()];
      entrant.build_us.push_back(timeOf([&] { entrant.competitor->build(meshes_); }));
    }
  }
}

const Contest::Entrant* Contest::reference() const {
  const auto found = std::find_if(entrants_.begin(), entrants_.end(), [](const Entrant& entrant) {
    return std::string(entrant.competitor->name()) == kReference;
  });
  return found == entrants_.end() ? nullptr : &*found;
}

const scenes::MeshOracle& Contest::oracle(std::size_t a, std::size_t b) {
  return oracles_.try_emplace({a, b}, meshes_[a], meshes_[b]).first->second;
}

Row Contest::rowOf(const Entrant& entrant, const std::string& scenario, Query query) const {
  Row row;
  row.scenario = scenario;
  row.query = name(query);
  row.bv = entrant.competitor->name();
  row.triangles = triangles_;
  row.frames = 1;
  row.bytes_per_triangle =
      static_cast<double>(entrant.competitor->bytes()) / static_cast<double>(triangles_);
  row.build_us_per_triangle = median(entrant.build_us) / static_cast<double>(triangles_);
  row.simd_target = entrant.competitor->simdTarget();
  row.seed = options_.seed;
  row.extent = extent_;
  return row;
}

std::vector<Row> Contest::buildRows(const std::string& scenario) const {
  std::vector<Row> rows;
  for (const Entrant& entrant : entrants_) {
    Row row = rowOf(entrant, scenario, Query::kBuild);
    row.median_us = median(entrant.build_us);
    row.min_us = minimum(entrant.build_us);
    if (const Entrant* obbrss = reference()) {
      row.ratio_to_fcl_obbrss = medianRatio(obbrss->build_us, entrant.build_us);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Contest::prepareRows(const std::string& scenario, const Question& question) const {
  const std::size_t count = entrants_.size();
  std::vector<std::vector<double>> prepare_us(count);
  std::vector<double> reference_us;
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    if (const Entrant* obbrss = reference()) {
      reference_us.push_back(timeOf([&] { obbrss->competitor->build(meshes_); }));
    }
    for (std::size_t turn = 0; turn < count; ++turn) {
      const std::size_t i = (turn + repeat) % count;
      Competitor& competitor = *entrants_[i].competitor;
      if (!competitor.serves(Query::kPrepare)) continue;
      prepare_us[i].push_back(timeOf([&] { competitor.prepare(meshes_, question); }));
    }
  }
  std::vector<Row> rows;
  for (std::size_t i = 0; i < count; ++i) {
    if (prepare_us[i].empty()) continue;
    Row row = rowOf(entrants_[i], scenario, Query::kPrepare);
    row.median_us = median(prepare_us[i]);
    row.min_us = minimum(prepare_us[i]);
    if (!reference_us.empty()) row.ratio_to_fcl_obbrss = medianRatio(reference_us, prepare_us[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Contest::refitRows(const std::string& scenario,
                                    const std::vector<scenes::Mesh>& before, Refit how,
                                    const Question& question) {
  const std::size_t count = entrants_.size();
  std::vector<std::vector<double>> refit_us(count);
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (std::size_t turn = 0; turn < count; ++turn) {
      const std::size_t i = (turn + repeat) % count;
      Competitor& competitor = *entrants_[i].competitor;
      if (!competitor.serves(Query::kRefit)) continue;
      competitor.load(before);
      std::vector<double> answer(1);  // as it would have been asked before, too
      competitor.answer(Query::kDistance, {question}, 0, 1, answer);
      refit_us[i].push_back(timeOf([&] { competitor.refit(meshes_, how, question); }));
    }
  }
  const auto obbrss = std::find_if(entrants_.begin(), entrants_.end(),
                                   [&](const Entrant& entrant) { return &entrant == reference(); });
  std::vector<Row> rows;
  for (std::size_t i = 0; i < count; ++i) {
    if (refit_us[i].empty()) continue;
    Row row = rowOf(entrants_[i], scenario, Query::kRefit);
    row.median_us = median(refit_us[i]);
    row.min_us = minimum(refit_us[i]);
    if (obbrss != entrants_.end()) {
      row.ratio_to_fcl_obbrss =
          medianRatio(refit_us[static_cast<std::size_t>(obbrss - entrants_.begin())], refit_us[i]);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Contest::queryRows(const Task& task) {
  if (task.questions.empty()) return {};
  std::vector<Lane> lanes;
  std::vector<const Entrant*> servers;
  for (const Entrant& entrant : entrants_) {
    if (!entrant.competitor->serves(task.query)) continue;
    servers.push_back(&entrant);
    lanes.push_back({entrant.competitor.get(), std::vector<double>(task.questions.size()), {}});
  }

  // Whatever models leave to their first query belongs to no repeat.
  for (Lane& lane : lanes) {
    lane.competitor->answer(task.query, task.questions, 0, task.questions.size(), lane.answers);
  }
  timeRepeats(task, options_.repeats, lanes);

  const auto reference_lane = std::find_if(lanes.begin(), lanes.end(), [](const Lane& lane) {
    return std::string(lane.competitor->name()) == kReference;
  });
  const Verdicts verdicts = judge(
      [this](std::size_t a, std::size_t b) -> const scenes::MeshOracle& { return oracle(a, b); },
      task.query, task.questions, options_.oracle_frames);
  const auto frames = static_cast<double>(task.frames);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    Row row = rowOf(*servers[i], task.scenario, task.query);
    row.frames = task.frames;
    row.threshold = task.threshold;
    row.median_us = median(lane.repeat_us);
    row.min_us = minimum(lane.repeat_us);
    if (task.questions.size() > task.frames) {
      row.skipped_pairs = 0;
      row.total_pairs = task.questions.size();
    }
    if (reference_lane != lanes.end()) {
      row.ratio_to_fcl_obbrss = medianRatio(reference_lane->repeat_us, lane.repeat_us);
    }
    if (task.query != Query::kCollide) {
      row.rel_err = 0;
      row.abs_err = 0;
    }
    compare(lane.answers, verdicts, task.query, task.questions, extent_, row);
    const TestCounts counts = lane.competitor->count(task.query, task.questions);
    row.bv_tests = static_cast<double>(counts.bv_tests) / frames;
    row.leaf_tests = static_cast<double>(counts.leaf_tests) / frames;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::map<std::string, std::vector<double>> Contest::frameTimes(const Task& task) {
  const std::size_t pairs = task.questions.size() / task.frames;
  std::vector<double> answers(task.questions.size());
  std::map<std::string, std::vector<double>> best;
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    for (Entrant& entrant : entrants_) {
      if (!entrant.competitor->serves(task.query)) continue;
      std::vector<double>& frames = best[entrant.competitor->name()];
      frames.resize(task.frames, std::numeric_limits<double>::infinity());
      for (std::size_t frame = 0; frame < task.frames; ++frame) {
        const double us = timeOf([&] {
          entrant.competitor->answer(task.query, task.questions, frame * pairs, (frame + 1) * pairs,
                                     answers);
        });
        frames[frame] = std::min(frames[frame], us);
      }
    }
  }
  return best;
}

}  // namespace kios::bench
