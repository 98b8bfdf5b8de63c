// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "contest.h"
#include "error_competitor.h"
#include "scenario.h"
#include "scenes/arms.h"
#include "scenes/oracle.h"
#include "scenes/pqp_data.h"
#include "scenes/shapes.h"
#include "timing.h"

namespace kios::bench {
namespace {

constexpr int kFrames = 300;
constexpr int kQuickFrames = 20;
constexpr std::size_t kBlock = 512;
constexpr double kWarmUp_us = 2000;  // untimed, so that no lane pays for what others left in caches

constexpr double kErrors[] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5};
constexpr long long kBudgets[] = {8, 16, 32, 64, 128, 256};
constexpr double kThresholds[] = {0.1, 0.5, 0.9, 0.99, 1.01, 1.1, 2, 10};

const char* name(ErrorSetting::Query query) {
  switch (query) {
    case ErrorSetting::kDistance:
      return "distance";
    case ErrorSetting::kBracket:
      return "bracket";
    case ErrorSetting::kBudget:
      return "budget";
    case ErrorSetting::kThreshold:
      return "threshold";
  }
  return "";
}

std::vector<ErrorSetting> distanceSettings() {
  std::vector<ErrorSetting> settings;
  for (const auto query : {ErrorSetting::kDistance, ErrorSetting::kBracket}) {
    settings.push_back({query, 0, 0, {}, {}});
    for (const double e : kErrors) settings.push_back({query, e, 0, {}, {}});
    for (const double e : kErrors) settings.push_back({query, 0, e, {}, {}});
  }
  for (const long long n : kBudgets) settings.push_back({ErrorSetting::kBudget, 0, 0, n, {}});
  return settings;
}

std::vector<ErrorSetting> thresholdSettings() {
  std::vector<ErrorSetting> settings = {ErrorSetting()};  // what the ratios are to
  for (const double f : kThresholds) settings.push_back({ErrorSetting::kThreshold, 0, 0, {}, f});
  return settings;
}

// A competitor at a setting.
struct Lane {
  ErrorCompetitor* competitor;
  ErrorSetting setting;
  std::vector<ErrorAnswer> answers;
  std::vector<double> repeat_us;  // per frame
};

void warmUp(const std::vector<ErrorQuestion>& questions, std::size_t begin, std::size_t end,
            Lane& lane) {
  constexpr std::size_t kAtOnce = 16;
  const double start = nowMicroseconds();
  while (begin < end && nowMicroseconds() - start < kWarmUp_us) {
    const std::size_t next = std::min(begin + kAtOnce, end);
    lane.competitor->answer(lane.setting, questions, begin, next, lane.answers);
    begin = next;
  }
}

// All lanes take turns at blocks of frames, each block with another one first.
void timeLanes(const std::vector<ErrorQuestion>& questions, int repeats, std::vector<Lane>& lanes) {
  for (int repeat = -1; repeat < repeats; ++repeat) {  // the first warms up
    for (Lane& lane : lanes) lane.repeat_us.push_back(0);
    for (std::size_t begin = 0, block = 0; begin < questions.size(); begin += kBlock, ++block) {
      const std::size_t end = std::min(begin + kBlock, questions.size());
      for (std::size_t turn = 0; turn < lanes.size(); ++turn) {
        Lane& lane = lanes[(turn + block + static_cast<std::size_t>(repeat + 1)) % lanes.size()];
        warmUp(questions, begin, end, lane);
        const double start = nowMicroseconds();
        lane.competitor->answer(lane.setting, questions, begin, end, lane.answers);
        lane.repeat_us.back() += nowMicroseconds() - start;
      }
    }
    if (repeat < 0) {
      for (Lane& lane : lanes) lane.repeat_us.clear();
    } else {
      for (Lane& lane : lanes) lane.repeat_us.back() /= static_cast<double>(questions.size());
    }
  }
}

// Errors, widths and wrong answers: a threshold on the wrong side, an error beyond what was asked
// for, a bracket that misses.
void judge(const std::vector<ErrorQuestion>& questions, const Lane& lane, Row& row) {
  const ErrorSetting& setting = lane.setting;
  const double rounding = 1e-14 * row.extent;
  double sum = 0, rel_sum = 0, max = 0, rel_max = 0, width = 0;
  std::size_t apart = 0, wrong = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const double exact = questions[i].distance;
    const auto& [lower, upper] = lane.answers[i];
    if (setting.threshold) {
      if ((upper == 0) != (*setting.threshold > 1)) ++wrong;
      continue;
    }
    const double allowed = std::max(setting.rel_err * exact, setting.abs_err) + rounding;
    const bool beyond = !setting.budget && !(upper - exact <= allowed);
    if (beyond || upper < exact - rounding || lower > exact) ++wrong;
    const double error = std::abs(upper - exact);
    sum += error;
    max = std::max(max, error);
    width += upper - lower;
    if (exact == 0) continue;
    ++apart;
    rel_sum += error / exact;
    rel_max = std::max(rel_max, error / exact);
  }
  row.wrong_verdicts = wrong;
  if (setting.threshold) return;
  row.max_abs_error = max;
  row.mean_abs_error = sum / static_cast<double>(questions.size());
  if (std::isfinite(width)) row.bracket_width = width / static_cast<double>(questions.size());
  if (apart == 0) return;
  row.max_rel_error = rel_max;
  row.mean_rel_error = rel_sum / static_cast<double>(apart);
}

constexpr char kLine[] = "%-20s %-9s %-11s %7s %7s %7s %10s %9s %10s %10s %10s %6s\n";

std::string cell(const std::optional<double>& value, const char* format) {
  if (!value || !std::isfinite(*value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

void print(const std::vector<Row>& rows) {
  std::printf(kLine, "scenario", "query", "bv", "rel_err", "abs_err", "at", "median_us", "x OBBRSS",
              "mean err", "mean rel", "width", "wrong");
  for (const Row& row : rows) {
    const std::optional<double> at = row.budget ? row.budget : row.threshold;
    std::printf(kLine, row.scenario.c_str(), row.query.c_str(), row.bv.c_str(),
                cell(row.rel_err, "%g").c_str(), cell(row.abs_err, "%g").c_str(),
                cell(at, "%g").c_str(), cell(row.median_us, "%.3f").c_str(),
                cell(row.ratio_to_fcl_obbrss, "%.2f").c_str(),
                cell(row.mean_abs_error, "%.2e").c_str(), cell(row.mean_rel_error, "%.2e").c_str(),
                cell(row.bracket_width, "%.2e").c_str(),
                std::to_string(row.wrong_verdicts.value_or(0)).c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

Row rowOf(const std::string& scenario, const Lane& lane, const Lane& reference) {
  Row row;
  const ErrorSetting& setting = lane.setting;
  row.scenario = scenario;
  row.query = name(setting.query);
  row.bv = lane.competitor->name();
  if (!setting.threshold) {
    row.rel_err = setting.rel_err;
    row.abs_err = setting.abs_err;
  }
  row.threshold = setting.threshold;
  if (setting.budget) row.budget = static_cast<double>(*setting.budget);
  row.median_us = median(lane.repeat_us);
  row.min_us = *std::min_element(lane.repeat_us.begin(), lane.repeat_us.end());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < lane.repeat_us.size(); ++i) {
    ratios.push_back(reference.repeat_us[i] / lane.repeat_us[i]);
  }
  row.ratio_to_fcl_obbrss = median(std::move(ratios));
  return row;
}

class ErrorContest {
 public:
  ErrorContest(std::string scenario, scenes::MovingPair pair, const Options& options)
      : scenario_(std::move(scenario)), pair_(std::move(pair)), options_(options) {
    const auto add = [this](std::unique_ptr<ErrorCompetitor> competitor) {
      competitor->load(pair_.a, pair_.b);
      competitors_.push_back(std::move(competitor));
    };
    add(makeObbrssErrorCompetitor());  // the reference, whatever is asked for
    const auto wanted = [&options](const char* bv) {
      return std::find(options.bvs.begin(), options.bvs.end(), bv) != options.bvs.end();
    };
    if (wanted("fcl_rss")) add(makeRssErrorCompetitor());
    if (wanted("kios")) add(makeKiosErrorCompetitor());
  }

  void run(Report& report) {
    const int frames = options_.quick ? kQuickFrames : kFrames;
    const scenes::MeshOracle oracle(pair_.a, pair_.b);
    std::vector<ErrorQuestion> all, apart;
    for (const scenes::Frame& f :
         evenlyChosen(pair_.frames, options_.frames > 0 ? options_.frames : frames)) {
      all.push_back({f, oracle.distance(f.X_WA, f.X_WB)});
      if (all.back().distance > 0) apart.push_back(all.back());
    }
    runSettings(distanceSettings(), all, report);
    if (!apart.empty()) runSettings(thresholdSettings(), apart, report);
  }

 private:
  void runSettings(const std::vector<ErrorSetting>& settings,
                   const std::vector<ErrorQuestion>& questions, Report& report) {
    std::vector<Lane> lanes;
    for (const ErrorSetting& setting : settings) {
      for (const auto& competitor : competitors_) {
        if (!competitor->serves(setting)) continue;
        lanes.push_back(
            {competitor.get(), setting, std::vector<ErrorAnswer>(questions.size()), {}});
      }
    }
    timeLanes(questions, options_.repeats, lanes);
    std::vector<Row> rows;
    for (const Lane& lane : lanes) {
      Row row = rowOf(scenario_, lane, lanes.front());
      row.triangles = pair_.a.triangles.size() + pair_.b.triangles.size();
      row.frames = questions.size();
      row.seed = options_.seed;
      row.extent = std::max(scenes::extent(pair_.a), scenes::extent(pair_.b));
      judge(questions, lane, row);
      if (lane.setting.query != ErrorSetting::kDistance || !isThresholds(settings)) {
        rows.push_back(std::move(row));
      }
    }
    print(rows);
    report.addUnprinted(rows);
  }

  static bool isThresholds(const std::vector<ErrorSetting>& settings) {
    return settings.back().threshold.has_value();
  }

  const std::string scenario_;
  const scenes::MovingPair pair_;
  const Options options_;
  std::vector<std::unique_ptr<ErrorCompetitor>> competitors_;
};

// The forearms of two arms that face each other.
scenes::MovingPair forearms(std::uint64_t seed) {
  constexpr int kMotionFrames = 1200;
  constexpr std::size_t kForearm = 4;
  const scenes::Arm arm = scenes::cadArm();
  fcl::Transform3d X_W2 = fcl::Transform3d::Identity();
  X_W2.linear() = fcl::Vector3d(-1, -1, 1).asDiagonal();
  X_W2.translation().x() = 0.7;
  const auto motion_1 = scenes::armMotion(arm, kMotionFrames, 2 * seed);
  const auto motion_2 = scenes::armMotion(arm, kMotionFrames, 2 * seed + 1);
  scenes::MovingPair pair{arm.links[kForearm].mesh, arm.links[kForearm].mesh, {}};
  for (int i = 0; i < kMotionFrames; ++i) {
    const auto poses_1 = scenes::linkPoses(arm, fcl::Transform3d::Identity(), motion_1[i]);
    const auto poses_2 = scenes::linkPoses(arm, X_W2, motion_2[i]);
    pair.frames.push_back({poses_1[kForearm], poses_2[kForearm]});
  }
  return pair;
}

}  // namespace

void runError(const Options& options, Report& report) {
  constexpr int kMotionFrames = 1200;
  const auto run = [&](const char* scene, scenes::MovingPair pair) {
    ErrorContest(std::string("error/") + scene, std::move(pair), options).run(report);
  };
  run("generated",
      {scenes::bentTorus(), scenes::knobbyTorus(), scenes::fallingMotion(kMotionFrames)});
  run("generated_spinning",
      {scenes::bumpyBlob(), scenes::bentTorus(), scenes::spinningMotion(kMotionFrames)});
  run("robots", forearms(options.seed));
  if (const auto data = findData(options)) {
    run("falling", scenes::loadFalling(*data));
    run("spinning", scenes::loadSpinning(*data, 5000));
  } else {
    std::printf(
        "error/falling and error/spinning are left out: name the folder of their data by "
        "--data or KIOS_DATA\n");
  }
}

}  // namespace kios::bench
