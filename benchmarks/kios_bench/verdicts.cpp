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

bool wrongSide(double answer, double distance, double threshold, double extent) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  const double tolerance = 16 * kEps * (2 * extent + distance);
  if (std::abs(distance - threshold) <= tolerance) return false;
  return (answer < threshold) != (distance < threshold);
}

}  // namespace

Verdicts judge(const OracleOf& oracle, Query query, const std::vector<Question>& questions,
               int wanted) {
  const std::size_t count =
      wanted == 0 ? questions.size() : std::min(questions.size(), static_cast<std::size_t>(wanted));
  Verdicts verdicts;
  verdicts.questions = spread(count, questions.size());
  for (const std::size_t i : verdicts.questions) {
    const Question& question = questions[i];
    const auto& [X_WA, X_WB] = question.poses;
    const scenes::MeshOracle& pair = oracle(question.a, question.b);
    if (query == Query::kCollide) {
      verdicts.answers.push_back(pair.collide(X_WA, X_WB) ? 1 : 0);
    } else {
      verdicts.answers.push_back(pair.distance(X_WA, X_WB));
    }
  }
  return verdicts;
}

Errors compare(const std::vector<double>& answers, const Verdicts& verdicts, Query query,
               const std::vector<Question>& questions, double extent) {
  Errors errors;
  errors.wrong = 0;
  for (std::size_t i = 0; i < verdicts.questions.size(); ++i) {
    const double answer = answers[verdicts.questions[i]];
    double exact = verdicts.answers[i];
    if (query == Query::kThreshold) {
      const double threshold = questions[verdicts.questions[i]].threshold;
      if (wrongSide(answer, exact, threshold, extent)) ++*errors.wrong;
      exact = std::min(exact, threshold);
    } else if ((answer == 0) != (exact == 0)) {
      ++*errors.wrong;
    }
    if (query == Query::kCollide) continue;
    const double error = absoluteError(answer, exact);
    errors.max_abs = std::max(errors.max_abs.value_or(0), error);
    if (exact > 0) errors.max_rel = std::max(errors.max_rel.value_or(0), error / exact);
  }
  return errors;
}

}  // namespace kios::bench
