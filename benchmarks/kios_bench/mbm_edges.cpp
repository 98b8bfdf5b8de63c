// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mbm_edges.h"

#include <algorithm>
#include <memory>
#include <random>

#include "obbrss_cell.h"
#include "race.h"
#include "sampled_edge.h"

namespace kios::bench {
namespace {

using Eigen::VectorXd;

/// The robot among a problem's obstacles, as each competitor knows it.
struct Place {
  Robot robot;
  std::unique_ptr<ObbrssCell> obbrss;
};

/// A path, or with q1 empty a configuration.
struct Question {
  const Place* place;
  VectorXd q0, q1;
};

class Draw {
 public:
  Draw(const Robot& robot, std::uint64_t seed)
      : lower_(robot.lower().cwiseMax(-6.3)), upper_(robot.upper().cwiseMin(6.3)), random_(seed) {}

  VectorXd configuration() {
    VectorXd q(lower_.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) q[k] = uniform(lower_[k], upper_[k]);
    return q;
  }
  VectorXd step(double length) {
    VectorXd d(lower_.size());
    for (double& x : d) x = uniform(-1, 1);
    return d * (length / d.lpNorm<Eigen::Infinity>());
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  VectorXd lower_, upper_;
  std::mt19937_64 random_;
};

using Answer = std::function<void(const Question&)>;

void addRows(const std::string& scenario, const char* query,
             const std::vector<Competitor>& competitors, std::size_t frames, const Options& options,
             Report& report) {
  Row row;
  row.scenario = scenario;
  row.query = query;
  row.frames = frames;
  row.seed = options.seed;
  std::vector<Row> rows;
  for (const Competitor& competitor : competitors) {
    rows.push_back(row.of(competitor, named("fcl_obbrss", competitors)));
  }
  report.add(rows);
}

void race(const std::string& scenario, const char* query, const std::vector<Question>& questions,
          const std::vector<std::pair<const char*, Answer>>& ways, const Options& options,
          Report& report) {
  if (questions.empty()) return;
  std::vector<Competitor> competitors;
  for (const auto& [bv, answer] : ways) {
    Competitor competitor;
    competitor.name = bv;
    competitor.answer = [&questions, answer = answer](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) answer(questions[i]);
    };
    competitors.push_back(std::move(competitor));
  }
  Race race;
  race.questions = questions.size();
  race.repeats = options.quick ? 1 : options.repeats;
  race.block = race.step = 16;
  race.warm_up = true;
  race.run(competitors);
  addRows(scenario, query, competitors, questions.size(), options, report);
}

/// Each place's configurations at once, on all cores and on one.
void raceBatches(const std::string& scenario,
                 const std::vector<std::pair<const Place*, Eigen::MatrixXd>>& batches,
                 const Options& options, Report& report) {
  using Contacts = std::function<void(const Place&, const Eigen::MatrixXd&)>;
  const std::pair<const char*, Contacts> ways[] = {
      {"kios", [](const Place& place, const Eigen::MatrixXd& q) { place.robot.contacts(q); }},
      {"kios_one_thread",
       [](const Place& place, const Eigen::MatrixXd& q) { place.robot.contacts(q, 1); }},
      {"fcl_obbrss", [](const Place& place, const Eigen::MatrixXd& q) {
         for (Eigen::Index i = 0; i < q.cols(); ++i) place.obbrss->isFree(q.col(i));
       }}};
  std::vector<Competitor> competitors;
  for (const auto& [bv, answer] : ways) {
    Competitor competitor;
    competitor.name = bv;
    competitor.answer = [&batches, answer = answer](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) answer(*batches[i].first, batches[i].second);
    };
    competitors.push_back(std::move(competitor));
  }
  Race race;
  race.questions = batches.size();
  race.repeats = options.quick ? 1 : options.repeats;
  race.block = race.step = 1;
  race.warm_up = race.wall_clock = true;
  race.run(competitors);
  std::size_t frames = 0;
  for (const auto& batch : batches) frames += static_cast<std::size_t>(batch.second.cols());
  addRows(scenario, "collide", competitors, frames, options, report);
}

bool isClear(const Question& edge) {
  return edge.place->robot.checkMotion(edge.q0, edge.q1).verdict == MotionVerdict::kClear;
}

}  // namespace

void measureQuestions(const std::string& name, const Robot& bare,
                      const std::vector<Problem>& problems, const Options& options,
                      Report& report) {
  constexpr double kLengths[] = {0.05, 0.2, 0.8};
  const int of_place = options.quick ? 2 : 40;
  std::vector<std::unique_ptr<Place>> places;
  ObbrssModels models;
  for (const Problem& problem : problems) {
    places.push_back(std::unique_ptr<Place>(new Place{bare, nullptr}));
    places.back()->robot.addScene(problem.scene.string());
    places.back()->obbrss = std::make_unique<ObbrssCell>(places.back()->robot, models);
    if (places.size() == 14) break;  // two of each kind
  }
  const auto is_free = [](const Place& place) {
    return [&place](const VectorXd& q) { return !place.robot.contact(q); };
  };
  const auto is_free_by_fcl = [](const Place& place) {
    return [&place](const VectorXd& q) { return place.obbrss->isFree(q); };
  };
  const std::vector<std::pair<const char*, Answer>> edge_ways = {
      {"kios", [](const Question& edge) { isClear(edge); }},
      {"sampled_kios",
       [&](const Question& edge) { sampleInContact(is_free(*edge.place), edge.q0, edge.q1); }},
      {"fcl_obbrss", [&](const Question& edge) {
         sampleInContact(is_free_by_fcl(*edge.place), edge.q0, edge.q1);
       }}};
  Draw draw(bare, options.seed);
  for (const double length : kLengths) {
    std::vector<Question> free, blocked;
    for (const auto& place : places) {
      for (int i = 0; i < of_place; ++i) {
        Question edge{place.get(), {}, {}};
        do {
          edge.q0 = draw.configuration();
        } while (!is_free(*place)(edge.q0));
        edge.q1 = edge.q0 + draw.step(length);
        (isClear(edge) ? free : blocked).push_back(std::move(edge));
      }
    }
    const std::string text = cell(length, "%g");
    race("mbm/" + name + "/free/" + text, "motion", free, edge_ways, options, report);
    race("mbm/" + name + "/blocked/" + text, "motion", blocked, edge_ways, options, report);
  }
  std::vector<Question> configurations, clear;
  std::vector<std::pair<const Place*, Eigen::MatrixXd>> batches;
  for (const auto& place : places) {
    batches.emplace_back(place.get(), Eigen::MatrixXd(bare.coordinates(), 250 * of_place));
    for (auto q : batches.back().second.colwise()) q = draw.configuration();
    for (int i = 0; i < 20 * of_place; ++i) {
      Question question{place.get(), draw.configuration(), {}};
      if (is_free(*place)(question.q0)) clear.push_back(question);
      configurations.push_back(std::move(question));
    }
  }
  race("mbm/" + name + "/configurations", "collide", configurations,
       {{"kios", [&](const Question& at) { is_free (*at.place)(at.q0); }},
        {"fcl_obbrss", [&](const Question& at) { is_free_by_fcl (*at.place)(at.q0); }}},
       options, report);
  raceBatches("mbm/" + name + "/batches", batches, options, report);
  race("mbm/" + name + "/free", "gradient", clear,
       {{"kios", [&](const Question& at) { at.place->robot.clearance(at.q0); }}}, options, report);
}

}  // namespace kios::bench
