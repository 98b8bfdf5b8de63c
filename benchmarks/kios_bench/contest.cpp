// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "contest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include "library.h"
#include "scenes/shapes.h"
#include "verdicts.h"

namespace kios::bench {
namespace {

// Large enough for the models to be in cache for most of a block even where a query takes 3 us; in
// frames where each asks many questions.
constexpr std::size_t kBlock = 256;
constexpr std::size_t kBlockFrames = 32;

constexpr int kGeneratedFrames = 1200;

constexpr char kReference[] = "fcl_obbrss";

/// Says what a planner does between the queries of two frames: other code, other data, other
/// branches.
void workElsewhere() {
  static std::vector<unsigned> data(1U << 20);  // 4 MB: twice what a core has for itself
  static unsigned state = 1;
  std::map<unsigned, std::string> words;
  for (std::size_t i = 0; i < data.size(); i += 16) {
    state = state * 1664525U + 1013904223U;
    data[i] += state;
    if (state >> 22 == 0) words[state] = std::to_string(0.1 * state);
  }
  std::sort(data.begin(), data.begin() + 4096);
  for (const auto& [key, word] : words) state += key ^ static_cast<unsigned>(word.size());
}

/// Leaves nothing else in the caches.
void stream(std::size_t bytes) {
  constexpr std::size_t kLine = 64;
  static std::vector<unsigned char> data;
  data.resize(std::max(data.size(), bytes));
  for (std::size_t i = 0; i < bytes; i += kLine) ++data[i];
}

/// Says how many answers have other bits, and how many differ by more than two that are each right
/// to 16 eps; numbers of contacts and verdicts in any case.
Changes changesOf(const std::vector<double>& before, const std::vector<double>& now) {
  constexpr double kTolerance = 32 * std::numeric_limits<double>::epsilon();
  Changes changes;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double difference = std::abs(now[i] - before[i]);
    changes.bits += now[i] != before[i] ? 1 : 0;
    changes.answers += difference > kTolerance * std::abs(before[i]) ? 1 : 0;
  }
  return changes;
}

void askOne(MeshSet& set, const Question& question) {
  std::vector<double> answer(1);
  set.answer(Query::kDistance, {question}, 0, 1, answer);
}

}  // namespace

scenes::DistanceFunction obbrssDistance(const scenes::Mesh& mesh) {
  return [model = scenes::buildModel<fcl::OBBRSSd>(mesh)](const scenes::Frame& frame) {
    fcl::DistanceResultd result;
    return fcl::distance<double>(model.get(), frame.X_WA, model.get(), frame.X_WB,
                                 fcl::DistanceRequestd(), result);
  };
}

std::vector<scenes::Frame> evenlyChosen(const std::vector<scenes::Frame>& frames, int count) {
  if (count == 0 || static_cast<std::size_t>(count) >= frames.size()) return frames;
  std::vector<scenes::Frame> chosen;
  chosen.reserve(count);
  for (int i = 0; i < count; ++i) chosen.push_back(frames[i * frames.size() / count]);
  return chosen;
}

std::vector<scenes::Frame> chosenFrames(const std::vector<scenes::Frame>& frames,
                                        const Options& options) {
  constexpr int kQuickFrames = 40;
  return evenlyChosen(frames, options.frames == 0 && options.quick ? kQuickFrames : options.frames);
}

scenes::MovingPair generatedFalling() {
  return {scenes::bentTorus(), scenes::knobbyTorus(), scenes::fallingMotion(kGeneratedFrames)};
}

scenes::MovingPair generatedSpinning() {
  return {scenes::bumpyBlob(), scenes::bentTorus(), scenes::spinningMotion(kGeneratedFrames)};
}

std::vector<Question> robotQuestions(const scenes::Robot& robot, const fcl::Transform3d& X_W2,
                                     int frames, std::uint64_t seed) {
  constexpr int kMotionFrames = 400;
  const int all = std::max(frames, kMotionFrames);
  const auto motion_1 = scenes::jointMotion(robot, all, true, 2 * seed);
  const auto motion_2 = scenes::jointMotion(robot, all, true, 2 * seed + 1);
  std::vector<Question> questions;
  for (int i = 0; i < frames; ++i) {
    const int frame = i * all / frames;
    const auto poses_1 = scenes::robotPoses(robot, fcl::Transform3d::Identity(), motion_1[frame]);
    const auto poses_2 = scenes::robotPoses(robot, X_W2, motion_2[frame]);
    for (std::size_t a = 0; a < poses_1.size(); ++a) {
      for (std::size_t b = 0; b < poses_2.size(); ++b) {
        questions.push_back({a, b, {poses_1[a], poses_2[b]}});
      }
    }
  }
  return questions;
}

Task pairTask(const std::string& scenario, Query query, const std::vector<scenes::Frame>& frames) {
  Task task{scenario, query, {}, frames.size()};
  for (const scenes::Frame& frame : frames) task.questions.push_back({0, 1, frame});
  return task;
}

Contest::Contest(std::vector<scenes::Mesh> meshes, const Options& options, Geometries others)
    : options_(options), meshes_(std::move(meshes)), others_(std::move(others)) {
  for (const std::string& bv : options.bvs) sets_[bv] = makeMeshSet(bv);
  builds_ = serving(Query::kBuild, [this](const std::string& bv, MeshSet& set) {
    return Competitor{bv, [this, &set](std::size_t, std::size_t) { set.build(meshes_); }};
  });
  Race{1, options_.repeats}.run(builds_);
  for (auto& [bv, set] : sets_) {
    set->load(meshes_);
    for (const auto& geometry : others_) set->add(geometry);
  }
}

template <typename Make>
std::vector<Competitor> Contest::serving(Query query, Make make) const {
  std::vector<Competitor> competitors;
  for (const std::string& bv : options_.bvs) {
    MeshSet& set = *sets_.at(bv);
    if (!set.serves(query)) continue;
    competitors.push_back(make(bv, set));
    competitors.back().rounds = roundsOf(bv);
  }
  return competitors;
}

const scenes::MeshOracle& Contest::oracle(std::size_t a, std::size_t b) {
  return oracles_.try_emplace({a, b}, meshes_[a], meshes_[b]).first->second;
}

double Contest::truthOf(Query query, const Question& question) {
  // All queries about distances have the same truth, hot and cold.
  const bool contacts = query == Query::kCollide || query == Query::kContacts;
  std::vector<double> key = {contacts ? 1.0 + static_cast<double>(query) : 0,
                             static_cast<double>(question.max_contacts),
                             static_cast<double>(question.a), static_cast<double>(question.b)};
  for (const fcl::Transform3d* X : {&question.poses.X_WA, &question.poses.X_WB}) {
    key.insert(key.end(), X->data(), X->data() + 16);
  }
  const auto [known, is_new] = truths_.try_emplace(std::move(key), 0);
  if (is_new) known->second = findTruth(query, question);
  return known->second;
}

double Contest::findTruth(Query query, const Question& question) {
  if (question.b < meshes_.size()) return truth(oracle(question.a, question.b), query, question);
  const auto oracle = shape_oracles_.try_emplace({question.a, question.b}, meshes_[question.a],
                                                 *others_[question.b - meshes_.size()]);
  if (query == Query::kDistance) return oracle.first->second.distance(question.poses);
  const std::size_t most = query == Query::kCollide ? 1 : question.max_contacts;
  return oracle.first->second.contacts(question.poses, static_cast<double>(most));
}

std::vector<Row> Contest::rowsOf(const std::string& scenario, Query query, std::size_t frames,
                                 const std::vector<Competitor>& competitors,
                                 const Competitor* reference) const {
  const Row base = baseRow(scenario, name(query), frames, meshes_);
  const auto triangles = static_cast<double>(base.triangles);
  std::vector<Row> rows;
  for (const Competitor& competitor : competitors) {
    const auto found = sets_.find(competitor.name);
    if (found == sets_.end()) continue;
    Row row = base.of(competitor, reference);
    row.volumes.bytes_per_triangle = static_cast<double>(found->second->bytes()) / triangles;
    row.volumes.build_us_per_triangle =
        timesOf(*named(competitor.name, builds_), 1, nullptr).median_us / triangles;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> Contest::buildRows(const std::string& scenario) const {
  return rowsOf(scenario, Query::kBuild, 1, builds_, named(kReference, builds_));
}

std::vector<Row> Contest::refitRows(const std::string& scenario,
                                    const std::vector<scenes::Mesh>& before, Refit how,
                                    const Question& question) {
  std::vector<Competitor> competitors =
      serving(Query::kRefit, [&](const std::string& bv, MeshSet& set) {
        const auto refit = [&, how](std::size_t, std::size_t) {
          set.replace(meshes_, how);
          askOne(set, question);
        };
        const auto as_before = [&](std::size_t, std::size_t) {
          set.load(before);
          askOne(set, question);  // as it would have been asked before, too
        };
        return Competitor{bv, refit, as_before};
      });
  Race{1, options_.repeats}.run(competitors);
  return rowsOf(scenario, Query::kRefit, 1, competitors, named(kReference, competitors));
}

std::size_t Contest::largestOf(const std::vector<Question>& questions) const {
  std::size_t largest = 0;
  for (const Question& question : questions) {
    for (const std::size_t body : {question.a, question.b}) {
      if (body < meshes_.size()) largest = std::max(largest, meshes_[body].triangles.size());
    }
  }
  return largest;
}

std::vector<Row> Contest::queryRows(const Task& task) {
  const std::size_t size = task.questions.size();
  if (size == 0) return {};
  std::map<std::string, std::vector<double>> answers;
  std::vector<Competitor> competitors =
      serving(task.query, [&](const std::string& bv, MeshSet& set) {
        std::vector<double>& of_set = answers[bv];
        of_set.resize(size);
        Competitor competitor{bv, [&](std::size_t begin, std::size_t end) {
                                set.answer(task.query, task.questions, begin, end, of_set);
                              }};
        if (task.cold) {
          competitor.before = [&task](std::size_t, std::size_t) {
            task.streamed_bytes > 0 ? stream(task.streamed_bytes) : workElsewhere();
          };
        }
        return competitor;
      });
  for (Competitor& competitor : competitors) {
    const double start = nowMicroseconds();
    competitor.answer(0, size);  // what models leave to their first query belongs to no repeat
    if (!task.cold) competitor.rounds = roundsOf(competitor.name, nowMicroseconds() - start);
  }
  const std::size_t of_frame = size / task.frames;
  const std::size_t block = task.cold ? of_frame : std::max(kBlock, kBlockFrames * of_frame);
  Race{size, options_.repeats, block}.run(competitors);

  const Verdicts verdicts =
      judge([this](Query query, const Question& question) { return truthOf(query, question); },
            task.query, task.questions, options_.oracle_frames);
  std::vector<Row> rows =
      rowsOf(task.scenario, task.query, task.frames, competitors, named(kReference, competitors));
  const std::size_t largest = largestOf(task.questions);
  for (Row& row : rows) {
    row.largest_mesh = largest;
    if (task.query == Query::kCloserThan) row.asked.threshold = task.questions[0].threshold;
    if (task.query != Query::kCollide && task.query != Query::kContacts)
      row.asked.rel_err = row.asked.abs_err = 0;
    if (size > task.frames) row.pairs.total = size;
    row.errors = compare(answers[row.bv], verdicts, task.query, task.questions, row.extent);
    if (others_.empty() && task.query != Query::kCloserThan)
      row.tests = sets_[row.bv]->count(task.query, task.questions, task.frames);
    const auto before = answers.find(row.bv + kBefore);
    if (before != answers.end()) row.changes = changesOf(before->second, answers[row.bv]);
  }
  return rows;
}

}  // namespace kios::bench
