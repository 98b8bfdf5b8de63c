// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>
#include <fcl_kios/fcl_kios.h>

#include "contest.h"
#include "fcl_models.h"
#include "scenario.h"

namespace kios::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kFrames = 300;
constexpr int kQuickFrames = 20;
constexpr std::size_t kBlock = 512;
constexpr double kWarmUp_us = 2000;  // untimed, so that none pays for what others left in caches

constexpr double kErrors[] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5};
constexpr double kBudgets[] = {8, 16, 32, 64, 128, 256};
constexpr double kThresholds[] = {0.1, 0.5, 0.9, 0.99, 1.01, 1.1, 2, 10};

/// A way to ask for a distance, and the error that it may have: at most one of the numbers is set;
/// none asks for the exact distance. kBracket, kBudget: kios::distanceBracket; kDistance:
/// fcl::distance, or FCL's node; kThreshold: is the pair nearer than a part of the exact distance
/// of each frame?
struct Setting {
  enum Query { kDistance, kBracket, kBudget, kThreshold };
  Query query = kDistance;
  Asked asked = {0, 0, {}, {}};
};

struct ErrorQuestion {
  scenes::Frame poses;
  double distance = 0;  // exact
};

/// Holds a bracket of the distance; without a lower bound where the query gives none. For
/// kThreshold the upper end is 0 if the pair is nearer than the threshold, infinity if not.
struct Bracket {
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = kInfinity;
};

/// Holds a volume with both meshes.
struct Way {
  const char* name;
  bool all_queries;  // or just kDistance and kThreshold
  std::function<Bracket(const Setting& setting, const ErrorQuestion& question)> answer;
};

/// Ours.
Way kiosWay(const scenes::MovingPair& pair) {
  const auto a = scenes::buildModel<kIOSd>(pair.a), b = scenes::buildModel<kIOSd>(pair.b);
  return {"kios", true, [a, b](const Setting& setting, const ErrorQuestion& question) -> Bracket {
            const auto& [X_WA, X_WB] = question.poses;
            const Asked& asked = setting.asked;
            Bracket bracket;
            if (setting.query == Setting::kDistance) {
              fcl::DistanceRequestd request;
              request.rel_err = *asked.rel_err;
              request.abs_err = *asked.abs_err;
              fcl::DistanceResultd result;
              bracket.upper = fcl::distance(a.get(), X_WA, b.get(), X_WB, request, result);
            } else if (setting.query == Setting::kThreshold) {
              const double threshold = *asked.threshold * question.distance;
              bracket.upper = closerThan(*a, X_WA, *b, X_WB, threshold) ? 0 : kInfinity;
            } else {
              DistanceBracketRequest<double> options;
              options.rel_err = *asked.rel_err;
              options.abs_err = *asked.abs_err;
              if (asked.budget) options.max_expansions = static_cast<long long>(*asked.budget);
              options.nearest_points = false;
              const auto answer = kios::distanceBracket(*a, X_WA, *b, X_WB, options);
              bracket = {answer.lower_bound, answer.distance};
            }
            return bracket;
          }};
}

/// Returns FCL's by its traversal node, whose error members FCL's own queries leave at 0. A node
/// stops at a pair that meets both of its errors: the one not asked for is infinite.
template <typename BV, typename Node>
Way nodeWay(const char* name, const scenes::MovingPair& pair) {
  const auto a = scenes::buildModel<BV>(pair.a), b = scenes::buildModel<BV>(pair.b);
  return {name, false, [a, b](const Setting& setting, const ErrorQuestion& question) -> Bracket {
            const Asked& asked = setting.asked;
            const bool relative = *asked.rel_err > 0, absolute = *asked.abs_err > 0;
            const fcl::DistanceRequestd request;
            fcl::DistanceResultd result;
            const double threshold = asked.threshold.value_or(kInfinity) * question.distance;
            if (asked.threshold) result.min_distance = threshold;
            Node node;
            start(node, *a, question.poses.X_WA, *b, question.poses.X_WB, request, result);
            node.rel_err = absolute ? kInfinity : *asked.rel_err;
            node.abs_err = relative ? kInfinity : *asked.abs_err;
            fcl::detail::distance(&node);
            Bracket bracket;
            bracket.upper = result.min_distance;
            if (asked.threshold) bracket.upper = result.min_distance < threshold ? 0 : kInfinity;
            return bracket;
          }};
}

std::vector<Setting> distanceSettings() {
  std::vector<Setting> settings;
  for (const auto query : {Setting::kDistance, Setting::kBracket}) {
    settings.push_back({query});
    for (const double e : kErrors) settings.push_back({query, {e, 0, {}, {}}});
    for (const double e : kErrors) settings.push_back({query, {0, e, {}, {}}});
  }
  for (const double n : kBudgets) settings.push_back({Setting::kBudget, {0, 0, {}, n}});
  return settings;
}

std::vector<Setting> thresholdSettings() {
  std::vector<Setting> settings = {Setting()};  // what the ratios are to
  for (const double f : kThresholds) settings.push_back({Setting::kThreshold, {0, 0, f, {}}});
  return settings;
}

// Errors, widths and wrong answers: a threshold on the wrong side, an error beyond what was asked
// for, a bracket that misses.
Errors judge(const std::vector<ErrorQuestion>& questions, const Asked& asked,
             const std::vector<Bracket>& answers, double extent) {
  const double rounding = 1e-14 * extent;
  double rel_sum = 0, rel_max = 0, max = 0, width = 0;
  std::size_t apart = 0, wrong = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const double exact = questions[i].distance;
    const auto& [lower, upper] = answers[i];
    if (asked.threshold) {
      if ((upper == 0) != (*asked.threshold > 1)) ++wrong;
      continue;
    }
    const double allowed = std::max(*asked.rel_err * exact, *asked.abs_err) + rounding;
    const bool beyond = !asked.budget && !(upper - exact <= allowed);
    if (beyond || upper < exact - rounding || lower > exact) ++wrong;
    const double error = std::abs(upper - exact);
    max = std::max(max, error);
    width += upper - lower;
    if (exact == 0) continue;
    ++apart;
    rel_sum += error / exact;
    rel_max = std::max(rel_max, error / exact);
  }
  Errors errors;
  errors.wrong = wrong;
  if (asked.threshold) return errors;
  errors.max_abs = max;
  if (std::isfinite(width)) errors.bracket_width = width / static_cast<double>(questions.size());
  if (apart == 0) return errors;
  errors.max_rel = rel_max;
  errors.mean_rel = rel_sum / static_cast<double>(apart);
  return errors;
}

/// Holds a way at a setting.
struct Entry {
  const Way* way;
  Setting setting;
  std::vector<Bracket> answers;
};

/// Every way at every setting that it serves, all in one race; ratios are to the first.
void reportSettings(Row base, const std::vector<Way>& ways, const std::vector<Setting>& settings,
                    const std::vector<ErrorQuestion>& questions, int repeats, Report& report) {
  std::vector<Entry> entries;
  for (const Setting& setting : settings) {
    for (const Way& way : ways) {
      const bool any = setting.query == Setting::kDistance || setting.query == Setting::kThreshold;
      if (!any && !way.all_queries) continue;
      entries.push_back({&way, setting, std::vector<Bracket>(questions.size())});
    }
  }
  std::vector<Competitor> competitors;
  for (Entry& entry : entries) {
    const auto answer = each(
        [&](std::size_t i) { entry.answers[i] = entry.way->answer(entry.setting, questions[i]); });
    const auto warm = [answer](std::size_t begin, std::size_t end) {
      const double start = nowMicroseconds();
      while (begin < end && nowMicroseconds() - start < kWarmUp_us) {
        const std::size_t next = std::min(begin + 16, end);
        answer(begin, next);
        begin = next;
      }
    };
    competitors.push_back({entry.way->name, answer, warm});
  }
  Race{questions.size(), repeats, kBlock, Race::kAll, true}.run(competitors);
  base.frames = questions.size();
  std::vector<Row> rows;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Setting& setting = entries[i].setting;
    if (setting.query == Setting::kDistance && settings.back().query == Setting::kThreshold) {
      continue;  // the reference alone
    }
    constexpr const char* kNames[] = {"distance", "bracket", "budget", "threshold"};
    Row row = base.of(competitors[i], &competitors.front());
    row.query = kNames[setting.query];
    row.asked = setting.asked;
    if (setting.asked.threshold) row.asked.rel_err = row.asked.abs_err = {};
    row.errors = judge(questions, setting.asked, entries[i].answers, base.extent);
    rows.push_back(std::move(row));
  }
  report.add(rows);
}

void reportPair(const std::string& scenario, const scenes::MovingPair& pair, const Options& options,
                Report& report) {
  const auto wanted = [&options](const char* bv) {
    return std::find(options.bvs.begin(), options.bvs.end(), bv) != options.bvs.end();
  };
  std::vector<Way> ways;
  // The reference, whatever is asked for.
  ways.push_back(
      nodeWay<fcl::OBBRSSd, fcl::detail::MeshDistanceTraversalNodeOBBRSSd>("fcl_obbrss", pair));
  if (wanted("fcl_rss")) {
    ways.push_back(nodeWay<fcl::RSSd, fcl::detail::MeshDistanceTraversalNodeRSSd>("fcl_rss", pair));
  }
  if (wanted("kios")) ways.push_back(kiosWay(pair));

  const int frames = options.quick ? kQuickFrames : kFrames;
  const scenes::MeshOracle oracle(pair.a, pair.b);
  std::vector<ErrorQuestion> all, apart;
  for (const scenes::Frame& f :
       evenlyChosen(pair.frames, options.frames > 0 ? options.frames : frames)) {
    all.push_back({f, oracle.distance(f.X_WA, f.X_WB)});
    if (all.back().distance > 0) apart.push_back(all.back());
  }
  const Row base = baseRow(scenario, "", 0, {pair.a, pair.b});
  reportSettings(base, ways, distanceSettings(), all, options.repeats, report);
  if (apart.empty()) return;
  reportSettings(base, ways, thresholdSettings(), apart, options.repeats, report);
}

// The forearms of two arms that face each other.
scenes::MovingPair forearms(std::uint64_t seed) {
  constexpr int kMotionFrames = 1200;
  constexpr std::size_t kForearm = 4;
  const scenes::Robot arm = scenes::cadArm();
  scenes::MovingPair pair{arm.links[kForearm].mesh, arm.links[kForearm].mesh, {}};
  for (const Question& question : robotQuestions(arm, scenes::facing(0.7), kMotionFrames, seed)) {
    if (question.a == kForearm && question.b == kForearm) pair.frames.push_back(question.poses);
  }
  return pair;
}

}  // namespace

void runError(const Options& options, Report& report) {
  const auto run = [&](const char* scene, const scenes::MovingPair& pair) {
    reportPair(std::string("error/") + scene, pair, options, report);
  };
  run("generated", generatedFalling());
  run("generated_spinning", generatedSpinning());
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
