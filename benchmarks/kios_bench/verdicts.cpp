// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "verdicts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kios::bench {
namespace {

// One index of each of `count` equal parts of [0, size).
std::vector<std::size_t> spread(std::size_t count, std::size_t size) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * size / count;
    const std::size_t width = (i + 1) * size / count - begin;
    const double turns = kGolden * static_cast<double>(i);
    const double fraction = turns - std::floor(turns);
    indices.push_back(begin + static_cast<std::size_t>(fraction * static_cast<double>(width)));
  }
  return indices;
}

// An answer that is no number is an infinite error, so that it cannot hide in a maximum.
double absoluteError(double answer, double exact) {
  return std::isfinite(answer) ? std::abs(answer - exact) : std::numeric_limits<double>::infinity();
}

bool undecided(double distance, double threshold, double extent) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  const double tolerance = 16 * kEps * (2 * extent + distance);
  return threshold > 0 && std::abs(distance - threshold) <= tolerance;
}

}  // namespace

double truth(const scenes::MeshOracle& oracle, Query query, const Question& question) {
  const auto& [X_WA, X_WB] = question.poses;
  if (query == Query::kCollide) return oracle.collide(X_WA, X_WB) ? 1 : 0;
  if (query != Query::kContacts) return oracle.distance(X_WA, X_WB);
  const std::size_t count = oracle.collidingPairs(X_WA, X_WB).size();
  return static_cast<double>(std::min(count, question.max_contacts));
}

Verdicts judge(const TruthOf& truth, Query query, const std::vector<Question>& questions,
               int wanted) {
  const std::size_t count =
      wanted == 0 ? questions.size() : std::min(questions.size(), static_cast<std::size_t>(wanted));
  Verdicts verdicts;
  verdicts.questions = spread(count, questions.size());
  for (const std::size_t i : verdicts.questions) {
    verdicts.answers.push_back(truth(query, questions[i]));
  }
  return verdicts;
}

Errors compare(const std::vector<double>& answers, const Verdicts& verdicts, Query query,
               const std::vector<Question>& questions, double extent) {
  Errors errors;
  errors.wrong = 0;
  for (std::size_t i = 0; i < verdicts.questions.size(); ++i) {
    const double answer = answers[verdicts.questions[i]];
    const double exact = verdicts.answers[i];
    const double threshold = questions[verdicts.questions[i]].threshold;
    if (query == Query::kContacts) {
      if (answer != exact) ++*errors.wrong;
      continue;
    }
    if (query == Query::kCloserThan) {
      const bool wrong = (answer == 1) != (exact <= threshold);
      if (wrong && !undecided(exact, threshold, extent)) ++*errors.wrong;
      continue;
    }
    if ((answer == 0) != (exact == 0)) ++*errors.wrong;
    if (query == Query::kCollide) continue;
    errors.max_abs = std::max(errors.max_abs.value_or(0), absoluteError(answer, exact));
  }
  return errors;
}

}  // namespace kios::bench
