// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// MotionBenchMaker's problems: one planner over three ways to tell whether an edge is free.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <random>

#include "fcl_kios/fcl_kios.h"
#include "mbm_problems.h"
#include "obbrss_cell.h"
#include "rrt_connect.h"
#include "sampled_edge.h"
#include "scenario.h"
#include "scenes/placement.h"

namespace kios::bench {
namespace {

namespace fs = std::filesystem;
using Eigen::VectorXd;

enum Way { kProven, kSampled, kObbrss, kWays };
constexpr const char* kNames[kWays] = {"kios", "sampled_kios", "fcl_obbrss"};

/// What one way made of the problems of one kind.
struct Tally {
  std::vector<double> seconds = {};  ///< of all problems, the budget where it ran out
  std::vector<double> solved = {};   ///< of those that were solved
  /// Edges that were called free and are in contact, by the exact test and by FCL.
  long long wrong = 0;

  void add(const Tally& other) {
    seconds.insert(seconds.end(), other.seconds.begin(), other.seconds.end());
    solved.insert(solved.end(), other.solved.begin(), other.solved.end());
    wrong += other.wrong;
  }
};

/// The problems of one kind, or all.
struct Kind {
  int in_contact = 0;
  Tally ways[kWays];

  void add(const Kind& other) {
    in_contact += other.in_contact;
    for (int way = 0; way < kWays; ++way) ways[way].add(other.ways[way]);
  }
};

class Planning {
 public:
  Planning(const Robot& bare, const Options& options) : bare_(bare), options_(options) {}

  void solve(const Problem& problem, std::uint64_t seed, Kind& kind) {
    Robot robot = bare_;
    robot.addScene(problem.scene.string());
    if (robot.contact(problem.start) || robot.contact(problem.goal)) {
      ++kind.in_contact;
      return;
    }
    ObbrssCell obbrss(robot, models_);
    const auto is_free = [&](const VectorXd& q) { return !robot.contact(q); };
    const auto is_free_by_fcl = [&](const VectorXd& q) { return obbrss.isFree(q); };
    const IsFreeEdge ways[kWays] = {[&](const VectorXd& q0, const VectorXd& q1) {
                                      return robot.checkMotion(q0, q1).verdict ==
                                             MotionVerdict::kClear;
                                    },
                                    [&](const VectorXd& q0, const VectorXd& q1) {
                                      return sampleInContact(is_free, q0, q1).size() == 0;
                                    },
                                    [&](const VectorXd& q0, const VectorXd& q1) {
                                      return sampleInContact(is_free_by_fcl, q0, q1).size() == 0;
                                    }};
    PlanRequest request;
    request.start = problem.start;
    request.goal = problem.goal;
    request.lower = robot.lower().cwiseMax(-2 * scenes::kPi);
    request.upper = robot.upper().cwiseMin(2 * scenes::kPi);
    request.seconds = options_.quick ? 0.2 : 2;
    request.seed = seed;
    const bool alone = std::count(options_.bvs.begin(), options_.bvs.end(), kNames[kObbrss]) == 0;
    for (int way = 0; way < (alone ? kSampled : kWays); ++way) {
      Tally& tally = kind.ways[way];
      const Plan plan = rrtConnect(request, ways[way]);
      tally.seconds.push_back(plan.seconds);
      if (plan.solved) tally.solved.push_back(plan.seconds);
      if (!plan.solved && way == kProven) std::printf("no plan for %s\n", problem.name.c_str());
      for (const auto& [q0, q1] : plan.free_edges) {
        const VectorXd q =
            way == kProven ? sampleInContact(is_free_by_fcl, q0, q1) : contactOn(robot, q0, q1);
        tally.wrong += q.size() > 0 && !is_free(q) && !is_free_by_fcl(q) ? 1 : 0;
      }
    }
  }

 private:
  /// A configuration of the path that is in contact, if the proof finds one.
  static VectorXd contactOn(const Robot& robot, const VectorXd& q0, const VectorXd& q1) {
    const RobotMotion motion = robot.checkMotion(q0, q1);
    if (motion.verdict != MotionVerdict::kContact) return {};
    return motion.to == 1 ? q1 : VectorXd(q0 + motion.to * (q1 - q0));
  }

  const Robot& bare_;
  const Options& options_;
  ObbrssModels models_;
};

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<Row> rowsOf(const std::string& scenario, const Kind& kind) {
  std::vector<Row> rows;
  const auto& theirs = kind.ways[kObbrss].seconds;
  const double base = theirs.empty() ? 0 : median(theirs);
  for (int way = 0; way < kWays; ++way) {
    const Tally& tally = kind.ways[way];
    if (tally.seconds.empty()) continue;
    const double middle = median(tally.seconds);
    Row row = baseRow(scenario, "plan", tally.seconds.size());
    row.bv = kNames[way];
    row.times.median_us = 1e6 * middle;
    row.times.min_us = 1e6 * *std::min_element(tally.seconds.begin(), tally.seconds.end());
    if (middle > 0 && base > 0) row.times.ratio_to_fcl_obbrss = base / middle;
    // The samples of a competitor miss contacts, which is no fault of ours.
    row.errors.wrong = static_cast<std::size_t>(tally.wrong);
    row.plans.solved = tally.solved.size();
    row.plans.in_contact = static_cast<std::size_t>(kind.in_contact);
    row.plans.mean_us = 1e6 * mean(tally.seconds);
    rows.push_back(row);
  }
  return rows;
}

/// The robot among a problem's obstacles, as each competitor knows it.
struct Place {
  Robot robot;
  std::unique_ptr<ObbrssCell> obbrss;
};

using Ask = std::function<void(const Place& place, const Eigen::MatrixXd& configurations)>;

/// Asks each place about all its configurations.
std::vector<Row> rowsOf(const std::string& scenario, const char* query,
                        const std::vector<std::pair<const Place*, Eigen::MatrixXd>>& places,
                        const std::vector<std::pair<const char*, Ask>>& ways, bool wall_clock,
                        const Options& options) {
  std::vector<Competitor> competitors;
  for (const auto& [bv, ask] : ways) {
    competitors.push_back({bv, bench::each([&places, ask = ask](std::size_t i) {
                             ask(*places[i].first, places[i].second);
                           })});
  }
  Race race{places.size(), options.quick ? 1 : options.repeats, 1, 1, true, wall_clock};
  race.run(competitors);
  std::size_t count = 0;
  for (const auto& [place, q] : places) count += static_cast<std::size_t>(q.cols());
  const Row base = baseRow(scenario, query, count);
  std::vector<Row> rows;
  for (const Competitor& competitor : competitors) {
    rows.push_back(base.of(competitor, named("fcl_obbrss", competitors)));
  }
  return rows;
}

/// What single questions cost among the problems' obstacles: configurations at random, in contact
/// or not, one by one and all at once on all cores and on one; the clearance with its gradient.
void measureQuestions(const std::string& name, const Robot& bare,
                      const std::vector<Problem>& problems, const Options& options,
                      Report& report) {
  const int of_place = options.quick ? 500 : 10000;
  std::vector<std::unique_ptr<Place>> places;
  ObbrssModels models;
  for (const Problem& problem : problems) {
    places.push_back(std::unique_ptr<Place>(new Place{bare, nullptr}));
    places.back()->robot.addScene(problem.scene.string());
    places.back()->obbrss = std::make_unique<ObbrssCell>(places.back()->robot, models);
    if (places.size() == 14) break;  // two of each kind
  }
  const VectorXd lower = bare.lower().cwiseMax(-2 * scenes::kPi),
                 upper = bare.upper().cwiseMin(2 * scenes::kPi);
  std::mt19937_64 random(options.seed);
  std::vector<std::pair<const Place*, Eigen::MatrixXd>> all, some, clear;
  for (const auto& place : places) {
    Eigen::MatrixXd drawn(bare.coordinates(), of_place);
    for (auto q : drawn.colwise()) {
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        q[k] = std::uniform_real_distribution<double>(lower[k], upper[k])(random);
      }
    }
    Eigen::MatrixXd free(bare.coordinates(), 0);
    for (int i = 0; i < of_place / 12; ++i) {
      if (place->robot.contact(drawn.col(i))) continue;
      free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      free.rightCols(1) = drawn.col(i);
    }
    some.emplace_back(place.get(), drawn.leftCols(of_place / 12));
    clear.emplace_back(place.get(), std::move(free));
    all.emplace_back(place.get(), std::move(drawn));
  }
  const auto each = [](const auto& ask) {
    return [ask](const Place& place, const Eigen::MatrixXd& q) {
      for (Eigen::Index i = 0; i < q.cols(); ++i) ask(place, q.col(i));
    };
  };
  const auto obbrss = each([](const Place& at, const VectorXd& q) { at.obbrss->isFree(q); });
  const std::string scenario = "mbm/" + name;
  report.add(
      rowsOf(scenario + "/configurations", "collide", some,
             {{"kios", each([](const Place& at, const VectorXd& q) { (void)at.robot.contact(q); })},
              {"fcl_obbrss", obbrss}},
             false, options));
  report.add(rowsOf(
      scenario + "/batches", "collide", all,
      {{"kios", [](const Place& at, const Eigen::MatrixXd& q) { (void)at.robot.contacts(q); }},
       {"kios_one_thread",
        [](const Place& at, const Eigen::MatrixXd& q) { (void)at.robot.contacts(q, 1); }},
       {"fcl_obbrss", obbrss}},
      true, options));
  report.add(rowsOf(
      scenario + "/free", "gradient", clear,
      {{"kios", each([](const Place& at, const VectorXd& q) { (void)at.robot.clearance(q); })}},
      false, options));
  // Free edges, both ends in a column, beside a contact's question about the first one.
  const Eigen::Index n = bare.coordinates();
  std::normal_distribution<double> normal;
  for (const char* const length : {"0.05", "0.2", "0.8"}) {
    std::vector<std::pair<const Place*, Eigen::MatrixXd>> edges;
    for (const auto& [place, starts] : clear) {
      Eigen::MatrixXd ends(2 * n, 0);
      for (const VectorXd start : starts.colwise()) {
        const VectorXd way = VectorXd::NullaryExpr(n, [&] { return normal(random); });
        const VectorXd end = start + std::stod(length) * way.normalized();
        if (place->robot.checkMotion(start, end).verdict != MotionVerdict::kClear) continue;
        ends.conservativeResize(Eigen::NoChange, ends.cols() + 1);
        ends.rightCols(1) << start, end;
      }
      edges.emplace_back(place, std::move(ends));
    }
    const auto edge = each([n](const Place& at, const VectorXd& q) {
      (void)at.robot.checkMotion(q.head(n), q.tail(n));
    });
    const auto start =
        each([n](const Place& at, const VectorXd& q) { (void)at.robot.contact(q.head(n)); });
    report.add(rowsOf(scenario + "/edges/" + length, "motion", edges,
                      {{"kios", edge}, {"kios_contact", start}}, false, options));
  }
}

void planAll(const std::string& name, const fs::path& folder, const Options& options,
             Report& report) {
  const std::size_t wanted = options.frames > 0 ? options.frames : options.quick ? 7 : 70;
  const Unpacked unpacked(folder / "problems.tar.bz2");
  const Robot bare =
      loadRobot((folder / (name + ".urdf")).string(), (folder / (name + ".srdf")).string());
  std::map<std::string, Kind> kinds;
  Planning planning(bare, options);
  std::uint64_t seed = options.seed;
  const auto problems = readProblems(unpacked.path() / "problems", bare, wanted);
  for (const Problem& problem : problems) {
    planning.solve(problem, seed++, kinds[problem.name.substr(0, problem.name.find('/'))]);
  }
  Kind all;
  for (const auto& [kind_name, kind] : kinds) {
    report.add(rowsOf("mbm/" + kind_name, kind));
    all.add(kind);
  }
  report.add(rowsOf("mbm/" + name, all));
  measureQuestions(name, bare, problems, options, report);
}

}  // namespace

void runMbm(const Options& options, Report& report) {
  const auto data = findData(options);
  if (!data || !fs::exists(*data / "mbm")) {
    throw Skipped(
        "it needs MotionBenchMaker's robots and problems in DATA/mbm; name DATA by --data");
  }
  for (const char* const name : {"panda", "ur5"}) {
    if (wanted(options, name)) planAll(name, *data / "mbm" / name, options, report);
  }
}

}  // namespace kios::bench
